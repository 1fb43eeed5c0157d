# SPDX-License-Identifier: BSD-3-Clause
"""Repeats the thesis's experiments on simulated data sets: the command line and the runs."""

import json
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple, Optional

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate import borders, grids
from datmo_tools.evaluate.thesis_tables import PUBLISHED, thesis_tables
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.border_runs import BorderRuns, border_runs_table
from datmo_tools.experiments.fusion_table import FusionRuns, fusion_table
from datmo_tools.programs import StepFailed

DESCRIPTION = """\
Drives the scenes data_set_1 to data_set_3 through simulator, stack and score, and prints the
thesis's tables 3.1 to 3.5 with our counts next to the thesis's. Bags and scores of each set are
kept in a separate folder, for evaluate. A run without a score is reported, and the others continue;
the exit code is then 1.

With --low-level-fusion the stereo camera is simulated, too (10 MB for each second), each drive goes
through the stack without and with low-level fusion, and a table has both; the thesis's tables are
of the runs without. Bags and scores of those with fusion are in a folder `fused` within the set's.

With --road-border each drive also goes through the stack with road borders (thesis 3.5), with
the scanner only; the thesis's tables 3.4 and 3.5 have columns of these runs, and a table has both.
Their bags and scores are in a folder `road_border` within the set's."""

# All objects that the scanner saw moving count, as in the thesis, also those visible only for a
# moment.
SCORE_OPTIONS = ("truth/min_time_seen=0", "truth/visible_to=scanner")

STEREO_OPTIONS = ("stereo/enabled=true", "ground_truth/echoes=true")


class Result(NamedTuple):
    """The results of one data set; None for those that do not exist."""

    report: Optional[dict] = None  # of score_run
    fusion: Optional[FusionRuns] = None
    borders: Optional[BorderRuns] = None
    failure: Optional[str] = None


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    complete = []
    code = command_line.run("data_sets", lambda: complete.append(_run_all(values)), "table")
    return code or int(not complete[0])


def _run_all(values):
    """Whether all runs have a score."""
    simulated_run.check_programs(values.programs)
    scenes = [values.scenes / f"data_set_{i + 1}.yaml" for i in range(len(PUBLISHED))]
    for file in [*scenes, values.config]:
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a yaml file")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda scene: _run(scene, values), scenes))
    border_runs = [result.borders for result in results]
    with_borders = [runs and runs.with_borders for runs in border_runs]
    print(thesis_tables([result.report for result in results], with_borders))
    if values.low_level_fusion:
        print("\n" + fusion_table([result.fusion for result in results]))
    if values.road_border:
        print("\n" + border_runs_table(border_runs))
    failures = [result.failure for result in results if result.failure is not None]
    print("\n" + "\n".join(failures or [f"bags and scores: {values.out}"]))
    return not failures


def _run(scene, values):
    """Returns the Result of one scene."""
    folder = values.out / scene.stem
    try:
        folder.mkdir(parents=True, exist_ok=True)
        options = STEREO_OPTIONS if values.low_level_fusion else ()
        drive = simulated_run.SimulatedDrive(scene, options)
        simulated_run.record(drive, values.programs, folder / "drive.bag")
        alone = _timed_run(folder, folder, values, ())
        return Result(
            alone.report,
            _fused(folder, values, alone) if values.low_level_fusion else None,
            _with_borders(folder, values, alone) if values.road_border else None,
        )
    except (StepFailed, InputError, OSError) as error:
        return Result(failure=f"{scene.stem}: {error}")


class _TimedRun(NamedTuple):
    """One run on a recorded drive."""

    report: dict  # of score_run
    times: Path  # of run_bag


def _timed_run(recorded_in, folder, values, run_options):
    """Returns the _TimedRun with these options of run_bag; its files stay in the folder."""
    folder.mkdir(exist_ok=True)
    times = folder / "times.json"
    report = simulated_run.run_recorded(
        recorded_in / "drive.bag", values.programs, values.config, folder, SCORE_OPTIONS,
        (*run_options, "--times", times))  # fmt: skip
    return _TimedRun(report, times)


def _fused(folder, values, alone):
    """Returns FusionRuns: the given run, and one with low-level fusion."""
    fused = _timed_run(folder, folder / "fused", values, ("--low-level-fusion", "--write-grids"))
    fused_grids = grids.score(folder / "fused" / "result.bag", folder / "drive.bag")
    return FusionRuns(alone.report, fused.report, _read(alone.times), _read(fused.times),
                      fused_grids)  # fmt: skip


def _with_borders(folder, values, alone):
    """Returns BorderRuns: the given run, and one with road borders."""
    bordered = _timed_run(folder, folder / "road_border", values, ("--road-border",))
    found = borders.score(folder / "road_border" / "result.bag")
    return BorderRuns(alone.report, bordered.report, _read(alone.times), _read(bordered.times),
                      found)  # fmt: skip


def _read(file):
    return json.loads(file.read_text(encoding="utf-8"))


def _parser():
    parser = command_line.new_parser("data_sets", DESCRIPTION)
    add = parser.add_argument
    add("--scenes", required=True, type=Path, metavar="DIR", help="folder of the scenes")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR",
        help="folder of simulate, run_bag and score_run")  # fmt: skip
    add("--out", type=command_line.output_folder, default=Path("data_sets"), metavar="DIR",
        help="for bags and scores (default %(default)s)")  # fmt: skip
    add("--low-level-fusion", action="store_true",
        help="also run each drive with fused grids of scanner and stereo camera")  # fmt: skip
    add("--road-border", action="store_true", help="also run each drive with road borders")
    return parser
