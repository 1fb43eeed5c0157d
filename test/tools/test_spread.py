#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Medians and ranges over seeds, as they stand in the figures."""

import unittest

from datmo_tools.spread import rounded, spread, spread_of


class Spread(unittest.TestCase):
    def test_median_and_range(self):
        self.assertEqual(spread([3, 1, 2]), [2, 1, 3])
        self.assertEqual(spread([4.0, 1.0]), [2.5, 1.0, 4.0])

    def test_figures_missing_in_a_run_have_no_spread(self):
        self.assertIsNone(spread([1, None, 2]))
        self.assertIsNone(spread([]))

    def test_nested_figures_are_summarized_one_by_one(self):
        trees = [{"a": {"b": 1}, "c": 5.0}, {"a": {"b": 3}, "c": 7.0}]
        self.assertEqual(spread_of(trees), {"a": {"b": [2, 1, 3]}, "c": [6.0, 5.0, 7.0]})

    def test_four_digits_are_kept(self):
        tree = {"a": [0.123456, 12345.678, 7], "b": float("nan"), "c": None}
        self.assertEqual(rounded(tree), {"a": [0.1235, 12350.0, 7], "b": None, "c": None})


if __name__ == "__main__":
    unittest.main()
