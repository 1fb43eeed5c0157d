# SPDX-License-Identifier: BSD-3-Clause
"""Compares the simulated data sets without and with road borders, side by side."""

from typing import NamedTuple

from datmo_tools.evaluate.border_comparison import comparison
from datmo_tools.experiments.fusion_table import time_per_scan
from datmo_tools.text_table import NO_VALUE, aligned, percent, rounded


class BorderRuns(NamedTuple):
    """Two runs on one data set."""

    alone: dict  # report of score_run, without borders
    with_borders: dict
    times: dict  # of run_bag, without borders
    border_times: dict
    borders: dict  # of evaluate borders


NOTE = """\
Borders of the road: without, and with them. Fewer: of the false moving objects, all and in a scan.
Lost: true moving objects that are tracked without borders and not with them; frames: of tracked true
moving objects. Time is the mean of all stages together, for one scan."""

BORDERS_NOTE = """\
The borders against the truth, within 20 m ahead of the vehicle on straight roads and in curves:
share that is found within 1 m, and root mean square of the error; from 10 m behind to 40 m ahead:
share of the errors within the 95 % gate of the published sigma; false: of what is published."""

HEADINGS = ("false moving objects", "in a scan", "fewer, %", "in a scan, fewer, %", "tracks",
            "of them false", "missed", "lost", "frames", "time, ms")  # fmt: skip

BORDER_HEADINGS = ("found, straight, %", "curve, %", "RMS, straight, m", "curve, m", "in gate, %",
                   "false, %")  # fmt: skip

NEAR_BAND = [0.0, 20.0]  # m, of evaluate borders


def border_runs_table(results):
    """Returns the text of the tables.

    results: BorderRuns, one for each data set in order; None if a run failed.
    """
    rows = [["data set", "borders", *HEADINGS]]
    errors = [["data set", *BORDER_HEADINGS]]
    for number, runs in enumerate(results, start=1):
        for name, cells in zip(("without", "with"), _cells(runs)):
            rows.append([str(number), name, *cells])
        errors.append([str(number), *_border_cells(runs)])
    return "\n\n".join([NOTE, aligned(rows), BORDERS_NOTE, aligned(errors)])


def _cells(runs):
    if runs is None:
        return [[NO_VALUE] * len(HEADINGS)] * 2
    compared = comparison(runs.alone, runs.with_borders)
    fewer = [percent(compared["reduction"][key]) for key in
             ("false_moving_objects_episodes", "false_moving_objects_frames")]  # fmt: skip
    return [
        _run_cells(compared, "without", [NO_VALUE] * 2, NO_VALUE, runs.times),
        _run_cells(compared, "with", fewer, str(len(compared["lost"])), runs.border_times),
    ]


def _run_cells(compared, name, fewer, lost, times):
    counts = compared[name]
    return [
        str(counts["false_moving_objects_episodes"]),
        rounded(counts["false_moving_objects_frames"], 2),
        *fewer,
        str(counts["tracks"]),
        str(counts["false_tracks"]),
        str(counts["missed_objects"]),
        lost,
        str(compared["tracked_frames"][name]),
        f"{time_per_scan(times):.1f}",
    ]


def _border_cells(runs):
    if runs is None:
        return [NO_VALUE] * len(BORDER_HEADINGS)
    groups, near = runs.borders["borders"], runs.borders["bands_m"].index(NEAR_BAND)
    sorts = [groups[name][near] for name in ("straight", "curve")]
    return [
        *(percent(item["found_share"]) for item in sorts),
        *(rounded(item["rms_m"], 2) for item in sorts),
        percent(groups["all"][-1]["in_gate_95"]),
        percent(runs.borders["false"]["false_share"]),
    ]
