# SPDX-License-Identifier: BSD-3-Clause
"""evaluate tracks."""

from pathlib import Path

from datmo_tools import programs
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_settings, add_truth
from datmo_tools.evaluate.plot_files import drawing_module
from datmo_tools.evaluate.score_run import find_score_run, score

DESCRIPTION = """\
Scores the tracks of a run against the truth.

The truth is in the run's own bag (run_bag --with-truth), or in the bag that --truth names. Several
runs on the same truth are shown side by side, with the best value of each line marked. Which objects
have to be found, and how close a track has to be, are options; score_run --list-options prints them."""


def evaluate(values):
    """Returns the runs' scores by score_run, and their sections. Raises InputError."""
    report = drawing_module("run_report")
    runs = score_runs(values)
    return {"format": 1, "runs": runs}, report.sections(runs)


def score_runs(values):
    """Returns a list of what score_run writes for runs on the same drive. Raises InputError."""
    program = values.score_run or find_score_run()
    words = settings_of(values)
    if values.attainable is not None:
        words += ["--attainable", str(values.attainable)]
    runs = [score(program, bag, values.truth, words) for bag in bags_of(values)]
    _check_same_drive(runs)
    return runs


def bags_of(values):
    """Returns the bags (Path) of the runs."""
    return values.compare or [values.run]


def _check_same_drive(runs):
    """Raises InputError for runs on different drives, whose figures are not comparable."""
    objects = [{(item["id"], item["label"]) for item in run["objects"]} for run in runs]
    for run, seen in zip(runs, objects):
        if seen != objects[0]:
            raise InputError(
                f"{run['run']}: {len(seen)} true objects, different from the {len(objects[0])} of "
                f"{runs[0]['run']}, expected runs on the same drive"
            )


def settings_of(values):
    """Returns the words for score_run that set its options."""
    words = [] if values.options is None else ["--options", str(values.options)]
    return words + programs.settings(values.set)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    bags = parser.add_mutually_exclusive_group(required=True)
    bags.add_argument("run", nargs="?", type=Path, metavar="RUN.bag", help="bag of one run")
    bags.add_argument("--compare", nargs="+", type=Path, metavar="BAG", help="bags of several runs")
    add = parser.add_argument
    add_truth(parser)
    add("--attainable", type=Path, metavar="DRIVE.bag",
        help="bag with the scans: compares delays with the minimum that they allow")  # fmt: skip
    add("--options", type=Path, metavar="FILE.yaml", help="options of score_run")
    add_settings(parser)
