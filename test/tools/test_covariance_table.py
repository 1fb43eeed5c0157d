#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Covariance by range and bearing from synthetic pairs of known variance."""

import math
import unittest
from pathlib import Path

import numpy as np
import yaml
from datmo_tools.errors import InputError
from datmo_tools.evaluate.covariance_report import as_yaml
from datmo_tools.evaluate.covariance_table import covariance_table, fitted_law, robust_spread
from datmo_tools.evaluate.object_pairs import Pair

RANGE_LAW = (0.01, 1e-6)  # m^2 and m^-2: 0.1 m near, 1 m at 32 m
BEARING_LAW = (1e-5, 1e-2)  # rad^2 and m^2


def random():
    return np.random.Generator(np.random.PCG64(1))


def pairs(count=4000, lidar=(0.0, 0.0), bias=0.0, nearest=2.0, reach=30.0):
    """Returns pairs with the laws above; lidar:
    standard deviations of its range (m) and bearing (rad)."""
    generator = random()
    ranges = generator.uniform(nearest, reach, count)
    range_sigmas = np.sqrt(RANGE_LAW[0] + RANGE_LAW[1] * ranges**4 + lidar[0] ** 2)
    bearing_sigmas = np.sqrt(BEARING_LAW[0] + BEARING_LAW[1] / ranges**2 + lidar[1] ** 2)
    offsets = generator.standard_normal((2, count))
    columns = (ranges, offsets[0] * range_sigmas + bias, offsets[1] * bearing_sigmas)
    return [Pair(*map(float, row), lidar[0] ** 2, lidar[1] ** 2) for row in zip(*columns)]


