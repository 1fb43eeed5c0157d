# SPDX-License-Identifier: BSD-3-Clause
"""The figures of runs at several levels of fusion, and their table."""

import statistics

from datmo_tools.experiments.fusion_table import time_per_scan
from datmo_tools.spread import spread
from datmo_tools.text_table import NO_VALUE, aligned, percent, spread_text

NOTE = """\
Levels of fusion: none, the scanner alone; low, grids of scanner and stereo camera (thesis 3.2);
object, objects of both (thesis 3.3); track, tracks of both (thesis 3.4); borders: with those of the
road; recommended: track, with borders. For several seeds, the figure is the median, with minimum and
maximum in parentheses. Missed: moving objects that
no track ever matched, of those that the scanner saw moving, however briefly, and, by any, of those
that either sensor did; of a labeled drive, of all that move in the camera's view. Beside it what the
thesis missed without and with fusion of objects (table 3.2): its data sets were driven, ours are
simulated streets with as many seconds and moving objects. False: tracks on nothing that moves;
false, in view: the same within the stereo camera's range and field of view. RMSE: of the position of
matched tracks, and, near, of those within 20 m. Class right: of the frames of matched tracks. Delay:
from the first frame in which an object has to be found to its first track, mean of those that were
found. Time: mean of all stages together for one scan, without the matching of images."""

# Levels at which the thesis has a count: its field in Published.
THESIS_MISSED = {"none": "missed", "object": "missed_with_fusion"}

# The counts that MOTA is made of, so that drives can be combined.
MOTA_COUNTS = ("required", "misses", "false_positives", "id_switches")

# What is kept for each moving object.
OBJECT_KEYS = ("id", "label", "class", "first_s", "last_s", "required_frames", "tracked_frames",
               "track_ids", "delay_s")  # fmt: skip


def figures(report, wide_report, view_report, stages):
    """Returns the figures of one run, as a dictionary that JSON can hold; None for missing ones.

    report: of score_run; wide_report: the same with objects that any sensor sees, or None;
    view_report: the same only within the camera's view; stages: of run_bag --times.
    """
    counts = report["thesis"]
    wide = wide_report["thesis"] if wide_report else {}
    return {
        "moving_objects": counts["moving_objects"],
        "missed_objects": counts["missed_objects"],
        "moving_objects_any_sensor": wide.get("moving_objects"),
        "missed_objects_any_sensor": wide.get("missed_objects"),
        "tracks": counts["tracks"],
        "false_tracks": counts["false_tracks"],
        "false_tracks_in_view": view_report["thesis"]["false_tracks"],
        **{key: report["clear_mot"][key] for key in ("mota", *MOTA_COUNTS)},
        "idf1": report["identity"]["idf1"],
        "position_rmse_m": report["errors"]["position_rmse_m"],
        "near_position_rmse_m": report["near_errors"]["position_rmse_m"],
        "class_right_share": report["classes"]["right_share"],
        "mean_delay_s": report["delay"]["mean_s"],
        "time_per_scan_ms": time_per_scan(stages),
        "objects": [{key: item[key] for key in OBJECT_KEYS} for item in report["objects"]],
    }


def comparison_table(rows):
    """Returns the text of the table.

    rows: (name of the drive, Published or None, level, list of figures(), for each seed that has
    any).
    """
    headings = ["drive", "level", "thesis missed", *(heading for heading, _ in _COLUMNS)]
    lines = [headings]
    for name, published, level, runs in rows:
        cells = [cell(runs) if runs else NO_VALUE for _, cell in _COLUMNS]
        lines.append([name, level, _thesis_missed(published, level), *cells])
    return f"{NOTE}\n\n{aligned(lines)}"


def objects_table(runs):
    """Returns the text of a table of the moving objects of one drive, with the share of their
    frames in which they were tracked (%).

    runs: (level, figures() or None if the run failed), of one drive or more.
    """
    known = [(level, run) for level, run in runs if run is not None]
    objects = {item["id"]: item for _, run in known for item in run["objects"]}
    rows = [["object", "from, s", "to, s", "frames", *(level for level, _ in known)]]
    for number, item in objects.items():
        cells = [f"{item['label']} {number}", f"{item['first_s']:.1f}", f"{item['last_s']:.1f}"]
        cells.append(str(item["required_frames"]))
        rows.append(cells + [_tracked(run["objects"], number) for _, run in known])
    return aligned(rows)


def _tracked(objects, number):
    """Returns the share of the frames, and the number of tracks if it is not one."""
    item = next((item for item in objects if item["id"] == number), None)
    if item is None:
        return NO_VALUE
    share = percent(item["tracked_frames"] / item["required_frames"])
    ids = len(item["track_ids"])
    return share if ids <= 1 else f"{share} ({ids} ids)"


def _spread(key, digits=0, scale=1.0):
    return lambda runs: spread_text(spread(run[key] for run in runs), digits, scale)


def _of(count, total):
    def cell(runs):
        counts = _spread(count)(runs)
        if counts == NO_VALUE:
            return NO_VALUE
        return f"{counts} of {statistics.median_high(run[total] for run in runs)}"

    return cell


def _percent(key):
    return _spread(key, 1, 100.0)


_COLUMNS = (
    ("missed", _of("missed_objects", "moving_objects")),
    ("by any", _of("missed_objects_any_sensor", "moving_objects_any_sensor")),
    ("tracks", _spread("tracks")),
    ("of them false", _spread("false_tracks")),
    ("false, in view", _spread("false_tracks_in_view")),
    ("MOTA, %", _percent("mota")),
    ("IDF1, %", _percent("idf1")),
    ("RMSE, m", _spread("position_rmse_m", 2)),
    ("near", _spread("near_position_rmse_m", 2)),
    ("class right, %", _percent("class_right_share")),
    ("delay, s", _spread("mean_delay_s", 2)),
    ("time, ms", _spread("time_per_scan_ms", 1)),
)


def _thesis_missed(published, level):
    field = THESIS_MISSED.get(level)
    return NO_VALUE if published is None or field is None else str(getattr(published, field))
