"""The thesis's experiments on simulated data sets: the command line and the runs."""

import argparse
import json
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple, Optional

from datmo_tools import command_line, score_grids, simulated_run
from datmo_tools.errors import InputError
from datmo_tools.fusion_table import FusionRuns, fusion_table
from datmo_tools.programs import StepFailed
from datmo_tools.thesis_tables import PUBLISHED, thesis_tables

DESCRIPTION = """\
Drives the scenes data_set_1 to data_set_3 through simulator, stack and score, and prints the
thesis's tables 3.1 to 3.5 with our counts beside the thesis's. Bags and scores of each set stay in
a folder of its own, for evaluate. A run that gives no score is reported, and the others go on; the
exit code is then 1.

With --low-level-fusion the stereo camera is simulated too (10 MB for each second), each drive goes
through the stack without and with low-level fusion, and a table has both; the thesis's tables are
of the runs without. Bags and scores of those with fusion are in a folder `fused` within the set's."""

# All objects count that the scanner saw moving, as in the thesis, also those gone in a moment.
SCORE_OPTIONS = ("truth/least_time_seen=0", "truth/visible_to=scanner")

STEREO_OPTIONS = ("stereo/enabled=true", "ground_truth/echoes=true")


class Result(NamedTuple):
    """What came of one data set; None for what there is not."""

    report: Optional[dict] = None  # of score_run
    fusion: Optional[FusionRuns] = None
    failure: Optional[str] = None


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    complete = []
    code = command_line.run("data_sets", lambda: complete.append(_run_all(values)), "table")
    return code or int(not complete[0])


def _run_all(values):
    """Whether all runs gave a score."""
    simulated_run.check_programs(values.programs)
    scenes = [values.scenes / f"data_set_{i + 1}.yaml" for i in range(len(PUBLISHED))]
    for file in [*scenes, values.config]:
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a yaml file")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda scene: _run(scene, values), scenes))
    print(thesis_tables([result.report for result in results]))
    if values.low_level_fusion:
        print("\n" + fusion_table([result.fusion for result in results]))
    failures = [result.failure for result in results if result.failure is not None]
    print("\n" + "\n".join(failures or [f"bags and scores: {values.out}"]))
    return not failures


def _run(scene, values):
    """Result of one scene."""
    folder = values.out / scene.stem
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if values.low_level_fusion:
            return _run_both(scene, values, folder)
        drive = simulated_run.SimulatedDrive(scene)
        return Result(
            simulated_run.run(drive, values.programs, values.config, folder, SCORE_OPTIONS)
        )
    except (StepFailed, InputError, OSError) as error:
        return Result(failure=f"{scene.stem}: {error}")


def _run_both(scene, values, folder):
    """Result with the runs without and with low-level fusion."""
    drive = simulated_run.SimulatedDrive(scene, STEREO_OPTIONS)
    fused_folder = folder / "fused"
    fused_folder.mkdir(exist_ok=True)
    times, fused_times = folder / "times.json", fused_folder / "times.json"
    alone = simulated_run.run(drive, values.programs, values.config, folder, SCORE_OPTIONS,
                              ("--times", times))  # fmt: skip
    recorded = folder / "drive.bag"
    fused = simulated_run.run_recorded(
        recorded, values.programs, values.config, fused_folder, SCORE_OPTIONS,
        ("--low-level-fusion", "--write-grids", "--times", fused_times))  # fmt: skip
    grids = score_grids.score(fused_folder / "result.bag", recorded)
    return Result(alone, FusionRuns(alone, fused, _read(times), _read(fused_times), grids))


def _read(file):
    return json.loads(file.read_text(encoding="utf-8"))


def _parser():
    parser = argparse.ArgumentParser(
        prog="data_sets",
        description=DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("--scenes", required=True, type=Path, metavar="DIR", help="folder of the scenes")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR",
        help="folder of simulate, run_bag and score_run")  # fmt: skip
    add("--out", type=Path, default=Path("data_sets"), metavar="DIR",
        help="for bags and scores (default %(default)s)")  # fmt: skip
    add("--low-level-fusion", action="store_true",
        help="each drive also with the grids of scanner and stereo camera fused")  # fmt: skip
    return parser
