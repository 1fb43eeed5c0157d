# SPDX-License-Identifier: BSD-3-Clause
"""Measures range noise, and how far a beam without return means free space, from the scans."""

import numpy as np

MIN_STILL_PAIRS = 5
MIN_BEAMS = 50
STILL_SHIFT = 0.01  # m between two scans
STILL_TURN = 0.002  # rad
SMOOTH = 0.05  # of the range, the most by which neighbors on one surface differ
RANGE_BINS = 8
MAX_LOST_SHARE = 0.03  # of the beams on a surface, the largest share that may lack a return
MIN_IN_BIN = 200
MIN_NOISE = 0.005  # m: no planar scanner is better


def range_noise(scans, still):
    """Returns the standard deviation (m) of a range at standstill; None if there is none.

    still: function of two stamps (s): whether the vehicle stands between them.
    """
    values = []
    for first, second in zip(scans, scans[1:]):
        alike = second.index == first.index + 1 and len(first.ranges) == len(second.ranges)
        if alike and still(first.stamp, second.stamp):
            both = first.hits & second.hits
            if both.sum() >= MIN_BEAMS:
                values.append(np.median(np.abs(first.ranges[both] - second.ranges[both])))
    if len(values) < MIN_STILL_PAIRS:
        return None
    # The median of |a - b| of two Gaussian values is 0.954 of their standard deviation.
    return max(float(np.median(values)) / 0.954, MIN_NOISE)


def free_range(scans, facts):
    """Returns the range (m) up to which nearly all beams return from surfaces; 0: not even nearby.

    A beam without return between two beams of about the same range is assumed to hit the same
    surface.
    """
    edges = np.linspace(0.0, facts.reach, RANGE_BINS + 1)
    lost, met = np.zeros(RANGE_BINS), np.zeros(RANGE_BINS)
    for scan in scans:
        ranges, hits = scan.ranges, scan.hits
        left, right = ranges[:-2], ranges[2:]
        with np.errstate(invalid="ignore"):
            surface = hits[:-2] & hits[2:] & (np.abs(left - right) < SMOOTH * left)
            silent = np.isposinf(ranges[1:-1]) | (ranges[1:-1] >= scan.range_max)
        bins = np.digitize(left[surface], edges) - 1
        inside = (bins >= 0) & (bins < RANGE_BINS)
        met += np.bincount(bins[inside], minlength=RANGE_BINS)
        lost += np.bincount(bins[inside], weights=silent[surface][inside], minlength=RANGE_BINS)
    return float(_last_reliable(edges, lost, met))


def _last_reliable(edges, lost, met):
    reliable = 0.0
    for upper, without, all_beams in zip(edges[1:], lost, met):
        if all_beams >= MIN_IN_BIN and without > MAX_LOST_SHARE * all_beams:
            break
        if all_beams >= MIN_IN_BIN:
            reliable = upper
    return reliable
