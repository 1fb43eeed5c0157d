# SPDX-License-Identifier: BSD-3-Clause
"""Scores risks against true contacts, over many drives of one method. No ROS here."""

from typing import NamedTuple, Optional

import numpy as np

HORIZONS = (1.0, 2.0, 3.0, 4.0)  # s, of RiskArray's probabilities
WARNING = 2  # RiskArray.LEVEL_WARNING
BINS = 10  # of the reliability diagram
CLOSE = 3.0  # s to contact, within which times to contact are scored
LIKELY = 0.5  # probability from which a time to contact counts as predicted
LONG_SEEN = 3.5  # s in view, long enough to warn a driver in time
ENOUGH = 1.7  # s of lead (public test protocols of forward collision warning)
ATTAINABLE_SHARE = 0.8  # of the attainable lead, if the object was in view for less


class RiskFrame(NamedTuple):
    """The risk published at one time of a drive."""

    time: float  # s
    level: int  # RiskArray.LEVEL_*
    probability: tuple  # of any contact within each of HORIZONS, 0 to 1
    ttc: Optional[float]  # s, of the most likely object; None: none is likely


class RiskDrive(NamedTuple):
    """One drive; it ends with its contact, if there is one."""

    name: str
    frames: list  # of RiskFrame, by rising time
    end: float  # s
    contact: Optional[float]  # s
    seen: Optional[float]  # s, since when the struck object was in view without a gap


def any_contact(probabilities):
    """Returns the probability of contact with any of several independent objects."""
    return float(1.0 - np.prod([1.0 - value for value in probabilities]))


def ttc_errors(drives):
    """Returns predicted minus true time to contact (s) of all frames at most CLOSE before one."""
    return [
        frame.ttc - (drive.contact - frame.time)
        for drive in drives
        if drive.contact is not None
        for frame in drive.frames
        if frame.ttc is not None and 0.0 < drive.contact - frame.time <= CLOSE
    ]


def warnings_of(drive):
    """Returns (from, to) in s of each warning of the driver; to: the frame that ends it."""
    spans, start = [], None
    for frame in drive.frames:
        if frame.level >= WARNING and start is None:
            start = frame.time
        elif frame.level < WARNING and start is not None:
            spans.append((start, frame.time))
            start = None
    return spans + ([(start, drive.end)] if start is not None else [])


def lead_of(drive):
    """Returns the time (s) from the warning that lasts until the contact to it, or None."""
    spans = warnings_of(drive)
    if drive.contact is None or not spans or spans[-1][1] < drive.end:
        return None
    return drive.contact - spans[-1][0]


def is_long_seen(drive):
    """Whether the struck object was in view long enough to warn a driver in time."""
    return drive.seen is not None and drive.contact - drive.seen >= LONG_SEEN


def attainable_lead(drive):
    """Returns the attainable lead (s): ENOUGH, or the time in view if it is shorter."""
    return 0.0 if drive.seen is None else min(drive.contact - drive.seen, ENOUGH)


def is_warned_in_time(drive):
    """Whether the lead is sufficient for the time that the object was in view."""
    lead = lead_of(drive)
    needed = 1.0 if is_long_seen(drive) else ATTAINABLE_SHARE
    return lead is not None and lead >= needed * attainable_lead(drive)


def lead_share(drives):
    """Returns the warnings' mean share of the attainable lead, 0 to 1; None: none attainable."""
    shares = [
        min(1.0, (lead_of(drive) or 0.0) / attainable_lead(drive))
        for drive in drives
        if attainable_lead(drive) > 0.0
    ]
    return float(np.mean(shares)) if shares else None


def false_warnings(drives):
    """Returns warnings of drives without contact, and those that ended before the contact."""
    return sum(
        1
        for drive in drives
        for _, end in warnings_of(drive)
        if drive.contact is None or end < drive.end
    )


def outcomes(drives, horizon):
    """Returns (predicted probability, contact or not) of frames whose outcome is known."""
    index = HORIZONS.index(horizon)
    pairs = []
    for drive in drives:
        for frame in drive.frames:
            if drive.contact is not None:
                is_contact = drive.contact - frame.time <= horizon
                pairs.append((frame.probability[index], float(is_contact)))
            elif frame.time + horizon <= drive.end:
                pairs.append((frame.probability[index], 0.0))
    return np.array(pairs).reshape(-1, 2)


def brier_score(pairs):
    """Returns the mean squared difference of probability and outcome (Brier 1950), or NaN."""
    return float(np.mean((pairs[:, 0] - pairs[:, 1]) ** 2)) if len(pairs) else float("nan")


def reliability(pairs):
    """Returns (mean probability, observed share, frames) of each non-empty bin of BINS."""
    index = np.minimum((pairs[:, 0] * BINS).astype(int), BINS - 1)
    return [
        (float(inside[:, 0].mean()), float(inside[:, 1].mean()), len(inside))
        for inside in (pairs[index == each] for each in range(BINS))
        if len(inside)
    ]


def calibration_error(pairs):
    """Returns the mean distance of predicted and observed frequency over the bins; NaN: none."""
    if not len(pairs):
        return float("nan")
    return sum(abs(predicted - observed) * count for predicted, observed, count in reliability(pairs)) / len(pairs)


def score(drives):
    """Returns all scores of one method as a dictionary that JSON can hold."""
    errors = np.abs(ttc_errors(drives))
    struck = [drive for drive in drives if drive.contact is not None]
    missed = [drive for drive in drives if drive.contact is None]
    hours = sum(drive.end - drive.frames[0].time for drive in drives if drive.frames) / 3600.0
    false = false_warnings(drives)
    leads = [lead for lead in map(lead_of, struck) if lead is not None]
    by_horizon = {}
    for horizon in HORIZONS:
        pairs = outcomes(drives, horizon)
        by_horizon[f"{horizon:.0f}"] = {
            "frames": len(pairs),
            "brier": _or_none(brier_score(pairs)),
            "calibration_error": _or_none(calibration_error(pairs)),
            "reliability": reliability(pairs),
        }
    return {
        "drives": len(drives),
        "contacts": len(struck),
        "ttc_frames": len(errors),
        "ttc_median_s": _quantile(errors, 0.5),
        "ttc_95_s": _quantile(errors, 0.95),
        "warned": len(leads),
        "long_seen": _in_time([drive for drive in struck if is_long_seen(drive)]),
        "briefly_seen": _in_time([drive for drive in struck if not is_long_seen(drive)]),
        "lead_share": lead_share(struck),
        "lead_median_s": _quantile(leads, 0.5),
        "lead_5_s": _quantile(leads, 0.05),
        "near_misses": len(missed),
        "near_misses_warned": sum(1 for drive in missed if warnings_of(drive)),
        "false_warnings": false,
        "hours": hours,
        "false_per_hour": false / hours if hours > 0.0 else None,
        "horizons": by_horizon,
    }


def _in_time(struck):
    return {"contacts": len(struck), "in_time": sum(map(is_warned_in_time, struck))}


def _quantile(values, share):
    return float(np.quantile(values, share)) if len(values) else None


def _or_none(value):
    return None if np.isnan(value) else value