class Table(unittest.TestCase):
    def assert_recovers(self, table, sigmas=4.0):
        """Each measured variance agrees with the law,
        within the uncertainty of its number of pairs."""
        for column, law in ((table.range, (*RANGE_LAW, 4)), (table.bearing, (*BEARING_LAW, -2))):
            # Within a bin ranges differ: the mean of the law over the bin is what is measured.
            edges = np.linspace(-1.0, 1.0, 21)
            within = table.centers[:, np.newaxis] + 0.5 * table.bin_width * edges
            true = np.mean(law[0] + law[1] * np.maximum(within, 0.1) ** law[2], axis=1)
            known = column.measured
            spread = np.sqrt(2.0 / column.count[known]) * column.difference_variance[known]
            deviations = np.abs(column.variance[known] - true[known]) / spread
            self.assertLess(deviations.max(), sigmas)
            self.assertLess(np.sqrt(np.mean(deviations**2)), 1.5)

    def test_known_variance_is_recovered(self):
        table = covariance_table(pairs(), 2.0, 30.0, 30)
        self.assertTrue(np.all(table.range.measured[1:]))
        self.assert_recovers(table)

    def test_outliers_do_not_matter(self):
        """One in twenty pairs is of two objects."""
        generator = random()
        mixed = [
            pair._replace(range_difference=float(generator.uniform(-5.0, 5.0)),
                          bearing_difference=float(generator.uniform(-0.2, 0.2)))
            if i % 20 == 0 else pair
            for i, pair in enumerate(pairs())
        ]  # fmt: skip
        table = covariance_table(mixed, 2.0, 30.0, 30)
        plain = covariance_table(pairs(), 2.0, 30.0, 30)
        for column, other in ((table.range, plain.range), (table.bearing, plain.bearing)):
            known = column.measured
            ratios = column.variance[known] / other.variance[known]
            self.assertLess(np.abs(np.log(ratios)).max(), math.log(1.5))

    def test_lidar_covariance_is_subtracted(self):
        self.assert_recovers(covariance_table(pairs(lidar=(0.2, 0.01)), 2.0, 30.0, 30))

    def test_variance_stays_above_zero(self):
        """A lidar that claims to be worse than all differences."""
        doubtful = [pair._replace(known_range_variance=100.0) for pair in pairs()]
        column = covariance_table(doubtful, 2.0, 30.0, 30).range
        self.assertFalse(np.any(column.measured))
        self.assertTrue(np.all(column.variance > 0.0))
        known = column.enough
        self.assertTrue(np.all(column.variance[known] < column.difference_variance[known]))

    def test_lidar_that_hides_all_but_one_bin(self):
        """The others' variance agrees with the law, and is not zero."""
        sure = [
            pair._replace(known_range_variance=1.5 * (RANGE_LAW[0] + RANGE_LAW[1] * pair.range**4))
            for pair in pairs() if not 14.0 <= pair.range < 16.0
        ] + [pair for pair in pairs() if 14.0 <= pair.range < 16.0]  # fmt: skip
        column = covariance_table(sure, 2.0, 20.0, 30).range
        self.assertEqual(np.flatnonzero(column.measured).tolist(), [7])
        self.assertTrue(np.all(column.variance >= 0.09 * column.variance[7]))

    def test_bin_that_the_lidar_hides_is_of_the_law(self):
        """A lidar that is worse than the camera up to 12 m, and reports it."""
        noise = random().standard_normal(20000)
        hidden = [
            pair._replace(range_difference=pair.range_difference + float(offset),
                          known_range_variance=1.0)
            if pair.range < 12.0 else pair
            for pair, offset in zip(pairs(20000), noise)
        ]  # fmt: skip
        column = covariance_table(hidden, 2.0, 30.0, 30).range
        self.assertFalse(np.any(column.measured[:6]))
        self.assertTrue(np.all(column.measured[6:]))
        centers = (np.arange(15) + 0.5) * 2.0
        true = RANGE_LAW[0] + RANGE_LAW[1] * centers**4
        np.testing.assert_allclose(column.variance[:6], true[:6], rtol=0.5)

    def test_gaps_are_filled_by_the_law(self):
        """Nothing from 10 m to 16 m, and beyond 24 m."""
        chosen = [pair for pair in pairs() if not 10.0 <= pair.range < 16.0 and pair.range < 24.0]
        column = covariance_table(chosen, 2.0, 36.0, 30).range
        filled = ~column.measured
        self.assertEqual(np.flatnonzero(filled).tolist(), [0, 5, 6, 7, *range(12, 18)])
        centers = (np.arange(18) + 0.5) * 2.0
        true = RANGE_LAW[0] + RANGE_LAW[1] * centers**4
        np.testing.assert_allclose(column.variance[filled], true[filled], rtol=0.25)

    def test_bias_is_reported_and_added_only_on_demand(self):
        biased = pairs(bias=0.5)
        column = covariance_table(biased, 2.0, 30.0, 30).range
        np.testing.assert_allclose(column.bias[1:5], 0.5, atol=0.05)
        self.assert_recovers(covariance_table(biased, 2.0, 30.0, 30))
        added = covariance_table(biased, 2.0, 30.0, 30, with_bias=True).range
        np.testing.assert_allclose((added.variance - column.variance)[1:],
                                   column.bias[1:] ** 2, rtol=1e-6)  # fmt: skip

    def test_few_pairs(self):
        with self.assertRaisesRegex(
            InputError, "20 pairs with range; 0 bins .* expected two bins: bags with more traffic"
        ):
            covariance_table(pairs(20), 2.0, 30.0, 30)
        with self.assertRaisesRegex(InputError, "0 pairs with range"):
            covariance_table([], 2.0, 30.0, 30)

    def test_wider_bins_are_advised_where_they_would_do(self):
        few = pairs(100)
        with self.assertRaisesRegex(InputError, "or --bin-width ([0-9]+)$") as context:
            covariance_table(few, 2.0, 30.0, 30)
        width = float(str(context.exception).rsplit(" ", 1)[1])
        self.assertEqual(covariance_table(few, width, 30.0, 30).bin_width, width)

    def test_pairs_beyond_the_range_are_no_reason_for_wider_bins(self):
        few = [*pairs(20, reach=10.0), *pairs(200, nearest=11.0)]
        with self.assertRaisesRegex(InputError, "several are taken together$"):
            covariance_table(few, 2.0, 10.0, 30)

    def test_a_name_of_several_lines_stays_in_its_comment(self):
        text = as_yaml(covariance_table(pairs(), 2.0, 30.0, 30), "stereo", [Path("two\nlines: true.bag")])
        self.assertEqual(list(yaml.safe_load(text)), ["object_fusion"])

    def test_normal_spread(self):
        spread = robust_spread(random().normal(1.0, 2.0, 20000))
        self.assertAlmostEqual(spread.variance, 4.0, delta=0.1)
        self.assertAlmostEqual(spread.bias, 1.0, delta=0.05)

    def test_law_is_never_below_zero(self):
        """Variances that decrease with range: no r^4 term."""
        ranges = np.array([5.0, 10.0, 20.0])
        nothing = np.zeros(3)
        law = fitted_law(ranges, [0.3, 0.2, 0.1], nothing, [50, 50, 50], 4)
        self.assertEqual(law.factor, 0.0)
        self.assertTrue(0.1 < law.constant < 0.3)
        # Those that grow faster: no constant term.
        law = fitted_law(ranges, 1e-6 * ranges**5, nothing, [50, 50, 50], 4)
        self.assertEqual(law.constant, 0.0)


if __name__ == "__main__":
    unittest.main()
