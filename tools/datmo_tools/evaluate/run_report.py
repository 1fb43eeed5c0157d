# SPDX-License-Identifier: BSD-3-Clause
"""Creates the sections of evaluate tracks: of one run, or of several side by side."""

import json

from datmo_tools.evaluate import object_plots, plots
from datmo_tools.evaluate.metric_groups import (
    METRIC_GROUPS,
    OBJECT_METRICS,
    STANDING_METRICS,
    metric_groups,
)
from datmo_tools.evaluate.metrics import best_runs, extent, short_names
from datmo_tools.evaluate.report import BEST, MISSED, Section

TILES = {
    "hota.hota": "HOTA",
    "clear_mot.mota": "MOTA",
    "identity.idf1": "IDF1",
    "errors.position_rmse_m": "error of position",
    "errors.velocity_rmse_mps": "error of velocity",
    "pose.end_error_m": "pose at the end",
}


def sections(runs):
    """Returns a list of Section on runs that score_run has scored (dicts)."""
    names = short_names([run["run"] for run in runs])
    of_each = [section for run, name in zip(runs, names) for section in _of_one_run(run, name, runs)]
    of_all = list(_of_all_runs(runs, names))
    return [
        _summary(runs, names),
        *([_tiles(runs[0])] if len(runs) == 1 else []),
        *_metrics(runs, names),
        *(of_each + of_all if len(runs) == 1 else of_all + of_each),
        Section("Options", "As given to score_run, or its defaults.", for_page=True,
                rows=[("option", "value"), *_options(runs[0])]),
    ]  # fmt: skip


def _of_all_runs(runs, names):
    """Yields what shows all runs in one picture."""
    yield Section(
        "Errors over time",
        "Of the true objects that count and have a track; no line where there is none.",
        picture=plots.errors_over_time(runs, names),
    )
    yield Section(
        "HOTA by threshold",
        "How the score falls as matches have to be closer; a steep fall means that tracks are on "
        "the objects, but inaccurate.",
        picture=plots.hota_over_alpha(runs, names),
    )
    yield Section(
        "Is the covariance consistent?",
        "Mean NEES (dot) against its expectation (line) and the 95 % bounds of the mean of a "
        "consistent filter (bar, where given). To the right the covariance is too small, to the left "
        "too large.",
        picture=plots.consistency(runs, names),
    )
    yield Section(
        "Pose of the vehicle",
        "The maps of the run and of the truth, aligned at the first pose.",
        picture=plots.pose_over_time(runs, names),
    )
    if any(run.get("timing") for run in runs):
        yield Section(
            "Time of each stage",
            "For one message: median (dot), 99th percentile (bar), worst (end of the line).",
            picture=plots.stage_times(runs, names),
        )


def _of_one_run(run, name, runs):
    """Yields what needs a picture for each run."""
    of = f": {name}" if len(runs) > 1 else ""
    yield Section(
        "Who was tracked when" + of,
        "When a true object has to be found: with a track on it (blue; another color where "
        "another track takes over; the number is its id), or without (red). Pale: a track on it "
        "while it does not have to be found.",
        picture=object_plots.timeline(run),
    )
    yield Section("Tracked, missed, false" + of, picture=plots.counts_over_time(run))
    yield Section(
        "Seen from above" + of,
        "In the map of the truth. Wide and gray: true objects, with their ids where they first appear.",
        picture=object_plots.birds_eye(run),
    )
    yield Section(
        "Objects" + of,
        "Delay: from the first frame in which the object has to be found to its first track.",
        _objects(run),
    )
    yield Section(
        "Tracks on objects that never move" + of,
        f"Of {len(run['standing_objects'])} parked cars and the like that the truth knows, these "
        "had a track at times, which is false.",
        _standing(run),
        for_page=True,
    )


def _summary(runs, names):
    lines = [f"run    {name}  {run['run']}: {extent(run)}" for run, name in zip(runs, names)]
    lines.append(f"truth  {runs[0]['truth']}: {runs[0]['truth_objects']} objects")
    for run, name in zip(runs, names):
        standing = run["standing_objects"]
        tracked = sum(item["tracked_frames"] > 0 for item in standing)
        lines.append(
            f"{name}: of {len(standing)} objects that never move {tracked} had a track at times"
        )
    if len(runs) > 1:
        lines.append(f"{BEST} best of the runs; figures that look the same are equally good")
    return Section(lines=lines)


def _tiles(run):
    """Returns the figures that most readers look for first."""
    found = sum(item["found"] for item in run["objects"])
    tiles = [("objects found", f"{found} of {len(run['objects'])}", "")]
    metrics = {metric.path: metric for group in METRIC_GROUPS for metric in group.metrics}
    for path, name in TILES.items():
        metric = metrics[path]
        tiles.append((name, metric.text(metric.value(run)), metric.unit))
    return Section(tiles=tiles)


def _metrics(runs, names):
    """Yields a section for each group; a column for each run."""
    heads = names if len(runs) > 1 else [""]
    for group in metric_groups(runs):
        rows = [[metric.name, metric.unit, *_values(metric, runs)] for metric in group.metrics]
        yield Section(group.title, group.source, [["", "", *heads], *rows],
                      is_narrow=len(runs) < 3)  # fmt: skip


def _values(metric, runs):
    best = best_runs(metric, runs)
    return [
        metric.text(metric.value(run)) + (BEST if i in best else "") for i, run in enumerate(runs)
    ]


def _objects(run):
    names, units = _headings(OBJECT_METRICS)
    rows = [[*names, "its tracks"], [*units, "ids"]]
    for item in run["objects"]:
        tracks = " ".join(map(str, item["track_ids"])) if item["found"] else MISSED
        rows.append([*_of_object(item, OBJECT_METRICS), tracks])
    return rows


def _standing(run):
    rows = _headings(STANDING_METRICS)
    tracked = [item for item in run["standing_objects"] if item["tracked_frames"] > 0]
    return rows + [_of_object(item, STANDING_METRICS) for item in tracked]


def _headings(metrics):
    names, units = (metric.name for metric in metrics), (metric.unit for metric in metrics)
    return [["id", "object", "class", *names], ["", "", "", *units]]


def _of_object(item, metrics):
    values = [metric.text(metric.value(item)) for metric in metrics]
    return [str(item["id"]), item["label"], item["class"], *values]


def _options(run):
    return [(key, json.dumps(value)) for key, value in sorted(run["options"].items())]
