# SPDX-License-Identifier: BSD-3-Clause
"""Fits a signal of the vehicle's motion to that of the scans: scale, sign, delay."""

from typing import NamedTuple

import numpy as np

MAX_DELAY = 0.6  # s
DELAY_STEP = 0.01  # s
MIN_PAIRS = 15
MIN_SIGNAL = 5.0  # times the noise, the least motion for a fit
FLOOR_TURN = 0.0015  # rad, the least error of a match of scans
FLOOR_SHIFT = 0.005  # m
MAX_REST = 80.0  # floors, the most that one pair may cost


class MotionFit(NamedTuple):
    """scans(t) = scale * signal(t + delay)."""

    scale: float
    scale_error: float  # standard deviation
    delay: float  # s, by which the signal lags behind the scans
    noise: float  # rad or m, of one pair after the fit
    gain: float  # ratio of the cost at delay 0 to that at `delay`
    pairs: int


def fit_turns(signal, motions):
    """Returns the MotionFit of the headings; None if there is too little turning."""
    if signal is None or signal.headings is None:
        return None
    return _fit(signal, motions.starts, motions.ends, motions.motions[:, 2], signal.turns,
                FLOOR_TURN)  # fmt: skip


def fit_distances(signal, motions, base_motions):
    """Returns the MotionFit of the forward motion that the scans observe; None if too little."""
    if signal is None or signal.positions is None:
        return None
    known = motions.certain
    if known.sum() < MIN_PAIRS:
        return None

    def forward(starts, ends):
        return signal.motions(starts, ends)[:, 0]

    return _fit(signal, motions.starts[known], motions.ends[known], base_motions[known, 0], forward,
                FLOOR_SHIFT)  # fmt: skip


def _fit(signal, starts, ends, seen, said, floor):
    inside = signal.covers(starts - MAX_DELAY, ends + MAX_DELAY)
    starts, ends, seen = starts[inside], ends[inside], seen[inside]
    if len(seen) < MIN_PAIRS:
        return None
    delays = np.arange(-MAX_DELAY, MAX_DELAY + 0.5 * DELAY_STEP, DELAY_STEP)
    trials = [_regression(said(starts + delay, ends + delay), seen, floor) for delay in delays]
    costs = np.array([trial[2] for trial in trials])
    best = int(np.argmin(costs))
    scale, error, _, noise = trials[best]
    zero = costs[len(delays) // 2]
    expected = said(starts + delays[best], ends + delays[best])
    if np.percentile(np.abs(expected), 90) < MIN_SIGNAL * max(noise, floor):
        return None
    return MotionFit(scale, error, _vertex(delays, costs, best), noise, zero / costs[best],
                     len(seen))  # fmt: skip


def _vertex(delays, costs, best):
    """Refines the minimum between the steps by a parabola."""
    if best in (0, len(delays) - 1):
        return float(delays[best])
    before, at, after = costs[best - 1 : best + 2]
    curve = before - 2.0 * at + after
    shift = 0.5 * (before - after) / curve if curve > 0.0 else 0.0
    return float(delays[best] + DELAY_STEP * np.clip(shift, -0.5, 0.5))


def _regression(said, seen, floor):
    """Returns scale, its error, robust cost and noise of seen = scale * said."""
    weights = np.ones(len(seen))
    scale, noise = 1.0, floor
    for _ in range(8):
        square = np.sum(weights * said * said)
        if square < 1e-12:
            return 0.0, np.inf, float(np.mean(seen**2)) + floor**2, floor
        scale = float(np.sum(weights * said * seen) / square)
        rest = seen - scale * said
        noise = max(1.4826 * float(np.median(np.abs(rest))), floor)
        weights = 1.0 / (1.0 + (rest / (2.0 * noise)) ** 2)
    error = noise / np.sqrt(np.sum(weights * said * said))
    cost = float(np.mean(np.minimum(np.abs(rest), MAX_REST * floor))) ** 2 + floor**2
    return scale, float(error), cost, noise
