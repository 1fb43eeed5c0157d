# SPDX-License-Identifier: BSD-3-Clause
"""Finds when in a recording things went badly, and how badly.

The weight is in seconds of trouble: how long the pose was lost or a sensor silent, and how many
object-seconds were missed or false.
"""

WINDOW = 2.0  # s, in which misses, false tracks and drops are counted together
MAX_WINDOWS = 3  # per recording, not overlapping
MAX_MOMENTS = 10  # per recording
MIN_WEIGHT = 0.2  # s: less does not count as a moment
UNCERTAIN_WEIGHT = 0.5  # per second in which there are results, but fewer than expected

# Health of a stage as run_bag --report has it.
NO_OUTPUT = "no output"


def worst_moments(run, score):
    """Returns a list of {at_s, for_s, weight_s, why}, the worst first.

    run: what run_bag --report wrote; score: what score_run wrote, or None.
    """
    moments = [*_conditions(run), *_silences(run), *_gap_of_pose(run), *_drops(run)]
    if score is not None:
        moments += _windows(score["series"], score["start_s"] - run["start_s"])
    moments = [one for one in moments if one["weight_s"] >= MIN_WEIGHT]
    moments.sort(key=lambda one: (-one["weight_s"], one["at_s"], one["why"]))
    return moments[:MAX_MOMENTS]


def _moment(start, length, weight, why):
    return {"at_s": round(start, 3), "for_s": round(length, 3), "weight_s": round(weight, 3),
            "why": why}  # fmt: skip


def _conditions(run):
    for one in run["conditions"]:
        share = 1.0 if one["level"] == NO_OUTPUT else UNCERTAIN_WEIGHT
        yield _moment(one["from_s"], one["for_s"], share * one["for_s"],
                      f"{one['stage']}: {one['why']}")  # fmt: skip


def _silences(run):
    for one in run["silences"]:
        yield _moment(one["from_s"], one["for_s"], one["for_s"], f"nothing on {one['topic']}")


def _gap_of_pose(run):
    """Yields the longest gap, and the wait for the first pose."""
    pose = run["pose"]
    if pose is None:
        yield _moment(0.0, run["duration_s"], run["duration_s"], "no pose at all")
        return
    period = run["duration_s"] / max(run["scans"], 1)
    for start, length, why in ((pose["longest_gap_from_s"], pose["longest_gap_s"], "no pose"),
                               (0.0, pose["first_s"], "no pose yet")):
        missing = length - period
        if missing > WINDOW / 2.0:
            yield _moment(start, length, missing, why)


def _drops(run):
    """Yields when most messages of a stage were dropped; each one counts as one scan period."""
    period = run["duration_s"] / max(run["scans"], 1)
    for one in run["dropped"]:
        yield _moment(one["max_from_s"], WINDOW, min(WINDOW, one["max_count"] * period),
                      f"{one['stage']} dropped {one['max_count']} messages: {one['reason']}")  # fmt: skip


def _windows(series, offset):
    """Yields windows with most misses and false tracks. offset: from score to recording time."""
    times, missed, false = series["time_s"], series["missed"], series["false"]
    if len(times) < 2:
        return
    period = (times[-1] - times[0]) / (len(times) - 1)
    used = [False] * len(times)
    for _ in range(MAX_WINDOWS):
        window = _fullest(times, [m + f for m, f in zip(missed, false)], used)
        if window is None:
            return
        misses, ghosts = (sum(counts[i] for i in window) for counts in (missed, false))
        why = " and ".join(
            f"{count * period:.1f} object-seconds {word}"
            for count, word in ((misses, "missed"), (ghosts, "false")) if count)
        yield _moment(times[window[0]] + offset, times[window[-1]] - times[window[0]] + period,
                      (misses + ghosts) * period, why)  # fmt: skip
        for i in window:
            used[i] = True


def _fullest(times, counts, used):
    """Returns the unused window with most, as a range of frames; None if nothing is left."""
    best, best_count, first, count = None, 0, 0, 0
    for last, stamp in enumerate(times):
        if used[last]:
            first, count = last + 1, 0
            continue
        count += counts[last]
        while stamp - times[first] > WINDOW:
            count -= counts[first]
            first += 1
        if count > best_count:
            best, best_count = range(first, last + 1), count
    return best
