# SPDX-License-Identifier: BSD-3-Clause
"""Compares the levels of fusion on the same drives: the command line and the runs."""

import json
import os
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import NamedTuple, Optional

from tqdm import tqdm

from datmo_tools import command_line, programs
from datmo_tools.errors import InputError
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.camera_view import LIST_PARAMETERS, camera_view
from datmo_tools.experiments.fusion_comparison import comparison_table, figures, objects_table
from datmo_tools.experiments.fusion_drives import (
    COMBINATIONS, LEVELS, Kitti, data_sets, within)  # fmt: skip
from datmo_tools.experiments.fusion_plot import comparison_plot
from datmo_tools.programs import StepFailed
from datmo_tools.whole_files import write_whole

DESCRIPTION = """\
Drives the scenes data_set_1 to data_set_3, simulated with a stereo camera (10 MB for each second)
and several seeds, and a labeled KITTI drive, if there is one, through the stack at several levels
of fusion, and prints the results for their moving objects next to the thesis's table 3.2. Each
drive is recorded once, for all levels. Bags and scores of each are kept in a separate folder, for
evaluate, all figures in comparison.json, and a picture of them in comparison.svg. A run without a
score is reported, and the others continue; the exit code is then 1."""


class Result(NamedTuple):
    """The result of one drive at one level."""

    drive: object  # of fusion_drives
    level: str  # of LEVELS or COMBINATIONS
    figures: Optional[dict] = None
    failure: Optional[str] = None


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    complete = []
    code = command_line.run("compare_fusion", lambda: complete.append(_compare(values)), "table")
    return code or int(not complete[0])


def _compare(values):
    """Whether all runs have a score."""
    drives, notes = _drives(values)
    views = {drive.config: camera_view(drive.config, values.programs) for drive in drives}
    results = _run_all(drives, views, values)
    print(comparison_table(_table_rows(results)))
    for drive in drives:
        # The thesis counts them; in a labeled drive each one can be inspected.
        if drive.published is None:
            runs = [(item.level, item.figures) for item in results if item.drive is drive]
            title = f"Moving objects of {drive.name}: tracked in so many of their frames, %"
            print(f"\n{title}\n{objects_table(runs)}")
    pictures = [(result.drive.name, result.level, result.figures) for result in results]
    write_whole(values.out, {"comparison.json": _as_json(results),
                             "comparison.svg": comparison_plot(pictures, "svg")})  # fmt: skip
    # If the recording of a drive fails, all its levels have the same message.
    failures = [result.failure for result in results if result.failure is not None]
    where = f"bags, scores, comparison.json and comparison.svg: {values.out}"
    closing = [*notes, *dict.fromkeys(failures), where]
    print("\n" + "\n".join(closing))
    return not failures


def _table_rows(results):
    """Returns one row for each drive and level, with the figures of all seeds."""
    rows = {}
    for result in results:
        row = rows.setdefault((result.drive.name, result.level), (result.drive.published, []))
        if result.figures is not None:
            row[1].append(result.figures)
    return [(name, published, level, runs) for (name, level), (published, runs) in rows.items()]


def _drives(values):
    """Returns the drives, and notes on missing ones."""
    programs.check(values.programs, [*simulated_run.STEPS, LIST_PARAMETERS])
    drives, notes = data_sets(values.scenes, values.config, values.sets, dict.fromkeys(values.seeds)), []
    for file in [drive.scene for drive in drives] + [values.config, values.kitti_config]:
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a yaml file")
    if values.kitti.is_dir():
        programs.check(values.programs, ["kitti_to_bag"])
        drives.append(Kitti(values.kitti, values.kitti_config))
    else:
        notes.append(f"{values.kitti}: not found, so there is no KITTI drive (--kitti sets one)")
    return drives, notes


