#!/usr/bin/python3
"""The figures of drive_score on drives that are worked out by hand."""

import math
import unittest

import numpy as np
from drive_score import (
    PosePath,
    TrackState,
    TrueBox,
    alignment,
    assign,
    distance_to_box,
    end_point_error,
    score_tracking,
)

SECOND = 10**9
STRAIGHT = PosePath([0, SECOND, 2 * SECOND], [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [20.0, 0.0, 0.0]])


def car(number, x, y=0.0, yaw=0.0, moving=False, is_vehicle=True):
    return TrueBox(number, "Car", is_vehicle, moving, np.array([x, y, yaw]), 4.0, 2.0)


def track(number, x, y=0.0, moving=True):
    return TrackState(number, np.array([x, y]), moving)


def everywhere(_stamp, _position):
    return True


class Poses(unittest.TestCase):
    def test_between_and_beyond(self):
        for seconds, x in ((0.5, 5.0), (1.0, 10.0), (-0.1, -1.0), (2.2, 22.0)):
            self.assertAlmostEqual(STRAIGHT.at(int(seconds * SECOND))[0], x)
        self.assertAlmostEqual(STRAIGHT.length(), 20.0)

    def test_frame_that_starts_later_and_turned(self):
        """A path from its own origin, 1 s after the truth, where the truth heads to the left."""
        truth = PosePath(
            STRAIGHT.stamps, [[0.0, 0.0, 0.0], [10.0, 0.0, math.pi / 2], [10.0, 10.0, math.pi / 2]]
        )
        path = PosePath([SECOND, 2 * SECOND], [[0.0, 0.0, 0.0], [9.0, 1.0, 0.0]])
        np.testing.assert_allclose(alignment(path, truth), [10.0, 0.0, math.pi / 2], atol=1e-12)
        self.assertAlmostEqual(end_point_error(path, truth), math.sqrt(2.0))

    def test_perfect_path(self):
        moved = PosePath(
            STRAIGHT.stamps, [[5.0, 1.0, math.pi], [-5.0, 1.0, math.pi], [-15.0, 1.0, math.pi]]
        )
        self.assertAlmostEqual(end_point_error(moved, STRAIGHT), 0.0)


class Assignment(unittest.TestCase):
    def test_distance_to_a_turned_box(self):
        box = car(0, 10.0, 5.0, math.pi / 2)  # 2 m along x, 4 m along y
        self.assertEqual(distance_to_box([10.9, 6.9], box), 0.0)
        self.assertAlmostEqual(distance_to_box([12.0, 5.0], box), 1.0)
        self.assertAlmostEqual(distance_to_box([14.0, 11.0], box), 5.0)

    def test_gate(self):
        self.assertEqual(assign([car(0, 0.0)], [track(7, 4.4)], 2.5), [(0, 0)])
        self.assertEqual(assign([car(0, 0.0)], [track(7, 4.6)], 2.5), [])

    def test_one_to_one_nearest_first(self):
        boxes = [car(0, 0.0), car(1, 6.0)]
        self.assertEqual(assign(boxes, [track(7, 3.1), track(8, 5.0)], 2.5), [(0, 0), (1, 1)])
        self.assertEqual(assign(boxes, [track(7, 3.1)], 2.5), [(1, 0)])
        self.assertEqual(assign(boxes[:1], [track(7, 1.0), track(8, 0.5)], 2.5), [(0, 1)])


class Tracking(unittest.TestCase):
    def test_tracked_share_and_ids(self):
        truth = {stamp: [car(3, 0.0, moving=True)] for stamp in range(10)}
        tracks = {stamp: [track(7 if stamp < 6 else 9, 0.5)] for stamp in range(2, 10)}
        result = score_tracking(truth, tracks, everywhere, 2.5)
        van = result.objects[0]
        self.assertEqual((van.frames, van.moving_frames, van.tracked_frames), (10, 10, 8))
        self.assertAlmostEqual(van.tracked_share, 0.8)
        self.assertEqual(van.track_frames, {7: 4, 9: 4})
        self.assertFalse(van.is_parked)
        self.assertEqual(result.false_track_frames, {})

    def test_parked_car_reported_as_moving(self):
        truth = {stamp: [car(3, 0.0)] for stamp in range(4)}
        tracks = {0: [track(7, 0.0)], 1: [track(7, 0.0, moving=False)]}
        parked = score_tracking(truth, tracks, everywhere, 2.5).objects[0]
        self.assertTrue(parked.is_parked)
        self.assertAlmostEqual(parked.reported_moving_share, 0.25)
        self.assertAlmostEqual(parked.tracked_share, 0.5)

    def test_pedestrian_is_no_parked_car(self):
        truth = {0: [car(3, 0.0, is_vehicle=False)]}
        self.assertFalse(score_tracking(truth, {}, everywhere, 2.5).objects[0].is_parked)

    def test_tracks_of_nothing(self):
        truth = {0: [car(3, 0.0)], 1: []}
        tracks = {
            0: [track(7, 0.0), track(8, 1.0), track(9, 20.0)],
            1: [track(9, 20.0), track(7, -30.0)],
        }
        result = score_tracking(truth, tracks, lambda _, position: position[0] > 0.0, 2.5)
        self.assertEqual(result.false_track_frames, {9: 2})


if __name__ == "__main__":
    unittest.main()
