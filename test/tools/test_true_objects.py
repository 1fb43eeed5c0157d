#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tools that read true objects with the one reader, on drives that are worked out by hand."""

import math
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import rosbag
from datmo_tools import bag_messages
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import drives_of
from datmo_tools.evaluate.risk_drives import read_drive
from datmo_tools.experiments.kept_ids import kept_ids
from datmo_tools.experiments.pole_camera import MapOfRun
from datmo_tools.experiments.pole_camera_bag import PEDESTRIAN, Truth
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3

from datmo_fusion.msg import RiskArray, Track, TrackArray, TrueContact, TrueObject, TrueObjectArray

START, PERIOD, FRAMES = 1000 * 10**9, 10**8, 41  # ns, ns, 1
TRUE_OBJECTS, TRUE_POSE = "/ground_truth/objects", "/ground_truth/pose"
RUN_POSE = np.array([3.0, 5.0, 0.5 * math.pi])  # of the stationary vehicle in the run's map
WALKER = 7
FACING_X = Quaternion(0.0, 0.0, 0.0, 1.0)


def stamp_of(frame):
    return START + frame * PERIOD


def pose(frame, xyyaw):
    return bag_messages.planar_odometry(stamp_of(frame), "map", "base_link", xyyaw, 0.0, 0.0)


class Drives(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.drive, self.run_bag = (Path(folder.name, name) for name in ("drive.bag", "run.bag"))

    def write(self, path, messages):
        """messages: of (topic, message)."""
        with rosbag.Bag(str(path), "w") as bag:
            for topic, message in messages:
                bag.write(topic, message, message.header.stamp)

    def truth(self, objects=TRUE_OBJECTS, beams=lambda frame: 5):
        """The stationary vehicle at the origin, and a pedestrian 10 m ahead who walks to the left
        at 1 m/s; beams: of the scanner on him, function of the frame. Returns (topic, message)."""
        for frame in range(FRAMES):
            walker = TrueObject(id=WALKER, classification=PEDESTRIAN, moving=True, visible_to=["stereo"],
                                pose=Pose(Point(10.0, 0.1 * frame, 0.0), FACING_X),
                                velocity=Vector3(0.0, 1.0, 0.0), lidar_beams=beams(frame))  # fmt: skip
            header = bag_messages.header(stamp_of(frame), "map")
            yield objects, TrueObjectArray(header=header, objects=[walker])
            yield TRUE_POSE, pose(frame, np.zeros(3))

    def track_run(self, id_of):
        """Tracks of the pedestrian; id_of: function of the frame."""
        for frame in range(FRAMES):
            yield "/pose", pose(frame, RUN_POSE)
            track = Track(id=id_of(frame), pose=Pose(Point(3.0 - 0.1 * frame, 15.0, 0.0), FACING_X))
            header = bag_messages.header(stamp_of(frame), "map")
            yield "/tracks", TrackArray(header=header, tracks=[track])


class KeptIds(Drives):
    def kept(self, id_of):
        self.write(self.run_bag, self.track_run(id_of))
        return kept_ids(self.run_bag, self.drive, 1001.0, 1002.95)

    def test_an_id_is_kept_or_not(self):
        self.write(self.drive, self.truth())
        expected = {"seen": 1, "tracked": 1, "kept": 1, "lists_meanwhile": 20}
        self.assertEqual(self.kept(lambda frame: 4), expected)
        self.assertEqual(self.kept(lambda frame: 4 if frame < 20 else 6), {**expected, "kept": 0})

    def test_a_drive_without_truth_is_refused(self):
        self.write(self.drive, self.truth(objects="/others"))
        with self.assertRaisesRegex(InputError, "nothing on /ground_truth/objects, expected"):
            self.kept(lambda frame: 4)

    def test_truth_of_another_type_is_refused(self):
        self.write(self.drive, [*self.truth(objects="/others"), (TRUE_OBJECTS, pose(0, RUN_POSE))])
        with self.assertRaisesRegex(InputError, "is nav_msgs/Odometry, expected datmo_fusion/TrueObjectArray"):
            self.kept(lambda frame: 4)


class Risks(Drives):
    def risks(self):
        for frame in range(FRAMES):
            yield "/risks", RiskArray(header=bag_messages.header(stamp_of(frame), "map"))

    def test_in_view_since_the_last_gap(self):
        """Six frames without a beam are a gap, four are none."""
        contact = TrueContact(header=bag_messages.header(stamp_of(FRAMES - 1), "map"), id=WALKER)
        hidden = (*range(8, 14), *range(20, 24))
        self.write(self.drive, [*self.truth(beams=lambda frame: 0 if frame in hidden else 5), *self.risks(),
                                ("/ground_truth/contact", contact)])  # fmt: skip
        drive = read_drive(self.drive)
        self.assertAlmostEqual(drive.seen, 1001.4)
        self.assertEqual((drive.contact, drive.end, len(drive.frames)), (1004.0, 1004.0, FRAMES - 1))

    def test_a_drive_without_contact_ends_with_its_last_message(self):
        later = TrueObjectArray(header=bag_messages.header(stamp_of(FRAMES), "map"))
        self.write(self.drive, [*self.truth(), *self.risks(), (TRUE_OBJECTS, later)])
        self.assertAlmostEqual(read_drive(self.drive).end, 1004.1)

    def test_a_drive_without_truth_is_refused(self):
        self.write(self.drive, self.risks())
        with self.assertRaisesRegex(InputError, "nothing on /ground_truth/objects, expected"):
            read_drive(self.drive)

    def test_truth_of_another_type_is_refused(self):
        self.write(self.drive, [*self.risks(), (TRUE_OBJECTS, pose(0, RUN_POSE))])
        with self.assertRaisesRegex(InputError, "is nav_msgs/Odometry, expected datmo_fusion/TrueObjectArray"):
            read_drive(self.drive)


class PoleCamera(Drives):
    def test_positions_in_the_map_of_the_run(self):
        """Ahead of the vehicle is up in the map, and the pedestrian walks to the left of it."""
        self.write(self.drive, self.truth())
        self.write(self.run_bag, self.track_run(lambda frame: 1))
        truth = Truth(self.drive)
        walker = truth.nearest(stamp_of(20), PEDESTRIAN)
        later = stamp_of(20) + PERIOD // 2
        np.testing.assert_allclose(MapOfRun(self.run_bag, truth).position_of(walker, later), [0.95, 15.0])


class Arguments(unittest.TestCase):
    def test_one_bag_with_the_truth_for_each_run(self):
        self.assertEqual(drives_of(SimpleNamespace(runs=["a", "b"], truth=["c", "d"])), ["c", "d"])
        self.assertEqual(drives_of(SimpleNamespace(runs=["a", "b"], truth=None)), ["a", "b"])
        with self.assertRaisesRegex(InputError, "1 --truth for 2 runs: expected one for each"):
            drives_of(SimpleNamespace(runs=["a", "b"], truth=["c"]))


if __name__ == "__main__":
    unittest.main()
