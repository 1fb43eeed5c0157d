# SPDX-License-Identifier: BSD-3-Clause
"""Estimates the vehicle's motion from the scans alone, from a bounded number of pairs of scans."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.check_bag.scan_matching import Outline

MAX_PAIRS = 400
PAIR_TIME = 0.3  # s, maximum between two scans of a pair
MAX_TRAVEL = 0.04  # of the scanner's range, maximum between them
MIN_SHARE = 0.5  # of the points that must be matched
MIN_WEAKEST = 0.12  # below: a corridor, along which the motion is not observed

GUESS_SHIFT, GUESS_TURN = 0.4, 0.04  # m, rad: from nearer starts, matching finds one pose


class ScanMotions(NamedTuple):
    """Motions between pairs of scans; arrays of equal length."""

    starts: np.ndarray  # s, middle of the first scan's sweep
    ends: np.ndarray
    motions: np.ndarray  # n x 3, the scanner's x, y (m), yaw (rad), relative to the first
    weakest: np.ndarray  # 0 to 0.5, of each match
    residuals: np.ndarray  # m

    @property
    def certain(self):
        """Returns a mask: whether the position is observed in all directions."""
        return self.weakest > MIN_WEAKEST


def scan_motions(scans, facts, signals):
    """Returns the ScanMotions of ScanSamples; `signals`: MotionSignals, tried as guesses, too."""
    travel = max((_speed_of(signal) for signal in signals), default=0.0)
    step = _step(facts, travel)
    outlines, rows = {}, []
    for first, second in _pairs(scans, step):
        match = _outline(scans, first, facts, outlines).match(
            _outline(scans, second, facts, outlines),
            _guesses(scans[first], scans[second], signals),
        )
        if match is not None and match.share >= MIN_SHARE:
            start, end = (scans[i].stamp + 0.5 * scans[i].sweep for i in (first, second))
            rows.append((start, end, *match.motion, match.weakest, match.residual))
    table = np.array(rows, dtype=float).reshape(-1, 7)
    return ScanMotions(
        table[:, 0], table[:, 1], table[:, 2:5], table[:, 5], table[:, 6]
    )


def _speed_of(signal):
    speeds = signal.speeds()
    return float(np.percentile(speeds, 75)) if len(speeds) else 0.0


def _step(facts, speed):
    """Returns how many scans later the second one of a pair is."""
    longest = PAIR_TIME
    if speed > 0.0:
        longest = min(longest, MAX_TRAVEL * facts.reach / speed)
    return max(1, int(longest / facts.period))


def _pairs(scans, step):
    pairs = [
        (first, first + step)
        for first in range(len(scans) - step)
        if scans[first + step].index - scans[first].index == step
        and 0.0 < scans[first + step].stamp - scans[first].stamp < 1.0
    ]
    if len(pairs) <= MAX_PAIRS:
        return pairs
    return [pairs[int(i)] for i in np.linspace(0, len(pairs) - 1, MAX_PAIRS)]


def _outline(scans, index, facts, outlines):
    if index not in outlines:
        scan = scans[index]
        if len(scan.ranges) == len(facts.own_beams):
            scan = scan._replace(ranges=np.where(facts.own_beams, np.nan, scan.ranges))
        outlines[index] = Outline(scan)
    return outlines[index]


def _guesses(first, second, signals):
    """Returns the guesses: no motion, and each signal's turn to either side: no sign is trusted."""
    guesses = [(0.0, 0.0, 0.0)]
    start, end = np.array([first.stamp]), np.array([second.stamp])
    for signal in signals:
        if signal.headings is None:
            continue
        turn = float(signal.turns(start, end)[0])
        shift = signal.motions(start, end)[0] if signal.positions is not None else np.zeros(2)
        for guess in ((*shift, turn), (0.0, 0.0, -turn)):
            if all(_differ(guess, other) for other in guesses):
                guesses.append(guess)
    return guesses


def _differ(guess, other):
    shift = np.hypot(guess[0] - other[0], guess[1] - other[1])
    return shift > GUESS_SHIFT or abs(guess[2] - other[2]) > GUESS_TURN


def in_base(motions, mount):
    """Converts motions (n x 3) of the scanner to the vehicle; mount: x, y, yaw of the scanner."""
    back = transforms.relative(mount, np.zeros(3))
    return np.array([
        transforms.compose(transforms.compose(mount, motion), back) for motion in motions
    ]).reshape(-1, 3)  # fmt: skip
