# SPDX-License-Identifier: BSD-3-Clause
"""Summarizes the runs of the robustness benchmark."""

import statistics

from datmo_tools.text_table import NO_VALUE, aligned, rounded

MAX_JUMP = 1.0  # m; more is a failure

# Heading, key, format of its values.
COLUMNS = (
    ("scene", "scene", "{}"),
    ("movers", "movers", "{}"),
    ("runs", "runs", "{}"),
    ("failed", "failed", "{}"),
    ("rate", "failure_rate", "{:.0%}"),
    ("worst jump", "worst_jump_m", "{:.2f} m"),
)


def summarize(runs):
    """Returns one dictionary for each scene and number of movers, in the order of their first run.

    runs: dictionaries with scene, movers, seed and pose (as in score_run's JSON; None: no score,
    which counts as neither good nor failed). Error and ratio are None if nothing was scored;
    the ratio is the mean relative to that of the same scene without movers.
    """
    groups = {}
    for run in runs:
        groups.setdefault((run["scene"], run["movers"]), []).append(run)
    rows = [_row(scene, movers, group) for (scene, movers), group in groups.items()]
    for row in rows:
        still = next((r for r in rows if r["scene"] == row["scene"] and r["movers"] == 0), None)
        for error in row["relative"]:
            error["ratio"] = _ratio(error, still)
    return rows


def table(summary):
    """Formats a summary."""
    distances = max((row["relative"] for row in summary), key=len)
    heads = [head for item in distances for head in (f"error at {item['distance_m']:.0f} m", "ratio")]
    rows = [[name for name, _, _ in COLUMNS] + heads]
    for row in summary:
        cells = [_text(row[key], form) for _, key, form in COLUMNS]
        for error in row["relative"]:
            cells += [f"{error['translation_m']:.3f} m", rounded(error["ratio"], 2)]
        rows.append(cells)
    return aligned(rows)


def _row(scene, movers, runs):
    poses = [run["pose"] for run in runs if run["pose"] is not None]
    jumps = [pose["largest_jump_m"] for pose in poses]
    failed = [
        run["seed"]
        for run in runs
        if run["pose"] is not None and run["pose"]["largest_jump_m"] > MAX_JUMP
    ]
    return {
        "scene": scene,
        "movers": movers,
        "runs": len(poses),
        "without_score": len(runs) - len(poses),
        "failed": len(failed),
        "failed_seeds": failed,
        "failure_rate": len(failed) / len(poses) if poses else None,
        "worst_jump_m": max(jumps, default=None),
        "relative": _relative(poses),
    }


def _relative(poses):
    """Returns the mean over the runs of the error of relative poses, for each distance."""
    errors = {}
    for pose in poses:
        for error in pose["relative"]:
            if error["translation_m"] is not None:
                errors.setdefault(error["distance_m"], []).append(error)
    return [
        {
            "distance_m": distance,
            "translation_m": statistics.mean(error["translation_m"] for error in same),
            "rotation_deg": statistics.mean(error["rotation_deg"] for error in same),
        }
        for distance, same in sorted(errors.items())
    ]


def _ratio(error, still):
    for other in still["relative"] if still else []:
        if other["distance_m"] == error["distance_m"] and other["translation_m"] > 0.0:
            return error["translation_m"] / other["translation_m"]
    return None


def _text(value, form):
    return NO_VALUE if value is None else form.format(value)
