# SPDX-License-Identifier: BSD-3-Clause
"""Summarizes all recordings of a batch, as one result and as the sections of its report."""

import json
from collections import Counter

from datmo_tools.batch.recording import cause_file
from datmo_tools.evaluate.report import MISSED, Section
from datmo_tools.text_table import percent, rounded

FORMAT = 1  # of batch.json
SHOWN_MOMENTS = 50
HOUR = 3600.0  # s
AGAIN = "the same command resumes it"


def collect(out, recordings):
    """Returns the result (dict) of the outcomes in `out` (Path). recordings: list of Recording."""
    outcomes = [(one, _outcome(out, one)) for one in recordings]
    done = [outcome for _, outcome in outcomes if outcome and not outcome["error"]]
    failed = [
        {"id": one.id, "name": one.name, "finished": outcome is not None,
         "error": outcome["error"] if outcome else _why_unfinished(out, one)}
        for one, outcome in outcomes if not outcome or outcome["error"]
    ]  # fmt: skip
    moments = [
        {"id": outcome["id"], "name": outcome["name"], **moment}
        for outcome in done for moment in outcome["moments"]
    ]  # fmt: skip
    moments.sort(key=lambda one: (-one["weight_s"], one["name"], one["at_s"]))
    return {
        "format": FORMAT,
        "totals": _totals(done),
        "failed": failed,
        "worst_moments": moments,
        "recordings": done,
    }


def _outcome(out, recording):
    """Returns the outcome; None if the job for these settings did not finish."""
    path = out / "recordings" / f"{recording.id}.json"
    settings = out / "settings" / f"{recording.id}.json"
    try:
        if path.stat().st_mtime_ns < settings.stat().st_mtime_ns:
            return None  # with other settings
        return json.loads(path.read_text())
    except FileNotFoundError:
        return None


def _why_unfinished(out, recording):
    try:
        return f"not finished: {cause_file(out, recording.id).read_text()}; {AGAIN}"
    except FileNotFoundError:
        return f"not finished: its job was killed or never started; {AGAIN}"


def _totals(done):
    scores = [one["score"]["clear_mot"] for one in done if one["score"]]
    counts = {
        key: sum(score[key] for score in scores)
        for key in ("misses", "false_positives", "id_switches", "required")
    }
    wrong = counts["misses"] + counts["false_positives"] + counts["id_switches"]
    dropped = Counter()
    for one in done:
        for drop in one["run"]["dropped"]:
            dropped[f"{drop['stage']}: {drop['reason']}"] += drop["count"]
    processor = sum(one["took"]["processor_s"] for one in done)
    return {
        "recordings": len(done),
        "duration_s": sum(one["run"]["duration_s"] for one in done),
        "distance_m": sum(one["run"]["distance_m"] for one in done),
        "scored": len(scores),
        "mota": 1.0 - wrong / counts["required"] if counts["required"] else None,
        **counts,
        "dropped": dict(dropped.most_common()),
        "processor_s": processor,
        "recordings_per_core_hour": HOUR * len(done) / processor if processor else None,
    }


def sections(batch):
    """Returns a list of Section."""
    return list(filter(None, [
        _tiles(batch), _failed(batch), _moments(batch), _recordings(batch), _dropped(batch),
    ]))  # fmt: skip


def _tiles(batch):
    totals = batch["totals"]
    tiles = [
        ("recordings", str(totals["recordings"]), ""),
        ("not processed", str(len(batch["failed"])), ""),
        ("recorded", f"{totals['duration_s'] / HOUR:.2f}", "h"),
        ("driven", f"{totals['distance_m'] / 1e3:.2f}", "km"),
        ("MOTA over all", percent(totals["mota"]), "%"),
        ("recordings per hour and core", rounded(totals["recordings_per_core_hour"], 0), ""),
    ]
    lines = ["; ".join(f"{name} {figure} {unit}".strip() for name, figure, unit in tiles)]
    return Section(tiles=tiles, lines=lines)


def _failed(batch):
    """Returns the section of recordings without result, or without a usable truth."""
    lines = [f"{one['name']}: {one['error']}" for one in batch["failed"]]
    lines += [f"{one['name']}: no score: {one['score_error']}" for one in batch["recordings"]
              if one["score_error"]]  # fmt: skip
    if not lines:
        return None
    return Section("Not processed", "Recordings without result or score, and why.", lines=lines)


def _moments(batch):
    shown = batch["worst_moments"][:SHOWN_MOMENTS]
    if not shown:
        return None
    rows = [("recording", "at (s)", "for (s)", "trouble (s)", "why")]
    rows += [
        (one["name"], f"{one['at_s']:.1f}", f"{one['for_s']:.1f}", f"{one['weight_s']:.1f}", one["why"])
        for one in shown
    ]
    return Section(
        "Worst moments",
        "Time since the recording's first message. Trouble: seconds in which the pose was lost or a"
        " sensor silent, object-seconds missed or false, half of the seconds in which a stage had"
        f" incomplete results. The worst {len(shown)} of {len(batch['worst_moments'])}.",
        rows,
    )


def _recordings(batch):
    """Returns the recordings by the weight of all their moments, the worst first."""
    if not batch["recordings"]:
        return None
    rows = [("recording", "s", "MOTA %", "misses", "false", "switches", "dropped", "gap of pose s",
             "trouble s", "")]  # fmt: skip
    trouble = {one["id"]: sum(m["weight_s"] for m in one["moments"]) for one in batch["recordings"]}
    for one in sorted(batch["recordings"], key=lambda one: (-trouble[one["id"]], one["name"])):
        run, score = one["run"], (one["score"] or {}).get("clear_mot", {})
        pose = run["pose"]
        rows.append((
            one["name"],
            f"{run['duration_s']:.1f}",
            percent(score.get("mota")),
            *(rounded(score.get(key), 0) for key in ("misses", "false_positives", "id_switches")),
            str(sum(drop["count"] for drop in run["dropped"])),
            rounded(pose and pose["longest_gap_s"], 2),
            f"{trouble[one['id']]:.1f}",
            "" if pose else MISSED,
        ))  # fmt: skip
    return Section("Recordings", "The one with most trouble first. MOTA if there is truth.", rows)


def _dropped(batch):
    dropped = batch["totals"]["dropped"]
    if not dropped:
        return None
    rows = [("stage: reason", "messages")]
    rows += [(reason, str(count)) for reason, count in dropped.items()]
    return Section("Dropped messages", "Of all recordings.", rows)
