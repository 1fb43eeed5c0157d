"""Command line of evaluate."""

import argparse
import json
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.run_table import table
from datmo_tools.evaluate.score_run import find_score_run, score
from datmo_tools.whole_files import write_whole

DESCRIPTION = """\
Scores the tracks of a run against the truth: a table on the terminal, and in a folder report.json
and report.html, one page with plots that needs no network.

The truth is in the run's own bag (run_bag --with-truth), or in the bag that --truth names. Several
runs on the same truth stand side by side, and the best value of each line is marked. What has to be
found, and how near a track has to be, are options; score_run --list-options prints them. A bag that
cannot be scored ends with what is missing in which file, and no report."""


def main(arguments=None, score_run=None):
    """Runs the command line; returns its exit code.

    score_run: the program that scores one run; by default the one that is installed beside.
    """
    values = _parser().parse_args(arguments)
    return command_line.run("evaluate", lambda: _evaluate(values, score_run), product="report")


def _evaluate(values, score_run):
    page = _page_maker()
    program = score_run or find_score_run()
    bags = values.compare or [values.run]
    runs = [score(program, bag, values.truth, _settings(values)) for bag in bags]
    _check_same_drive(runs)
    report = {"format": 1, "runs": runs}
    texts = {"report.json": json.dumps(report) + "\n", "report.html": page(runs)}
    write_whole(values.out, texts)
    print(table(runs))
    print(f"\nreport: {values.out / 'report.html'}, {values.out / 'report.json'}")


def _check_same_drive(runs):
    """Figures of different drives say nothing side by side."""
    objects = [{(item["id"], item["label"]) for item in run["objects"]} for run in runs]
    for run, seen in zip(runs, objects):
        if seen != objects[0]:
            raise InputError(
                f"{run['run']}: {len(seen)} true objects, others than the {len(objects[0])} of "
                f"{runs[0]['run']}, expected runs on the same drive"
            )


def _page_maker():
    """The module of the page needs matplotlib, and is loaded before the work is done in vain."""
    try:
        from datmo_tools.evaluate.page import page  # pylint: disable=import-outside-toplevel
    except ImportError as error:
        raise InputError(f"{error}: expected the package python3-matplotlib") from error
    return page


def _settings(values):
    """Words that score_run is given besides its bags."""
    words = [] if values.options is None else ["--options", str(values.options)]
    for assignment in values.set:
        words += ["--set", assignment]
    return words


def _parser():
    parser = argparse.ArgumentParser(
        prog="evaluate",
        description=DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    bags = parser.add_mutually_exclusive_group(required=True)
    bags.add_argument("run", nargs="?", type=Path, metavar="RUN.bag", help="bag of one run")
    bags.add_argument("--compare", nargs="+", type=Path, metavar="BAG", help="bags of several runs")
    add = parser.add_argument
    add("--truth", type=Path, metavar="TRUTH.bag", help="default: the truth in each run's bag")
    add(
        "--out",
        type=command_line.output_folder,
        default=Path("evaluation"),
        metavar="DIR",
        help="folder of the report (default %(default)s)",
    )
    add("--options", type=Path, metavar="FILE.yaml", help="options of score_run")
    add("--set", action="append", default=[], metavar="KEY=VALUE", help="one option of score_run")
    return parser
