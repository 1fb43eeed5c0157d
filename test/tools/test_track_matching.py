#!/usr/bin/python3
"""Which track is of which true object, and what is in a camera's view: cases worked out by hand."""

import math
import unittest

import numpy as np
from datmo_tools.track_matching import TrackMatcher, Verdict, distances_to_boxes
from datmo_tools.track_views import is_visible, is_in_view
from geometry_msgs.msg import Pose2D

from datmo_fusion.msg import ViewFan

HIT, NEUTRAL, FALSE = Verdict.HIT, Verdict.NEUTRAL, Verdict.FALSE


class Distances(unittest.TestCase):
    def test_of_boxes(self):
        """A box of 4 m x 2 m that looks along y: its side is at x = 11, its front at y = 2."""
        poses, size = np.array([[10.0, 0.0, math.pi / 2]]), np.array([[4.0, 2.0]])
        positions = np.array([[10.5, 1.5], [12.0, 0.0], [10.0, 3.0], [14.0, -6.0]])
        expected = [[0.0], [1.0], [1.0], [5.0]]
        np.testing.assert_allclose(distances_to_boxes(positions, poses, size), expected, atol=1e-9)

    def test_of_none(self):
        none = np.empty((0, 2))
        self.assertEqual(distances_to_boxes(none, np.empty((0, 3)), none).shape, (0, 0))
        self.assertEqual(distances_to_boxes(np.zeros((2, 2)), np.empty((0, 3)), none).shape, (2, 0))


class Matching(unittest.TestCase):
    """Tracks 1, 2 and objects 7, 8, within 2 m."""

    def setUp(self):
        self.matcher = TrackMatcher(2.0)

    def assert_match(self, partners, verdicts, distances, required=(True, True)):
        distances = np.array(distances)
        found = self.matcher.match([1, 2][: len(distances)], [7, 8][: distances.shape[1]],
                                   np.array(required), distances)  # fmt: skip
        self.assertEqual(found, (partners, verdicts))

    def test_least_sum_of_distances(self):
        self.assert_match([1, 0], [HIT, HIT], [[1.0, 0.4], [0.9, 0.5]])

    def test_more_matches_before_nearer_ones(self):
        """The nearest pair alone would leave the other two without a match."""
        self.assert_match([0, 1], [HIT, HIT], [[1.9, 0.4], [2.5, 0.5]])

    def test_nobody(self):
        matcher = TrackMatcher(2.0)
        none = np.zeros((0, 0))
        self.assertEqual(matcher.match([], [], np.zeros(0, dtype=bool), none), ([], []))
        self.assertEqual(matcher.match([1], [], np.zeros(0, dtype=bool), np.zeros((1, 0))),
                         ([None], [FALSE]))

    def test_beyond_the_gate(self):
        self.assert_match([None], [FALSE], [[2.1, 3.0]])

    def test_second_track_on_an_object(self):
        """False where the object has to be found, else as little wrong as the first."""
        self.assert_match([0, None], [HIT, FALSE], [[0.5], [1.0]], [True])
        self.assert_match([0, None], [NEUTRAL, NEUTRAL], [[0.5], [1.0]], [False])

    def test_partners_stay(self):
        self.assert_match([0, None], [HIT, FALSE], [[0.5], [1.0]], [True])
        self.assert_match([None, None], [FALSE, FALSE], [[3.0], [3.0]], [True])
        self.assert_match([0, None], [HIT, FALSE], [[1.5], [0.0]], [True])

    def test_required_objects_first(self):
        self.assert_match([1], [HIT], [[0.1, 1.9]], [False, True])


class Views(unittest.TestCase):
    """A camera at (1, 0) that looks along y, 30 degrees to either side, from 2 m to 20 m."""

    VIEW = ViewFan(sensor=Pose2D(1.0, 0.0, math.pi / 2), first_bearing=-math.pi / 6,
                   beam_spacing=math.pi / 180, min_range=2.0, range=20.0,
                   reach=[20.0] * 30 + [10.0] * 31)  # fmt: skip

    def test_sector_and_range(self):
        for position, inside in (((1.0, 5.0), True), ((1.0, 1.9), False), ((1.0, 20.1), False),
                              ((4.0, 4.0), False), ((4.0, 6.0), True), ((1.0, -5.0), False)):
            self.assertEqual(is_in_view([self.VIEW], position), inside, position)

    def test_behind_what_it_saw(self):
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
