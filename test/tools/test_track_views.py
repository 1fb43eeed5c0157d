#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far tracks are from true boxes, and what is in a camera's view: cases worked out by hand."""

import math
import unittest

import numpy as np
from datmo_tools.evaluate.track_frames import distances_to_boxes
from datmo_tools.evaluate.track_views import is_visible, is_in_view
from geometry_msgs.msg import Pose2D

from datmo_fusion.msg import ViewFan


class Distances(unittest.TestCase):
    def test_of_boxes(self):
        """A box of 4 m x 2 m that faces along y: its side is at x = 11, its front at y = 2."""
        poses, size = np.array([[10.0, 0.0, math.pi / 2]]), np.array([[4.0, 2.0]])
        positions = np.array([[10.5, 1.5], [12.0, 0.0], [10.0, 3.0], [14.0, -6.0]])
        expected = [[0.0], [1.0], [1.0], [5.0]]
        np.testing.assert_allclose(distances_to_boxes(positions, poses, size), expected, atol=1e-9)

    def test_of_none(self):
        none = np.empty((0, 2))
        self.assertEqual(distances_to_boxes(none, np.empty((0, 3)), none).shape, (0, 0))
        self.assertEqual(distances_to_boxes(np.zeros((2, 2)), np.empty((0, 3)), none).shape, (2, 0))


class Views(unittest.TestCase):
    """A camera at (1, 0) that faces along y, 30 degrees to either side, from 2 m to 20 m."""

    VIEW = ViewFan(sensor=Pose2D(1.0, 0.0, math.pi / 2), first_bearing=-math.pi / 6,
                   beam_spacing=math.pi / 180, min_range=2.0, range=20.0,
                   reach=[20.0] * 30 + [10.0] * 31)  # fmt: skip

    def test_sector_and_range(self):
        for position, inside in (((1.0, 5.0), True), ((1.0, 1.9), False), ((1.0, 20.1), False),
                              ((4.0, 4.0), False), ((4.0, 6.0), True), ((1.0, -5.0), False)):
            self.assertEqual(is_in_view([self.VIEW], position), inside, position)

    def test_behind_the_end_of_its_view(self):
        """To the left it saw 10 m far; what ended the beams may be the object itself."""
        for position, seen in (((2.0, 15.0), True), ((0.0, 15.0), False), ((0.0, 9.0), True),
                            ((0.0, 10.4), True), ((0.0, 10.6), False)):  # fmt: skip
            self.assertEqual(is_visible([self.VIEW], position), seen, position)

    def test_one_of_several_views(self):
        self.assertFalse(is_in_view([], (1.0, 5.0)))
        self.assertTrue(is_in_view([ViewFan(), self.VIEW], (1.0, 5.0)))

    def test_all_around(self):
        """From the left to the right, with the seam behind."""
        around = ViewFan(first_bearing=math.pi, beam_spacing=-math.pi / 180, range=20.0,
                         reach=[20.0] * 360)  # fmt: skip
        for bearing in np.radians([-179.0, -90.0, 0.0, 90.0, 179.0]):
            position = 5.0 * math.cos(bearing), 5.0 * math.sin(bearing)
            self.assertTrue(is_in_view([around], position), bearing)


if __name__ == "__main__":
    unittest.main()
