# SPDX-License-Identifier: BSD-3-Clause
"""Runs as score_run writes them, small enough to be checked by eye, for the tests of evaluate."""

import json

PERIOD = 0.06  # s


def whole(key):
    """Returns the consistency of a state with `key` as its mean NEES."""
    return {
        "mean_nees": key,
        "dof": 2,
        "samples": 8,
        "unusable": 0,
        "lower": 1.0,
        "upper": 3.3,
        "inside_share": 0.9,
    }


def sample_object(number, found=True, label="Car"):
    """Returns one true object of 10 frames that was tracked in 8 of them, by two ids, or never."""
    return {
        "id": number, "label": label, "class": "vehicle",
        "first_s": 0.0, "last_s": 9 * PERIOD, "required_frames": 10,
        "tracked_frames": 8 if found else 0, "found": found,
        "delay_s": 2 * PERIOD if found else None, "completeness": 0.8 if found else 0.0,
        "attainable_delay_s": PERIOD, "excess_delay_s": PERIOD if found else None,
        "delay_ratio": 1.5 if found else None, "beams_per_scan": 2.5,
        "track_ids": [70 + number, 80 + number] if found else [],
        "position_rmse_m": 0.25 if found else None,
        "velocity_rmse_mps": 0.5 if found else None,
        "heading_rmse_rad": 0.1 if found else None,
    }  # fmt: skip


def sample_delays():
    """Returns figures of delays beside the attainable ones."""
    return {
        "objects": 1, "detectable": 1, "detectable_but_missed": 0,
        "attainable_s": {"median": PERIOD, "p90": PERIOD},
        "delay_s": {"median": 2 * PERIOD, "p90": 2 * PERIOD},
        "excess_s": {"median": PERIOD, "p90": PERIOD}, "ratio": {"median": 1.5, "p90": 1.5},
    }  # fmt: skip


def sample_path(item, frames):
    """Returns a true path along y = its id; each of its tracks takes two fifths of the frames."""
    parts = [None, *(item["track_ids"] or [None, None])]
    followed = [parts[(10 * i // frames + 2) // 4] for i in range(frames)]
    return {
        "id": item["id"], "label": item["label"],
        "time_s": [i * PERIOD for i in range(frames)],
        "x_m": [0.6 * i for i in range(frames)], "y_m": [float(item["id"])] * frames,
        "track_id": followed, "required": [True] * frames,
    }  # fmt: skip


def sample_series(objects, frames):
    """Returns series over all frames; no object is matched in the first fifth of them."""
    times = [i * PERIOD for i in range(frames)]
    error = [None if 10 * i < 2 * frames else 0.2 + 0.01 * (i % 7) for i in range(frames)]
    found = sum(item["found"] for item in objects)
    tracked = [0 if value is None else found for value in error]
    distance = [0.5 * i for i in range(frames)]
    return {
        "time_s": times, "true_objects": [len(objects)] * frames, "tracked": tracked,
        "missed": [len(objects) - count for count in tracked],
        "false": [i % 2 for i in range(frames)],
        "position_error_m": error, "velocity_error_mps": error, "gospa_m": [1.0] * frames,
        "pose_error_m": [0.001 * i for i in range(frames)],
        "true_paths": [sample_path(item, frames) for item in objects],
        "track_paths": [
            {"id": number, "time_s": times, "x_m": distance, "y_m": [number - 69.5] * frames}
            for number in (71, 81, 99)
        ],
        "ego_true": {"x_m": distance, "y_m": [0.0] * frames},
        "ego_estimated": {"x_m": distance, "y_m": [0.1] * frames},
    }  # fmt: skip


def sample_run(name="drive.bag", objects=2, frames=10, label="Car", **changes):
    """Returns a run in which the last object is missed. changes: by section, what differs."""
    items = [sample_object(number, number < objects, label) for number in range(1, objects + 1)]
    run = {
        "format": 1, "run": name, "truth": "truth.bag",
        "options": {"gate": 2.0, "region/range": 50.0, "classes": ""},
        "duration_s": frames * PERIOD, "frames": frames, "truth_objects": objects, "tracks": 3,
        "messages_left_out": 0, "false_movers_per_frame": 0.2,
        "clear_mot": {"mota": 0.4, "motp_m": 0.25, "misses": 12, "false_positives": 5,
                      "id_switches": 1, "fragmentations": 0, "required": 20, "matches": 8,
                      "mostly_tracked": 0.5, "mostly_lost": 0.5},
        "identity": {"idf1": 0.3, "idp": 0.31, "idr": 0.2},
        "hota": {"hota": 0.35, "deta": 0.4, "assa": 0.5, "loca": 0.9,
                 "alphas": [i / 20 for i in range(1, 20)],
                 "hota_alpha": [0.5 - i / 60 for i in range(1, 20)]},
        "gospa": {"mean_m": 2.5, "localization_m": 0.4, "missed_m": 1.6, "false_m": 0.5,
                  "cutoff_m": 5.0},
        "errors": {"position_rmse_m": 0.25, "velocity_rmse_mps": 0.5, "heading_rmse_rad": 0.1,
                   "heading_modulo_pi_rmse_rad": 0.05, "samples": 8},
        "near_errors": {"range_m": 20.0, "position_rmse_m": 0.15, "velocity_rmse_mps": 0.3,
                        "heading_rmse_rad": 0.1, "heading_modulo_pi_rmse_rad": 0.05, "samples": 4},
        "classes": {"right_share": 0.75, "frames": 8, "right": 6, "silent": 1,
                    "by_class": {name: {"right_share": share, "frames": 4, "right": int(4 * share),
                                        "silent": 0}
                                 for name, share in (("pedestrian", 0.75), ("cyclist", 0.5),
                                                     ("vehicle", 1.0))}},
        "delay": {"mean_s": 2 * PERIOD, "median_s": 2 * PERIOD, "objects": 1},
        "attainable": {**sample_delays(), "by_class": {
            name: sample_delays() for name in ("pedestrian", "cyclist", "vehicle")}},
        "consistency": {"position": whole(2.2), "velocity": whole(7.5)},
        "objects": items,
        "standing_objects": [{"id": 50, "label": label, "class": "vehicle", "frames": 9,
                              "tracked_frames": 4}],
        "thesis": {"moving_objects": objects, "missed_objects": 1, "tracks": 3, "false_tracks": 1,
                   "confirmed_tracks": 0, "confirmed_true_tracks": 0,
                   "false_moving_objects_frames": 0.5, "false_moving_objects_episodes": 2,
                   "intersections": None, "intersections_found": None,
                   "intersections_false": None},
        "pose": {"end_error_m": 0.01, "end_error_deg": 0.2, "path_length_m": 4.5, "end_error_share": 0.002,
                 "position_rmse_m": 0.005, "heading_rmse_rad": 0.002, "largest_jump_m": 0.003,
                 "relative": [{"distance_m": 10.0, "translation_m": 0.05, "rotation_deg": 0.1,
                               "pairs": 4}],
                 "mean_nees": 2.5, "dof": 3, "unusable": 0},
        "timing": {"grid_slam": {"median_ms": 0.4, "p99_ms": 0.9, "worst_ms": 1.7,
                                 "latency": None},
                   "tracker": {"median_ms": 0.1, "p99_ms": 0.2, "worst_ms": 0.3,
                               "latency": {"median_ms": 1.1, "p99_ms": 2.2, "worst_ms": 3.3}}},
        "series": sample_series(items, frames),
    }  # fmt: skip
    for section, values in changes.items():
        run[section] = {**run[section], **values} if isinstance(values, dict) else values
    return json.loads(json.dumps(run))
