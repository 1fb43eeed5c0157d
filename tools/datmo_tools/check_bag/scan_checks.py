# SPDX-License-Identifier: BSD-3-Clause
"""Checks the scans: geometry, missing returns, dead beams, returns from the vehicle itself."""

import math
from typing import NamedTuple

import numpy as np

MIN_SCANS = 20  # to judge a beam by all scans
MAX_SWEEP = 0.25  # s, like scan/max_sweep
NO_RETURN_SHARE = 0.02  # of all beams, above which a convention for missing returns is reported
DEAD_WIDTH = math.radians(1.0)  # narrower runs of dead beams are not reported
OWN_SHARE = 0.8  # of the scans in which a beam hits the vehicle itself
OWN_SPREAD = 0.03  # m
OWN_REACH_SHARE = 0.15  # of the scanner's range, and at most
OWN_MAX_RANGE = 3.0  # m: no vehicle sees itself farther away
MAX_REPEATED = 0.05  # of all returns, the largest share that may have the very same maximum value
REACH_PERCENTILE = 98.0


class ScannerFacts(NamedTuple):
    """Properties of the scanner, from its scans."""

    beams: int
    spacing: float  # rad
    field: float  # rad, from the first beam to the last
    reach: float  # m, exceeded by few returns
    typical: float  # m, median of the returns
    range_max: float  # m, as stated by the driver
    period: float  # s
    sweep: float  # s
    own_beams: np.ndarray  # mask of those that hit the vehicle itself


def check_scans(recording, roles, findings, moved):
    """Returns the ScannerFacts of the scanner in use; adds findings on its scans.

    moved: whether the vehicle moves in the recording. Returns None if no scan is usable.
    """
    scans = recording.scans.get(roles.scan, [])
    if not scans or not _check_geometry(roles.scan, scans, findings):
        return None
    beams = max(len(scan.ranges) for scan in scans)
    alike = [scan for scan in scans if len(scan.ranges) == beams]
    table = np.stack([scan.ranges for scan in alike])
    first = alike[0]
    _check_conventions(roles.scan, table, first, findings)
    _check_times(recording, roles.scan, first, findings)
    dead = _check_dead_beams(roles.scan, table, first, findings)
    own = _check_own_returns(roles.scan, table, first, findings, moved)
    hits = table[:, ~own & ~dead]
    hits = hits[_is_hit(hits, first)]
    if len(hits) < MIN_SCANS:
        findings.error(
            "no_returns", roles.scan, f"{len(hits)} returns in {len(alike)} scans",
            "Nothing was in range, or the driver's range_min and range_max are wrong.",
        )  # fmt: skip
        return None
    spacing = abs(first.angle_increment)
    return ScannerFacts(
        beams, spacing, spacing * (beams - 1),
        float(np.percentile(hits, REACH_PERCENTILE)), float(np.median(hits)), first.range_max,
        recording.topics[roles.scan].period() or 0.1, first.sweep, own,
    )  # fmt: skip


def _is_hit(ranges, scan):
    return np.isfinite(ranges) & (ranges >= max(scan.range_min, 1e-3)) & (ranges < scan.range_max)


def _check_geometry(name, scans, findings):
    first = scans[0]
    numbers = first.angle_min, first.angle_max, first.angle_increment, first.range_min
    if not all(map(math.isfinite, numbers)) or first.angle_increment == 0.0 or not len(first.ranges):
        findings.error(
            "scan_geometry", name,
            f"{len(first.ranges)} beams from {first.angle_min} to {first.angle_max} rad in steps "
            f"of {first.angle_increment}",
            "The stack rejects such scans: set angle_min, angle_max and angle_increment.",
        )  # fmt: skip
        return False
    if not first.range_max > first.range_min >= 0.0:
        findings.error(
            "range_limits", name,
            f"range_min is {first.range_min} m and range_max {first.range_max} m",
            "The stack rejects such scans: set both in the driver.",
        )  # fmt: skip
        return False
    expected = (first.angle_max - first.angle_min) / first.angle_increment + 1.0
    if abs(expected - len(first.ranges)) > 1.5:
        findings.error(
            "beam_count", name,
            f"{len(first.ranges)} beams, but the angles give {expected:.1f}",
            "The stack rejects such scans: correct angle_max or angle_increment in the driver.",
        )  # fmt: skip
        return False
    shapes = {(len(s.ranges), round(s.angle_min, 3), round(s.angle_increment, 5)) for s in scans}
    if len(shapes) > 1:
        findings.warn(
            "scan_changes", name, f"beams or angles change: {len(shapes)} different scans",
            "Two scanners on one topic, or a driver whose settings changed: use one topic each.",
        )  # fmt: skip
    return True


