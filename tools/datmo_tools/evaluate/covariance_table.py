# SPDX-License-Identifier: BSD-3-Clause
"""Computes variances by range bin from differences between two sensors, and fits laws to them."""

from typing import NamedTuple

import numpy as np

from datmo_tools.errors import InputError

# From the median absolute deviation to the standard deviation of a normal distribution.
NORMAL_MAD = 1.4826
OUTLIER = 3.0  # standard deviations
# Share of a normal distribution's variance that remains within this many standard deviations.
KEPT_VARIANCE = 0.97334

# Share of the variance of the differences: if less of it is the camera's own, it cannot be measured
# next to what is known.
MIN_SHARE = 0.1

FIT_STEPS = 50


class Spread(NamedTuple):
    """The spread of differences, without outliers."""

    count: int
    bias: float
    variance: float  # about the bias


def robust_spread(differences):
    """Computes the Spread of differences (n, one or more)."""
    values = np.asarray(differences, dtype=float)
    middle = np.median(values)
    scale = NORMAL_MAD * np.median(np.abs(values - middle))
    kept = values[np.abs(values - middle) <= OUTLIER * scale]
    return Spread(len(kept), float(kept.mean()), float(kept.var()) / KEPT_VARIANCE)


class Law(NamedTuple):
    """Variance over range r: constant + factor * r^power."""

    constant: float
    factor: float
    power: int

    def at(self, ranges):
        """Returns variances at the ranges (n, m)."""
        return self.constant + self.factor * np.asarray(ranges, dtype=float) ** self.power


def fitted_law(ranges, differences, known, counts, power):
    """Fits a Law with constant and factor of 0 or more to variances, plus what is known.

    ranges: m; differences: their variances, from as many samples as `counts`: such an estimate has
    the variance 2 variance^2 / count; known: variance that is part of each.
    """
    items = (ranges, differences, known, counts)
    ranges, differences, known, counts = (np.asarray(item, dtype=float) for item in items)
    terms = np.column_stack([np.ones(len(ranges)), ranges**power])
    whole = differences
    factors = np.zeros(2)
    for _ in range(FIT_STEPS):
        weights = np.sqrt(counts) / whole
        factors = _least_squares(terms * weights[:, np.newaxis], (differences - known) * weights)
        # A bin far above the law must not get more weight.
        whole = np.maximum(terms @ factors + known, 0.5 * differences)
    return Law(float(factors[0]), float(factors[1]), power)


def _least_squares(terms, values):
    """Fits two factors of 0 or more (n x 2 terms)."""
    scales = np.sqrt(np.sum(terms**2, axis=0))
    factors = np.linalg.lstsq(terms / scales, values, rcond=None)[0] / scales
    if np.all(factors >= 0.0):
        return factors
    alone = [max(0.0, float(values @ column) / float(column @ column)) for column in terms.T]
    candidates = [np.array([alone[0], 0.0]), np.array([0.0, alone[1]])]
    return min(candidates, key=lambda item: float(np.sum((terms @ item - values) ** 2)))


class Column(NamedTuple):
    """One quantity, range or bearing, over the bins; arrays with one value per bin."""

    count: np.ndarray  # pairs without outliers
    bias: np.ndarray  # NaN: no pairs
    difference_variance: np.ndarray  # of the camera's minus the lidar's; NaN: too few pairs
    known_variance: np.ndarray  # the part of it due to the lidar and the camera's sides
    enough: np.ndarray  # whether the bin has enough pairs
    measured: np.ndarray  # whether it determines the camera's variance: no dominant known part
    variance: np.ndarray  # the camera's: measured, or from the law
    law: Law


class CovarianceTable(NamedTuple):
    """Range and bearing of one sensor's objects."""

    bin_width: float  # m
    range: Column  # m^2
    bearing: Column  # rad^2

    @property
    def centers(self):
        """Returns the centers of the bins, m."""
        return (np.arange(len(self.range.count)) + 0.5) * self.bin_width


