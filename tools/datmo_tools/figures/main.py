# SPDX-License-Identifier: BSD-3-Clause
"""Command line of scripts/figures."""

import os
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.figures import results_file
from datmo_tools.figures.commits import commit_of
from datmo_tools.figures.earlier import earlier_steps
from datmo_tools.figures.pass_of_steps import run_steps
from datmo_tools.figures.render import FILE, rendered
from datmo_tools.figures.step import Bench
from datmo_tools.figures.steps import STEPS
from datmo_tools.text_table import aligned
from datmo_tools.whole_files import write_file

DESCRIPTION = """\
Measures the figures of README's table of results and of doc/results.md, writes them to
doc/results.json, and renders both from it. A step that is done at this commit is not repeated, so
an interrupted run resumes, and neither is one in doc/results.json that was measured at an earlier
commit if no change since can affect its figures (figures/effects.py), or if only C++ code, its CMake
files or the reader of bags can, and one of its jobs, drawn at random, has the same result as then.
With uncommitted changes every step runs, and only the figures of this run are written. Steps that have to run and whose data is missing below
../shared/data are left out and named. A step that fails is reported, and the others continue; the
exit code is then 1."""


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    codes = []
    code = command_line.run("figures", lambda: codes.append(_work(values)), "further figures")
    return code or codes[0]


def _work(values):
    """Returns the exit code."""
    if values.list:
        print(steps_table())
        return 0
    if values.check:
        return check(values.source)
    if not values.render:
        return _measure(values)
    write_pages(values.source, results_file.read(values.source / FILE))
    return 0


def steps_table():
    """Returns the steps as text."""
    rows = [["step", "shows", "by", ""]]
    rows += [[step.name, step.shows, step.command, "on request" if step.on_request else ""]
             for step in STEPS]  # fmt: skip
    return aligned(rows)


def check(source):
    """Returns 0 if the pages agree with the file of figures, else 1 after printing their names."""
    pages = rendered(source, results_file.read(source / FILE))
    stale = [name for name, text in pages.items()
             if not (source / name).is_file()
             or (source / name).read_text(encoding="utf-8") != text]  # fmt: skip
    for name in stale:
        print(f"{name}: does not agree with {FILE}, expected scripts/figures --render")
    return int(bool(stale))


def write_pages(source, results):
    """Writes README's table and doc/results.md."""
    for name, text in rendered(source, results).items():
        write_file(source / name, text)


def _measure(values):
    names = [step.name for step in STEPS]
    unknown = set(values.only + values.also) - set(names)
    if unknown:
        raise InputError(f"{sorted(unknown)[0]}: no such step, expected {', '.join(names)}")
    bench = Bench(values.source, values.build, values.programs, values.data,
                  tuple(range(1, values.seeds + 1)))  # fmt: skip
    chosen, store = _chosen(values), _store(values)
    if values.again:
        for step in chosen:
            store.forget(step)
    try:
        failures = run_steps(chosen, bench, store, values.jobs)
    finally:
        _write_done(values.source, store)
    for failure in failures:
        print(failure)
    return int(bool(failures))


def _store(values):
    commit = commit_of(values.source)
    earlier = earlier_steps(values.source / FILE, values.source, commit, STEPS)
    return results_file.StepStore(values.out, commit, *earlier)


def _write_done(source, store):
    """Writes the file of figures and the pages, from all steps whose figures are those of the commit."""
    results = store.results(STEPS)
    if results is not None:
        write_file(source / FILE, results_file.as_text(results))
        write_pages(source, results)
        print(f"{FILE}, README.md and doc/results.md: {store.commit}, {', '.join(results['steps'])}")


def _chosen(values):
    if values.only:
        return [step for step in STEPS if step.name in values.only]
    return [step for step in STEPS if not step.on_request or step.name in values.also]


def _parser():
    parser = command_line.new_parser("figures", DESCRIPTION)
    add = parser.add_argument
    folder = {"type": Path, "metavar": "DIR"}
    add("--source", **folder, default=Path.cwd(), help="root of the sources (default: here)")
    add("--build", **folder, default=Path("build"), help="build folder")
    add("--programs", **folder, default=Path("devel/lib/datmo_fusion"), help="built programs")
    add("--data", **folder, default=Path("../shared/data"), help="recordings (default %(default)s)")
    add("--out", type=command_line.output_folder, default=Path("demo_output/figures"), metavar="DIR",
        help="finished steps, by commit, and scratch files (default %(default)s)")  # fmt: skip
    add("--jobs", type=command_line.count, default=os.cpu_count(), metavar="N",
        help="parallel jobs (default: all cores)")  # fmt: skip
    add("--seeds", type=command_line.count, default=5, metavar="N",
        help="seeds of the simulated data sets, from 1 (default %(default)s)")  # fmt: skip
    add("--only", nargs="+", default=[], metavar="STEP", help="only these steps")
    add("--also", nargs="+", default=[], metavar="STEP", help="optional steps to include")
    add("--again", action="store_true", help="drop the figures of these steps first")
    action = parser.add_mutually_exclusive_group()
    for name, text in (
        ("--list", "print the steps"),
        ("--render", "measure nothing: render the pages from doc/results.json"),
        ("--check", "measure nothing: check that the pages agree with doc/results.json"),
    ):
        action.add_argument(name, action="store_true", help=text)
    return parser
