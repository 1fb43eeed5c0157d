# SPDX-License-Identifier: BSD-3-Clause
"""Counts how accurate published borders are, how many are found, and how consistent sigmas are."""

import numpy as np

from datmo_tools.evaluate.border_errors import AHEAD, BEHIND

# m along the path, from the vehicle; the last two are sums of others.
BANDS = ((-BEHIND, 0.0), (0.0, 10.0), (10.0, 20.0), (20.0, 30.0), (30.0, AHEAD),
         (0.0, 20.0), (-BEHIND, AHEAD))  # fmt: skip

GROUPS = {
    "straight": lambda samples: ~samples.curved,
    "curve": lambda samples: samples.curved,
    "left": lambda samples: samples.left,
    "right": lambda samples: ~samples.left,
    "all": lambda samples: np.ones(len(samples.ahead), dtype=bool),
}

NEAR = 0.5  # m, up to which an error is small

# The 95th percentile of a squared normal error over its variance.
GATE_95 = 3.84

MIN_SIGMA = 1e-6  # m


def tally(samples, gate, found_within):
    """Returns a dictionary group -> list of the figures of each band, which JSON can hold.

    gate: m, a border with a larger error is not of this road; found_within: m from the true border,
    for it to be found.
    """
    samples = samples._replace(curved=samples.curved.astype(bool), left=samples.left.astype(bool))
    return {
        name: [
            _figures(
                samples.where(
                    chosen(samples) & (samples.ahead >= near) & (samples.ahead < far)
                ),
                gate, found_within,
            )
            for near, far in BANDS
        ]
        for name, chosen in GROUPS.items()
    }  # fmt: skip


def _figures(samples, gate, found_within):
    published = samples.where(np.isfinite(samples.error))
    counted = published.where(np.abs(published.error) <= gate)
    size = np.abs(counted.error)
    nees = (counted.error / np.maximum(counted.sigma, MIN_SIGMA)) ** 2
    return {
        "stations": len(samples.ahead),
        "published": len(published.ahead),
        "beyond_gate": len(published.ahead) - len(counted.ahead),
        "found_share": _of(np.count_nonzero(size <= found_within), len(samples.ahead)),
        "rms_m": _root_mean_square(counted.error),
        "mean_m": _mean(counted.error),
        "median_m": _quantile(size, 0.5),
        "quantile_90_m": _quantile(size, 0.9),
        "quantile_95_m": _quantile(size, 0.95),
        "near_share": _mean(size <= NEAR),
        "curb_rms_m": _root_mean_square(
            published.curb_error[np.abs(published.curb_error) <= gate]
        ),
        "mean_sigma_m": _mean(counted.sigma),
        "mean_nees": _mean(nees),
        "median_nees": _quantile(nees, 0.5),
        "in_gate_95": _mean(nees <= GATE_95),
    }  # fmt: skip


def _of(count, total):
    return count / total if total else None


def _mean(values):
    return float(np.mean(values)) if len(values) else None


def _root_mean_square(values):
    return float(np.sqrt(np.mean(values**2))) if len(values) else None


def _quantile(values, share):
    return float(np.quantile(values, share)) if len(values) else None
