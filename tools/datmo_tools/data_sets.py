"""The thesis's experiments on simulated data sets: the command line and the runs."""

import argparse
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from datmo_tools import command_line, simulated_run
from datmo_tools.errors import InputError
from datmo_tools.programs import StepFailed
from datmo_tools.thesis_tables import PUBLISHED, thesis_tables

DESCRIPTION = """\
Drives the scenes data_set_1 to data_set_3 through simulator, stack and score, and prints the
thesis's tables 3.1 to 3.5 with our counts beside the thesis's. Bags and scores of each set stay in
a folder of its own, for evaluate. A run that gives no score is reported, and the others go on; the
exit code is then 1."""

# All objects count that the scanner saw moving, as in the thesis, also those gone in a moment.
SCORE_OPTIONS = ("truth/least_time_seen=0", "truth/visible_to=scanner")


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
    print(thesis_tables([report for report, _ in results]))
    failures = [str(error) for _, error in results if error is not None]
    print("\n" + "\n".join(failures or [f"bags and scores: {values.out}"]))
    return not failures


def _run(scene, values):
    """The report and None, or None and why there is none."""
    folder = values.out / scene.stem
    drive = simulated_run.SimulatedDrive(scene)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return simulated_run.run(drive, values.programs, values.config, folder, SCORE_OPTIONS), None
    except (StepFailed, OSError) as error:
        return None, f"{scene.stem}: {error}"


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
    return parser