def _run_all(drives, views, values):
    """Returns the results of all drives at all levels, in this order.

    views: of their cameras (CameraView), by sensor set.
    """
    with ThreadPoolExecutor(values.jobs) as pool:
        # Workers take what was submitted first: a level that waits for a recording waits for one in
        # progress.
        recordings = [pool.submit(_record, drive, values) for drive in drives]
        runs = [
            pool.submit(_run, drive, level, recording, views[drive.config], values)
            for drive, recording in zip(drives, recordings)
            for level in values.levels
        ]
        try:
            for _ in tqdm(as_completed(runs), "runs", len(runs)):
                pass
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return [run.result() for run in runs]


def _record(drive, values):
    """Returns the drive's bag (Path)."""
    recorded = values.out / drive.folder_name / "drive.bag"
    if not (values.reuse_drives and recorded.is_file()):
        recorded.parent.mkdir(parents=True, exist_ok=True)
        drive.record(values.programs, recorded)
    return recorded


def _run(drive, level, recording, view, values):
    """Returns the Result of one drive at one level."""
    try:
        recorded = recording.result()
    except (StepFailed, OSError) as error:
        return Result(drive, level, failure=f"{drive.folder_name}: {error}")
    folder = recorded.parent / level
    try:
        folder.mkdir(exist_ok=True)
        found = _figures(drive, level, recorded, folder, view, values)
        return Result(drive, level, found)
    except (StepFailed, OSError) as error:
        return Result(drive, level, failure=f"{drive.folder_name}, {level}: {error}")


def _figures(drive, level, recorded, folder, view, values):
    built, times = values.programs, folder / "times.json"
    report = simulated_run.run_recorded(
        recorded, built, drive.config, folder, drive.score_options,
        # One thread: times of all stages, matching included.
        (*{**LEVELS, **COMBINATIONS}[level], "--times", times, "--jobs", 1))  # fmt: skip
    wide_report = drive.wide_score_options and simulated_run.score(
        folder / "result.bag", built, drive.wide_score_options, folder / "score_any_sensor.json")
    view_report = simulated_run.score(
        folder / "result.bag", built, within(view, drive.score_options),
        folder / "score_in_view.json")  # fmt: skip
    return figures(report, wide_report, view_report,
                   json.loads(times.read_text(encoding="utf-8")))  # fmt: skip


def _as_json(results):
    runs = [
        {"drive": result.drive.name, "run": result.drive.folder_name, "level": result.level,
         "failure": result.failure, "figures": result.figures}
        for result in results
    ]  # fmt: skip
    return json.dumps({"runs": runs}, indent=2) + "\n"


def _parser():
    parser = command_line.new_parser("compare_fusion", DESCRIPTION)
    add = parser.add_argument
    add("--scenes", required=True, type=Path, metavar="DIR", help="folder of the scenes")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml",
        help="the sensor set of the scenes")  # fmt: skip
    add("--kitti", required=True, type=Path, metavar="DRIVE",
        help="folder ..._drive_NUMBER_sync; skipped if it does not exist")  # fmt: skip
    add("--kitti-config", required=True, type=Path, metavar="CONFIG.yaml", help="its sensor set")
    add("--programs", required=True, type=Path, metavar="DIR",
        help="folder of simulate, run_bag, score_run and kitti_to_bag")  # fmt: skip
    add("--levels", nargs="+", choices=[*LEVELS, *COMBINATIONS], default=list(LEVELS),
        help="levels of fusion (default: each without and with road borders)")  # fmt: skip
    add("--seeds", nargs="+", type=int, default=[1, 2, 3, 4, 5], metavar="SEED",
        help="of the simulated drives (default: 1 to 5)")  # fmt: skip
    numbers = list(range(1, len(PUBLISHED) + 1))
    add("--sets", nargs="*", type=int, choices=numbers, default=numbers,
        help="data sets (default: all)")  # fmt: skip
    add("--jobs", type=command_line.count, default=os.cpu_count(), metavar="N",
        help="parallel runs (default: all cores)")  # fmt: skip
    add("--reuse-drives", action="store_true",
        help="reuse the recordings of an earlier run in the folder")  # fmt: skip
    add("--out", type=command_line.output_folder, default=Path("compare_fusion"), metavar="DIR",
        help="for bags and scores (default %(default)s)")  # fmt: skip
    return parser
