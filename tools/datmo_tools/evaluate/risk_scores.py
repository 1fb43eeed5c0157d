# SPDX-License-Identifier: BSD-3-Clause
"""Scores of risks against true contacts, over many drives of one method. No ROS here."""

from typing import NamedTuple, Optional

import numpy as np

HORIZONS = (1.0, 2.0, 3.0, 4.0)  # s, of RiskArray's probabilities
WARNING = 2  # RiskArray.LEVEL_WARNING
BINS = 10  # of the reliability diagram
CLOSE = 3.0  # s to contact, within which times to contact are scored
LIKELY = 0.5  # probability from which a time to contact is taken as said
LONG_SEEN = 3.5  # s in view, from which a driver could have been warned in time
ENOUGH = 1.7  # s of lead (public test protocols of forward collision warning)
ATTAINABLE_SHARE = 0.8  # of the attainable lead, where the object was in view for less


class RiskFrame(NamedTuple):
    """What was said at one time of a drive."""

    time: float  # s
    level: int  # RiskArray.LEVEL_*
    probability: tuple  # of any contact within each of HORIZONS, 0 to 1
    ttc: Optional[float]  # s, of the likeliest object; None: none is likely


class RiskDrive(NamedTuple):
    """One drive; it ends with its contact, if there is one."""

    name: str
    frames: list  # of RiskFrame, by rising time
    end: float  # s
    contact: Optional[float]  # s
    seen: Optional[float]  # s, since when what is struck was in view without a gap


def any_contact(probabilities):
    """Probability of contact with any of several independent objects."""
    return float(1.0 - np.prod([1.0 - value for value in probabilities]))


def ttc_errors(drives):
    """Said minus true time to contact (s) of all frames at most CLOSE before one."""
    return [
        frame.ttc - (drive.contact - frame.time)
        for drive in drives
        if drive.contact is not None
        for frame in drive.frames
        if frame.ttc is not None and 0.0 < drive.contact - frame.time <= CLOSE
    ]


def warnings_of(drive):
    """(from, to) in s of each time in which the driver is warned; to: the frame that ends it."""
    spans, start = [], None
    for frame in drive.frames:
        if frame.level >= WARNING and start is None:
            start = frame.time
        elif frame.level < WARNING and start is not None:
            spans.append((start, frame.time))
            start = None
    return spans + ([(start, drive.end)] if start is not None else [])


def lead_of(drive):
    """s from the warning that lasts until the contact to that contact; None: there is none."""
    spans = warnings_of(drive)
    if drive.contact is None or not spans or spans[-1][1] < drive.end:
        return None
    return drive.contact - spans[-1][0]


def is_long_seen(drive):
    """Whether what is struck was in view for so long that a driver could have been warned in time."""
    return drive.seen is not None and drive.contact - drive.seen >= LONG_SEEN


def attainable_lead(drive):
    """s of lead that can be asked for: ENOUGH, or the time in view if it is shorter."""
    return 0.0 if drive.seen is None else min(drive.contact - drive.seen, ENOUGH)


def is_warned_in_time(drive):
    """Whether the lead is what could be asked for, by how long the object was in view."""
    lead = lead_of(drive)
    needed = 1.0 if is_long_seen(drive) else ATTAINABLE_SHARE
    return lead is not None and lead >= needed * attainable_lead(drive)


def lead_share(drives):
    """Mean share of the attainable lead that a warning has, 0 to 1; None: nothing was attainable."""
    shares = [
        min(1.0, (lead_of(drive) or 0.0) / attainable_lead(drive))
        for drive in drives
        if attainable_lead(drive) > 0.0
    ]
    return float(np.mean(shares)) if shares else None


def false_warnings(drives):
    """Warnings of drives without contact, and those that ended before the contact."""
    return sum(
        1
        for drive in drives
        for _, end in warnings_of(drive)
        if drive.contact is None or end < drive.end
    )


def outcomes(drives, horizon):
    """(said probability, contact or not) of each frame that the drive outlasts by the horizon."""
    index = HORIZONS.index(horizon)
    pairs = []
    for drive in drives:
        for frame in drive.frames:
            if drive.contact is not None:
                came = drive.contact - frame.time <= horizon
                pairs.append((frame.probability[index], float(came)))
            elif frame.time + horizon <= drive.end:
                pairs.append((frame.probability[index], 0.0))
    return np.array(pairs).reshape(-1, 2)


def brier_score(pairs):
    """Mean squared difference of probability and outcome (Brier 1950); NaN without any."""
    return float(np.mean((pairs[:, 0] - pairs[:, 1]) ** 2)) if len(pairs) else float("nan")


def reliability(pairs):
    """(mean probability, share that came, frames) of each bin of BINS that is not empty."""
    index = np.minimum((pairs[:, 0] * BINS).astype(int), BINS - 1)
    return [
        (float(inside[:, 0].mean()), float(inside[:, 1].mean()), len(inside))
        for inside in (pairs[index == each] for each in range(BINS))
        if len(inside)
    ]


def calibration_error(pairs):
    """Mean distance of said and observed frequency over the bins, by their frames; NaN: none."""
    if not len(pairs):
        return float("nan")
    return sum(abs(said - came) * count for said, came, count in reliability(pairs)) / len(pairs)


def score(drives):
    """All scores of one method as a dictionary that JSON can hold."""
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
