# SPDX-License-Identifier: BSD-3-Clause
"""Options shared by several subcommands of evaluate."""

import math
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.truth import Region


def add_truth(parser):
    """Adds the option --truth; None: not given."""
    parser.add_argument("--truth", type=Path, metavar="DRIVE.bag",
                        help="bag with the truth (default: the run's own, of run_bag --with-truth)")  # fmt: skip


def add_truths(parser):
    """Adds the option --truth of a tool of several runs, for drives_of()."""
    parser.add_argument("--truth", action="append", type=Path, metavar="DRIVE.bag",
                        help="bags with the truth, one for each run (default: the runs themselves)")  # fmt: skip


def drives_of(values):
    """Returns the bag with the truth of each run (Path). Raises InputError if there are more or
    fewer of them than runs."""
    drives = values.truth or values.runs
    if len(drives) != len(values.runs):
        raise InputError(f"{len(drives)} --truth for {len(values.runs)} runs: expected one for each")
    return drives


def add_settings(parser):
    """Adds the option --set, for programs.settings()."""
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="one option of score_run")  # fmt: skip


def add_table(parser, name):
    """Adds the option --out of a calibration; name: of the file by default."""
    parser.add_argument("--out", type=command_line.output_file, default=Path(name),
                        metavar="FILE.yaml", help="the table (default %(default)s)")  # fmt: skip


def add_grids(parser, topic):
    """Adds the run and the KITTI drive, and --topic of its grids; topic: the default."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag --low-level-fusion --write-grids")
    add("drive", type=Path, metavar="DRIVE.bag", help="bag of kitti_to_bag --points --images")
    add("--topic", default=topic, help="of the grids (default %(default)s)")


def add_region(parser, default_range):
    """Adds the options --range and --half-angle, for region_of(); default_range: m."""
    command_line.add_number(parser, "--range", default_range, "M",
                            "that counts, about the vehicle, m")  # fmt: skip
    command_line.add_number(parser, "--half-angle", math.pi, "RAD",
                            "evaluated angle to either side of straight ahead, rad")  # fmt: skip


def region_of(values):
    """Returns the Region of parsed options. Raises InputError if one is out of bounds."""
    command_line.check_positive(values, "range")
    if not 0.0 < values.half_angle <= math.pi:
        raise InputError(f"--half-angle is {values.half_angle:g}, expected more than 0, at most pi")
    return Region(values.range, values.half_angle)
