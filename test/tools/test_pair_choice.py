#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Python tools pair by score_run's matcher: as many pairs as possible, one to one."""

import unittest

import numpy as np
from datmo_tools.evaluate.object_lists import MovingBox, Seen, SeenList
from datmo_tools.evaluate.object_pairs import Counts, paired_objects
from datmo_tools.evaluate.pair_choice import nearest_pairs
from datmo_tools.experiments.kept_ids import _ids_of
from datmo_tools.pose_path import PosePath
from geometry_msgs.msg import Point, Pose, Quaternion

from datmo_fusion.msg import Object, Track, TrackArray, TrueObject

STAMP = 10**9
AT_ORIGIN = PosePath([0, 2 * STAMP], np.zeros((2, 3)))
FAR = np.inf


def pose(x, y):
    return Pose(Point(x, y, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))


class Pairs(unittest.TestCase):
    def test_most_pairs_before_near_ones(self):
        """The nearest pair first would leave the others without one."""
        self.assertEqual(nearest_pairs([[[1.9, 0.4], [FAR, 0.5]]]), [[(0, 0), (1, 1)]])

    def test_least_sum_of_equally_many(self):
        self.assertEqual(nearest_pairs([[[1.0, 2.0], [1.5, 4.0]]]), [[(0, 1), (1, 0)]])

    def test_lists_without_pairs(self):
        self.assertEqual(nearest_pairs([np.zeros((0, 3)), np.zeros((2, 0)), [[FAR]]]), [[], [], []])
        self.assertEqual(nearest_pairs([]), [])


class Users(unittest.TestCase):
    """One of two objects has only one neighbor, which is nearer to the other one."""

    def list_of(self, *ys):
        objects = [Seen(np.array([20.0, y, 0.0]), np.array([0.2, 0.2]), np.eye(2), np.zeros(4),
                        Object.CLASS_UNKNOWN, 0.0) for y in ys]  # fmt: skip
        return SeenList(STAMP, objects, {})

    def test_objects_of_two_sensors(self):
        boxes = {STAMP: [MovingBox(np.array([20.0, 0.0, 0.0]), np.ones(2), np.zeros(2))]}
        _, counts = paired_objects([self.list_of(0.3, -0.4)], [self.list_of(1.2, 0.0)], boxes, AT_ORIGIN)
        self.assertEqual(counts, Counts(objects=2, paired=2))

    def test_ids_of_objects(self):
        """An object gets its own track, or none."""
        tracks = TrackArray(tracks=[Track(id=7, pose=pose(10.0, 0.0)), Track(id=8, pose=pose(10.0, 1.9))])
        tracks.header.stamp.secs = 1
        truth = [TrueObject(id=number, pose=pose(10.0, y)) for number, y in ((1, 0.4), (2, -0.5), (3, -1.0))]
        found = _ids_of(tracks, truth, {1, 2, 3}, (AT_ORIGIN, AT_ORIGIN))
        self.assertEqual(found, {1: 8, 2: 7})


if __name__ == "__main__":
    unittest.main()
