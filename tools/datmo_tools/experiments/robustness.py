# SPDX-License-Identifier: BSD-3-Clause
"""Measures how stable the pose is among moving objects, over many seeds: command line and runs."""

import os
import tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import NamedTuple

from tqdm import tqdm

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.robustness_summary import summarize, table
from datmo_tools.programs import StepFailed

DESCRIPTION = """\
Drives each scene with each number of moving vehicles and each seed through simulator, stack and
score, and prints how often the pose jumped by more than 1 m, and how much larger its error is with
the vehicles than without. The same seed has the same odometry noise for any number. A run without a
score is reported, and the others continue; the exit code is then 1."""

FORMAT = 1  # of the JSON file


class Case(NamedTuple):
    """One run."""

    scene: Path
    movers: int
    seed: int


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    complete = []
    code = command_line.run("robustness", lambda: complete.append(_benchmark(values)), "report")
    return code or int(not complete[0])


def _benchmark(values):
    """Whether all runs have a score."""
    for file in [*values.scenes, values.config]:
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a yaml file")
    simulated_run.check_programs(values.programs)
    cases = [
        Case(scene, movers, seed)
        for scene in values.scenes
        for movers in values.movers
        for seed in range(1, values.seeds + 1)
    ]
    runs = _run_all(cases, values)
    summary = summarize(runs)
    report = {"format": FORMAT, "config": str(values.config), "summary": summary, "runs": runs}
    command_line.write_json(values.out, report)
    print(table(summary))
    failed = [run for run in runs if run["error"] is not None]
    for run in failed:
        print(f"{run['scene']}, {run['movers']} movers, seed {run['seed']}: {run['error']}")
    print(f"\nall runs: {values.out}")
    return not failed


def _run_all(cases, values):
    """Returns the runs in the order of the cases, several in parallel."""
    runs = {}
    with ThreadPoolExecutor(values.jobs) as pool:
        waiting = {pool.submit(_run_case, case, values): case for case in cases}
        try:
            for done in tqdm(as_completed(waiting), "runs", len(cases)):
                runs[waiting[done]] = done.result()
        except BaseException:
            for future in waiting:
                future.cancel()
            raise
    return [runs[case] for case in cases]


def _run_case(case, values):
    drive = simulated_run.SimulatedDrive(
        case.scene, (f"seed={case.seed}", f"traffic/movers={case.movers}")
    )
    run = {"scene": case.scene.stem, "movers": case.movers, "seed": case.seed}
    with tempfile.TemporaryDirectory(prefix="robustness_") as folder:
        try:
            score = simulated_run.run(drive, values.programs, values.config, Path(folder))
        except StepFailed as error:
            return {**run, "error": str(error), "pose": None}
    return {**run, "error": None, "pose": score["pose"]}


def _parser():
    parser = command_line.new_parser("robustness", DESCRIPTION)
    add = parser.add_argument
    add("scenes", nargs="+", type=Path, metavar="SCENE.yaml", help="scenes with lanes")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR",
        help="folder of simulate, run_bag and score_run")  # fmt: skip
    add("--movers", nargs="+", type=int, default=[0, 8, 16], metavar="N",
        help="numbers of moving vehicles (default 0 8 16)")  # fmt: skip
    add("--seeds", type=command_line.count, default=50, metavar="N",
        help="seeds from 1 (default %(default)s)")  # fmt: skip
    add("--jobs", type=command_line.count, default=os.cpu_count(), metavar="N",
        help="parallel runs (default: all cores)")  # fmt: skip
    add("--out", type=command_line.output_file, default=Path("robustness.json"), metavar="FILE.json",
        help="all runs (default %(default)s)")  # fmt: skip
    return parser
