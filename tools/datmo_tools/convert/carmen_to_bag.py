# SPDX-License-Identifier: BSD-3-Clause
"""Command line of carmen_to_bag."""

import math
from pathlib import Path

import numpy as np

from datmo_tools import command_line
from datmo_tools.convert import carmen_bag
from datmo_tools.convert.carmen_clock import CLOCKS
from datmo_tools.convert.carmen_lines import LASERS
from datmo_tools.errors import InputError

DESCRIPTION = """\
Converts a log of the robot software CARMEN (also .bz2 or .gz) to a bag: /scan, /odometry, /tf,
/tf_static.

The scanner's mount is the laser's pose on the robot in the log; a log does not contain its height.
Readings at or beyond the maximum range become +inf: no return. The odometry is that of the scan
lines, and of ODOM lines between them; its twist is the mean motion to the next pose.

Stamps are the log's ipc times, to which relations files refer. If those of the scans do not
increase, the scans keep the order of the file, in which they were measured; their stamps are
moved as little as necessary to make them increase evenly, and /log_stamps has those of the log, for
evaluate slam (--clock order). With --clock log the scans are sorted by the log's stamps instead."""


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run(
        "carmen_to_bag", lambda: carmen_bag.convert(values.log, values.bag, _options(values))
    )


def _parser():
    defaults = carmen_bag.Options()
    parser = command_line.new_parser("carmen_to_bag", DESCRIPTION)
    add = parser.add_argument
    add("log", type=Path, help="CARMEN log")
    add("bag", type=Path, help="bag to write")
    add("--laser", choices=LASERS, help="kind of line (default: the first of these in the log)")
    clock = "order of the scans (default: log if their stamps increase, else order)"
    add("--clock", choices=CLOCKS, help=clock)
    field = (
        "first to last beam (default: from the line, or a SICK's half turn)"
    )
    add("--field-of-view", type=command_line.number, metavar="DEG", help=field)
    reach = "range (m) from which a reading means no return; also from the line's own maximum"
    command_line.add_number(parser, "--range-max", defaults.range_max, "M", reach)
    position = "the scanner's pose on the robot instead of the log's (m, m, degrees)"
    add("--mount", type=command_line.number, nargs=3, metavar=("X", "Y", "YAW"), help=position)
    sweep = "s from the first beam to the last; a SICK LMS takes 1/150 for half a turn"
    command_line.add_number(parser, "--sweep-time", defaults.sweep_time, "S", sweep)
    add("--skip-malformed", action="store_true", help="skip broken and unknown lines")
    return parser


def _options(values):
    if values.field_of_view is not None and not 0.0 < values.field_of_view <= 360.0:
        raise InputError(f"--field-of-view is {values.field_of_view}, expected 0 to 360 degrees")
    if values.range_max <= carmen_bag.RANGE_MIN:
        raise InputError(
            f"--range-max is {values.range_max}, expected more than {carmen_bag.RANGE_MIN} m"
        )
    if not 0.0 <= values.sweep_time <= 1.0:
        raise InputError(f"--sweep-time is {values.sweep_time}, expected 0 to 1 s")
    return carmen_bag.Options(
        laser=values.laser,
        clock=values.clock,
        field_of_view=values.field_of_view and math.radians(values.field_of_view),
        range_max=values.range_max,
        mount=values.mount and np.array([*values.mount[:2], math.radians(values.mount[2])]),
        sweep_time=values.sweep_time,
        skip_malformed=values.skip_malformed,
    )
