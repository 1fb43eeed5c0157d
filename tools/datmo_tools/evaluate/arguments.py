# SPDX-License-Identifier: BSD-3-Clause
"""What several subcommands of evaluate take."""

import math
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.truth import Region


def add_truth(parser):
    """The option --truth; None: not given."""
    parser.add_argument("--truth", type=Path, metavar="DRIVE.bag",
                        help="bag with the truth (default: the run's own, of run_bag --with-truth)")  # fmt: skip


def add_grids(parser, topic):
    """Run and drive of KITTI, and --topic of its grids; topic: the default."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag --low-level-fusion --write-grids")
    add("drive", type=Path, metavar="DRIVE.bag", help="bag of kitti_to_bag --points --images")
    add("--topic", default=topic, help="of the grids (default %(default)s)")


def add_region(parser, default_range):
    """The options --range and --half-angle, for region_of(); default_range: m."""
    command_line.add_number(parser, "--range", default_range, "M",
                            "that counts, about the vehicle, m")  # fmt: skip
    command_line.add_number(parser, "--half-angle", math.pi, "RAD",
                            "the same to either side of straight ahead, rad")  # fmt: skip


def region_of(values):
    """Region of parsed options. Raises InputError where one is out of bounds."""
    command_line.check_positive(values, "range")
    if not 0.0 < values.half_angle <= math.pi:
        raise InputError(f"--half-angle is {values.half_angle:g}, expected more than 0, at most pi")
    return Region(values.range, values.half_angle)
