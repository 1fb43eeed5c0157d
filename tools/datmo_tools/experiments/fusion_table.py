# SPDX-License-Identifier: BSD-3-Clause
"""Compares the simulated data sets without and with low-level fusion, side by side."""

from typing import NamedTuple

from datmo_tools.text_table import NO_VALUE, aligned, percent, rounded

IN_VIEW = "in view"  # column of evaluate grids

IMAGE_MATCHING = "stereo_image_proc"  # stage of run_bag


class FusionRuns(NamedTuple):
    """Two runs on one data set."""

    alone: dict  # report of score_run, scanner only
    fused: dict
    times: dict  # of run_bag, scanner only
    fused_times: dict
    grids: dict  # of evaluate grids, with fusion


# Heading, and the value in the report of score_run, as a function of it.
RUN_COLUMNS = (
    ("false moving objects", lambda report: report["thesis"]["false_moving_objects_episodes"]),
    ("in a scan", lambda report: rounded(report["thesis"]["false_moving_objects_frames"], 2)),
    ("moving objects missed", lambda report: report["thesis"]["missed_objects"]),
    ("tracks", lambda report: report["thesis"]["tracks"]),
    ("of them false", lambda report: report["thesis"]["false_tracks"]),
    ("MOTA, %", lambda report: percent(report["clear_mot"]["mota"])),
    ("end point, % of the distance", lambda report: percent(report["pose"]["end_error_share"], 2)),
)

# The same in the score of evaluate grids: percent of the cells, or poles, in the camera's view.
GRID_COLUMNS = (
    ("paint cells gone, %", "paint_gone"),
    ("obstacle cells lost, %", "bodies_lost"),
    ("thin poles in lidar grid, %", "poles_in_lidar"),
    ("in fused grid, %", "poles_in_fused"),
)

NOTE = """\
Low-level fusion: the scanner alone, and fused with the stereo camera. Shares of cells and poles are
of those in the camera's view; time is the mean of all stages together, for one scan."""


def fusion_table(results):
    """Returns the text of the table.

    results: FusionRuns, one for each data set in order; None if a run failed.
    """
    rows = [["data set", "sensors", *(heading for heading, _ in RUN_COLUMNS), "time, ms"]]
    for number, runs in enumerate(results, start=1):
        pair = (None, None) if runs is None else (runs.alone, runs.fused)
        times = (None, None) if runs is None else (runs.times, runs.fused_times)
        for name, report, stages in zip(("scanner", "fused"), pair, times):
            rows.append([str(number), name, *_cells(report), _time(stages)])
    grids = [["data set", *(heading for heading, _ in GRID_COLUMNS)]]
    for number, runs in enumerate(results, start=1):
        shares = [NO_VALUE if runs is None else _share(runs.grids, key) for _, key in GRID_COLUMNS]
        grids.append([str(number), *shares])
    return "\n\n".join([NOTE, aligned(rows), aligned(grids)])


def _cells(report):
    return [NO_VALUE if report is None else str(value(report)) for _, value in RUN_COLUMNS]


def time_per_scan(stages):
    """Returns the mean time (ms) of all stages together for one scan, from run_bag --times.

    Without the matching of image pairs, as points are a camera's output.
    """
    stages = {name: stage for name, stage in stages.items() if name != IMAGE_MATCHING}
    total = sum(stage["mean_s"] * stage["runs"] for stage in stages.values())
    return 1e3 * total / stages["grid_slam"]["runs"]


def _time(stages):
    return NO_VALUE if stages is None else f"{time_per_scan(stages):.1f}"


def _share(grids, key):
    column = grids["columns"].index(IN_VIEW)
    share, of = grids[key]["percent"][column], grids[key]["of"][column]
    return NO_VALUE if share is None else f"{share:.1f} of {of}"
