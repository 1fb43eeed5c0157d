#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Segments, and rows of parked vehicles: cases worked out by hand."""

import math
import unittest

import numpy as np
from datmo_tools.evaluate.parked_rows import RowOptions, depths_of_vehicles, row_of
from datmo_tools.evaluate.segments import ray_crossings, segments_of

NONE = math.nan
OPTIONS = RowOptions(bridged=10.0, car_length=5.0)


class SegmentGeometry(unittest.TestCase):
    def setUp(self):
        corner = [(1.0, -1.0), (1.0, 3.0), (5.0, 3.0)]
        self.segments = segments_of([corner, [(-2.0, 0.0), (-2.0, 1.0)]])

    def test_lines_become_segments(self):
        self.assertEqual(self.segments.begin.tolist(), [[1.0, -1.0], [1.0, 3.0], [-2.0, 0.0]])
        self.assertTrue(np.allclose(self.segments.headings(), [math.pi / 2, 0.0, math.pi / 2]))
        self.assertEqual(segments_of([]).begin.shape, (0, 2))

    def test_ray_crosses_before_and_behind_it(self):
        distances, share = ray_crossings(np.zeros((1, 2)), np.zeros(1), self.segments)
        np.testing.assert_allclose(distances, [[1.0, NONE, -2.0]])
        self.assertAlmostEqual(share[0, 0], 0.25)


class Rows(unittest.TestCase):
    """Stations 1 m apart."""

    def row(self, *stretches, bounded=None):
        """Returns a row of (number of stations, depth)."""
        depths = np.concatenate([np.full(count, depth) for count, depth in stretches])
        bounded = np.ones(len(depths), dtype=bool) if bounded is None else bounded
        return row_of(depths, bounded, 1.0, OPTIONS)

    def test_vehicle_is_parked_where_it_is_near_the_curb(self):
        curb = np.array([5.0, 5.0, 5.0, 5.0, NONE])
        near = np.array([[3.0, NONE], [2.0, NONE], [3.5, 3.0], [6.0, NONE], [3.0, NONE]])
        far = np.array([[4.5, NONE], [3.5, NONE], [4.5, 4.8], [8.0, NONE], [4.5, NONE]])
        # By the curb; on the lane; two, of which the nearer one counts; beyond the curb; no curb.
        depths = depths_of_vehicles(curb, near, far)
        np.testing.assert_allclose(depths, [2.0, NONE, 2.0, NONE, NONE])

    def test_short_gap_is_bridged(self):
        row = self.row((4, 2.0), (3, NONE), (4, 1.0))
        np.testing.assert_allclose(row.depth[3:8], [2.0, 1.75, 1.5, 1.25, 1.0])
        self.assertFalse(np.any(row.open))

    def test_in_a_gap_longer_than_a_car_the_curb_is_the_border_too(self):
        row = self.row((4, 2.0), (8, NONE), (4, 2.0))
        np.testing.assert_allclose(row.depth, 2.0)
        self.assertEqual(np.flatnonzero(row.open).tolist(), list(range(4, 12)))

    def test_long_gap_ends_the_row(self):
        row = self.row((2, 2.0), (14, NONE), (2, 1.0))
        np.testing.assert_allclose(row.depth[:7], 2.0)
        self.assertTrue(np.all(np.isnan(row.depth[7:11])))
        np.testing.assert_allclose(row.depth[11:], 1.0)
        self.assertEqual(int(row.open.sum()), 10)

    def test_row_ends_at_a_junction(self):
        bounded = np.array([True, True, False, True, True])
        row = self.row((1, 2.0), (3, NONE), (1, 2.0), bounded=bounded)
        np.testing.assert_allclose(row.depth, [2.0, 2.0, NONE, 2.0, 2.0])
        self.assertEqual(row.open.tolist(), [False, True, False, True, False])

    def test_no_vehicles(self):
        row = self.row((5, NONE))
        self.assertTrue(np.all(np.isnan(row.depth)))


if __name__ == "__main__":
    unittest.main()