# How errors grow with range. A stereo camera's depth: with its square (thesis 3.3.3 measures it;
# disparities of constant noise explain it). Bearing: that of pixels, and of the apparent center of
# an object, which is off by some centimeters at any range.
RANGE_POWER, BEARING_POWER = 4, -2


def covariance_table(pairs, bin_width, reach, min_pairs, with_bias=False):
    """Computes the CovarianceTable of Pairs (object_pairs).

    bin_width: m; reach: m, upper end of the bins; min_pairs: of a measured bin; with_bias: variance
    about zero, not about the mean. Raises InputError for fewer than two measured bins of range or
    of bearing.
    """
    bins = _bins(reach, bin_width)
    values = np.array(pairs, dtype=float).reshape(-1, 5)
    index = np.floor(values[:, 0] / bin_width).astype(int)
    centers = (np.arange(bins) + 0.5) * bin_width

    def column(name, difference, known, power):
        seen = [np.isfinite(values[:, difference]) & (index == i) for i in range(bins)]
        members = [(values[chosen, difference], values[chosen, known]) for chosen in seen]
        enough = sum(len(differences) >= min_pairs for differences, _ in members)
        if enough < 2:
            raise InputError(
                f"{sum(map(np.sum, seen))} pairs with {name}; {enough} bins of {bin_width:g} m "
                f"within {reach:g} m have {min_pairs} or more, expected two bins: bags with more "
                "traffic, several are taken together"
                f"{_wider_bins(values, bin_width, reach, min_pairs)}"
            )
        return _column(members, centers, min_pairs, power, with_bias)

    return CovarianceTable(
        bin_width, column("range", 1, 3, RANGE_POWER), column("bearing", 2, 4, BEARING_POWER)
    )


def _bins(reach, bin_width):
    """Returns the number of bins up to a range, m."""
    return int(np.ceil(reach / bin_width - 1e-9))


def _wider_bins(values, bin_width, reach, min_pairs):
    """Returns the advice to use wider bins, if these would have enough pairs."""
    seen = [values[np.isfinite(values[:, difference]), 0] for difference in (1, 2)]
    for width in np.arange(2 * bin_width, reach, bin_width):
        counts = [np.bincount((ranges / width).astype(int))[: _bins(reach, width)] for ranges in seen]
        if all(np.count_nonzero(count >= min_pairs) >= 2 for count in counts):
            return f", or --bin-width {width:g}"
    return ""


def _column(members, centers, min_pairs, power, with_bias):
    count = np.zeros(len(members), dtype=int)
    bias, difference_variance, known_variance = np.full((3, len(members)), np.nan)
    for i, (differences, known) in enumerate(members):
        if len(differences) == 0:
            continue
        spread = robust_spread(differences)
        count[i], bias[i] = spread.count, spread.bias
        if len(differences) >= min_pairs:
            difference_variance[i] = spread.variance + with_bias * spread.bias**2
            known_variance[i] = np.median(known)
    enough = np.isfinite(difference_variance)
    if np.any(difference_variance[enough] <= 0.0):
        raise InputError("pairs of a bin differ by nothing at all, expected two sensors' objects")
    own = difference_variance - known_variance
    measured = enough & (own >= MIN_SHARE * difference_variance)
    if not np.any(measured):
        known_variance = np.minimum(known_variance, (1.0 - MIN_SHARE) * difference_variance)
    law = fitted_law(centers[enough], difference_variance[enough], known_variance[enough],
                     count[enough], power)  # fmt: skip
    # Without a constant, a law may be zero near the sensor, or everywhere.
    minimum = MIN_SHARE * np.min(own[measured] if np.any(measured) else law.at(centers)[enough])
    variance = np.where(measured, own, np.maximum(law.at(centers), minimum))
    columns = (count, bias, difference_variance, known_variance, enough, measured, variance)
    return Column(*columns, law)