def _check_conventions(name, table, scan, findings):
    nan, inf = np.isnan(table).mean(), np.isposinf(table).mean()
    zero = (table == 0.0).mean()
    beyond = (np.isfinite(table) & (table >= scan.range_max)).mean()
    if nan > NO_RETURN_SHARE and inf < nan:
        findings.warn(
            "nan_ranges", name,
            f"{100 * nan:.0f} % of all ranges are NaN, {100 * inf:.0f} % +inf",
            "NaN is a failed measurement: nothing is known along such a beam, and old tracks "
            "and walls there do not fade. If it stands for no return, have the driver report +inf "
            "(REP 117).",
        )  # fmt: skip
    if zero > NO_RETURN_SHARE and inf < zero:
        findings.warn(
            "zero_ranges", name,
            f"{100 * zero:.0f} % of all ranges are 0, {100 * inf:.0f} % +inf",
            "0 is treated as a failed measurement: nothing is known along such a beam. "
            "If it stands for no return, have the driver report +inf (REP 117).",
        )  # fmt: skip
    if beyond > NO_RETURN_SHARE:
        findings.note(
            "ranges_beyond_max", name,
            f"{100 * beyond:.0f} % of all ranges are range_max ({scan.range_max:.1f} m) or more",
            "They are treated as no return, as they should be.",
        )  # fmt: skip
    _check_repeated_maximum(name, table, scan, findings)


def _check_repeated_maximum(name, table, scan, findings):
    hits = table[_is_hit(table, scan)]
    if not len(hits):
        return
    top = hits.max()
    share = (hits == top).mean()
    if share > MAX_REPEATED:
        findings.warn(
            "range_max", name,
            f"{100 * share:.0f} % of all returns are {top:.2f} m to the last digit, below "
            f"range_max ({scan.range_max:.2f} m): most likely no return",
            "They would be treated as a wall. Set range_max below that value in the driver.",
        )  # fmt: skip


def _check_times(recording, name, scan, findings):
    period = recording.topics[name].period() or 0.0
    sweep = scan.time_increment * (len(scan.ranges) - 1)
    if not math.isfinite(sweep) or sweep < 0.0:
        findings.warn(
            "time_increment", name, f"time_increment is {scan.time_increment} s, expected 0 or more",
            "All beams are taken as measured at once: correct it in the driver.",
        )  # fmt: skip
    elif sweep > MAX_SWEEP or (period > 0.0 and sweep > 1.1 * period):
        findings.warn(
            "time_increment", name,
            f"by time_increment a scan takes {sweep:.3f} s, but one arrives every {period:.3f} s",
            "It cannot take longer than its period: correct time_increment in the driver.",
        )  # fmt: skip
    elif sweep == 0.0:
        findings.note(
            "time_increment_zero", name, "time_increment is 0: all beams are taken as measured at once",
            "Have the driver set it. Without it, walls are distorted while the vehicle turns.",
        )  # fmt: skip


def _check_dead_beams(name, table, scan, findings):
    """Returns a mask of the beams without a single return."""
    if len(table) < MIN_SCANS:
        return np.zeros(table.shape[1], dtype=bool)
    dead = ~np.any(_is_hit(table, scan), axis=0)
    # A beam over open ground reports +inf and works; a masked one reports 0 or NaN.
    masked = dead & ~np.any(np.isposinf(table) | (table >= scan.range_max), axis=0)
    _report_runs(
        name, scan, masked, findings.warn if masked.mean() > 0.1 else findings.note, "dead_beams",
        "never measure anything: masked in the driver, covered, or broken",
        "Nothing is known in this sector. Nothing to do if the vehicle itself is there.",
    )  # fmt: skip
    _report_runs(
        name, scan, dead & ~masked, findings.note, "silent_beams",
        "never return anything", "Open ground, or a window that is dirty or covered there.",
    )  # fmt: skip
    return dead


def _check_own_returns(name, table, scan, findings, moved):
    """Returns a mask of the beams that hit the vehicle itself."""
    none = np.zeros(table.shape[1], dtype=bool)
    if len(table) < MIN_SCANS or not moved:
        return none
    hits = _is_hit(table, scan)
    all_hits = table[hits]
    if not len(all_hits):
        return none
    near = min(OWN_REACH_SHARE * float(np.percentile(all_hits, REACH_PERCENTILE)), OWN_MAX_RANGE)
    values = np.where(hits, table, np.nan)
    seen = hits.mean(axis=0) > OWN_SHARE
    own = none.copy()
    if np.any(seen):
        low, high = np.nanpercentile(values[:, seen], [10, 90], axis=0)
        own[seen] = (high < near) & (high - low < OWN_SPREAD)
    _report_runs(
        name, scan, own, findings.warn, "own_returns",
        f"always end within {near:.1f} m of the scanner, at the same range: the vehicle itself",
        "It looks like a wall that moves with the vehicle. Mask these beams in the driver, or with "
        "laser_filters (LaserScanAngularBoundsFilterInPlace, LaserScanBoxFilter).",
    )  # fmt: skip
    return own


def _report_runs(name, scan, mask, report, kind, what, advice):
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    runs = edges.reshape(-1, 2)
    wide = [run for run in runs if (run[1] - run[0]) * abs(scan.angle_increment) >= DEAD_WIDTH]
    if wide:
        bearings = np.degrees(scan.bearings)
        sectors = ", ".join(f"{bearings[a]:.0f} to {bearings[b - 1]:.0f}" for a, b in wide[:4])
        total = sum(b - a for a, b in wide)
        report(
            kind, name,
            f"{total} of {len(mask)} beams ({sectors} degrees"
            f"{', ...' if len(wide) > 4 else ''}) {what}",
            advice,
        )  # fmt: skip
