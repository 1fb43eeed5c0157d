# SPDX-License-Identifier: BSD-3-Clause
"""evaluate compare_borders."""

from pathlib import Path

from datmo_tools import command_line, programs
from datmo_tools.evaluate.border_comparison import comparison, comparison_table
from datmo_tools.evaluate.score_run import find_score_run, score

DESCRIPTION = """\
Compares two results of run_bag on the same drive, without and with --road-border: false moving
objects before tracking, tracks, intersections found, and for each true moving object that the
scanner saw moving the number of frames in which it is tracked. An object is lost if it is tracked
in some frame without borders, and in none with them. Counts are score_run's."""

PRODUCT = "score"

# All objects that the scanner saw moving, however briefly, at any distance.
SETTINGS = ("truth/visible_to=scanner", "truth/min_time_seen=0", "region/range=500")


def compare(without, with_borders, drive=None, program=None):
    """Returns the comparison() of two bags (Path); drive: bag with the truth, default: each one's
    own.

    Raises InputError without score_run, and SystemExit if it fails.
    """
    program = program or find_score_run()
    settings = programs.settings(SETTINGS)
    reports = [score(program, run, drive, settings) for run in (without, with_borders)]
    return comparison(*reports)


def execute(values):
    """Prints the comparison, and writes it to the file that --json names. Raises InputError."""
    result = compare(values.without, values.with_borders, values.drive, values.score_run)
    print(comparison_table(result))
    command_line.write_json(values.json, result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("without", type=Path, metavar="WITHOUT.bag", help="bag of run_bag")
    add("with_borders", type=Path, metavar="WITH.bag", help="bag of run_bag --road-border")
    add("--drive", type=Path, metavar="DRIVE.bag",
        help="bag with ground truth (default: each its own, of run_bag --with-truth)")  # fmt: skip
    command_line.add_json(parser)
