# SPDX-License-Identifier: BSD-3-Clause
"""Step data_sets: simulated data sets with several seeds, without and with borders, as in the
thesis."""

import statistics
from functools import partial

from datmo_tools.evaluate.border_comparison import comparison
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.border_runs import NEAR_BAND
from datmo_tools.experiments.data_sets import SCORE_OPTIONS
from datmo_tools.spread import pooled_counts, spread_of
from datmo_tools.figures.step import Job

NUMBERS = range(len(PUBLISHED), 0, -1)  # the longest first

# Name of a figure -> its keys in score_run's report.
COUNTS = {
    "moving_objects": ("thesis", "moving_objects"),
    "missed_objects": ("thesis", "missed_objects"),
    "tracks": ("thesis", "tracks"),
    "false_tracks": ("thesis", "false_tracks"),
    "false_object_episodes": ("thesis", "false_moving_objects_episodes"),
    "intersections": ("thesis", "intersections"),
    "intersections_found": ("thesis", "intersections_found"),
    "intersections_false": ("thesis", "intersections_false"),
    "required": ("clear_mot", "required"),
    "misses": ("clear_mot", "misses"),
    "false_positives": ("clear_mot", "false_positives"),
    "id_switches": ("clear_mot", "id_switches"),
}
SHARES = {
    "mota": ("clear_mot", "mota"),
    "idf1": ("identity", "idf1"),
    "hota": ("hota", "hota"),
    "false_objects_in_scan": ("thesis", "false_moving_objects_frames"),
    "position_rmse_m": ("errors", "position_rmse_m"),
    "velocity_rmse_mps": ("errors", "velocity_rmse_mps"),
    "position_nees": ("consistency", "position", "mean_nees"),
    "pose_end_error_share": ("pose", "end_error_share"),
}

POOLED = ("moving_objects", "missed_objects", "tracks", "false_tracks", "id_switches")
CLASSES = ("vehicle", "cyclist", "pedestrian")


def jobs(bench):
    """Returns a job for each data set and seed."""
    return [
        Job(f"{number}_{seed}", partial(_measure, bench, number, seed))
        for number in NUMBERS
        for seed in bench.seeds
    ]


def figures(results):
    """Returns for each set, and for all sets combined, the spread over the seeds."""
    by_set, by_seed = {}, {}
    for result in results:
        by_set.setdefault(str(result["set"]), []).append(result["figures"])
        by_seed.setdefault(result["seed"], []).append(result)
    return {
        "sets": {name: spread_of(items) for name, items in sorted(by_set.items())},
        "all": spread_of([pooled(items) for items in by_seed.values()]),
    }


def pooled(results):
    """Combines the figures of all sets with one seed, as if they were one drive."""
    modes = results[0]["figures"]["runs"]
    runs = {
        mode: _pooled_counts([item["figures"]["runs"][mode] for item in results]) for mode in modes
    }
    objects = [item for result in results for item in result["objects"]]
    delays = {
        name: _delays([item for item in objects if name in ("all", item["class"])])
        for name in ("all", *CLASSES)
    }
    return {"runs": runs, "delays": delays}


def _pooled_counts(runs):
    total = pooled_counts(runs, [key for key in COUNTS if runs[0][key] is not None])
    return {key: total[key] for key in (*POOLED, "mota")}


def _delays(objects):
    """Returns the delay from the first frame in which an object has to be found to its first track,
    and the minimum: medians of the objects that were found."""
    return {
        "objects": len(objects),
        "found": sum(item["found"] for item in objects),
        **{key: _median(objects, key) for key in ("delay_s", "attainable_delay_s", "delay_ratio")},
    }


def _median(objects, key):
    values = [item[key] for item in objects if item["found"] and item[key] is not None]
    return statistics.median(values) if values else None


def _measure(bench, number, seed, folder):
    drive = simulated_run.SimulatedDrive(bench.scene(f"data_set_{number}"), (f"seed={seed}",))
    simulated_run.record(drive, bench.programs, folder / "drive.bag")
    modes = {
        "without": (),
        "with": ("--road-border",),
        "thesis": ("--road-border", "--preset", bench.config("thesis")),
    }
    reports = {name: _report(bench, folder, name, words) for name, words in modes.items()}
    borders = bench.evaluated(folder, "borders", folder / "with" / "result.bag")
    measured = {
        "runs": {name: _run_figures(report) for name, report in reports.items()},
        "compared": {name: _compared(reports, name) for name in ("with", "thesis")},
        "borders": _border_figures(borders),
    }
    return {"set": number, "seed": seed, "figures": measured, "objects": reports["with"]["objects"]}


def _report(bench, folder, name, words):
    (folder / name).mkdir()
    recorded = folder / "drive.bag"
    return simulated_run.run_recorded(
        recorded, bench.programs, bench.config("demonstrator"), folder / name, SCORE_OPTIONS, words,
        attainable=recorded if name == "with" else None)  # fmt: skip


def _run_figures(report):
    return {name: _at(report, keys) for name, keys in {**COUNTS, **SHARES}.items()}


def _at(tree, keys):
    for key in keys:
        tree = tree[key]
    return tree


def _compared(reports, name):
    """Returns what borders change compared to the run without them."""
    compared = comparison(reports["without"], reports[name])
    return {
        "fewer_false_objects": compared["reduction"]["false_moving_objects_frames"],
        "lost": len(compared["lost"]),
        "tracked_frames_without": compared["tracked_frames"]["without"],
        "tracked_frames": compared["tracked_frames"]["with"],
    }


def _border_figures(scored):
    groups, near = scored["borders"], scored["bands_m"].index(NEAR_BAND)
    return {
        "straight_rms_m": groups["straight"][near]["rms_m"],
        "curve_rms_m": groups["curve"][near]["rms_m"],
        "straight_found": groups["straight"][near]["found_share"],
        "found_by_range": {
            f"{start:g} to {end:g} m": band["found_share"]
            for (start, end), band in zip(scored["bands_m"], groups["all"])
            if start >= 0.0 and [start, end] != NEAR_BAND
        },
        "false_share": scored["false"]["false_share"],
    }
