# SPDX-License-Identifier: BSD-3-Clause
"""Small bags of a run and its truth, shared by the tests of score_run as a program."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import (
    Point,
    Pose,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    Vector3,
)
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from datmo_fusion.msg import Object, Track, TrackArray, TrueObject, TrueObjectArray

SCORE_RUN = os.environ["DATMO_FUSION_SCORE_RUN"]

FRAMES = 21
PERIOD = 0.1  # s
START = 1000.0  # s
SPEED = 10.0  # m/s, of the car and of the vehicle behind it
CAR_AHEAD = 20.0  # m


def header(frame, i):
    return Header(stamp=rospy.Time.from_sec(START + PERIOD * i), frame_id=frame)


def pose_at(x, y=0.0):
    return Pose(position=Point(x, y, 0.0), orientation=Quaternion(0.0, 0.0, 0.0, 1.0))


def identity(size):
    return [float(i % (size + 1) == 0) for i in range(size * size)]


def track_at(number, x, y=0.0):
    return Track(
        id=number, pose=pose_at(x, y), size=Vector3(4.0, 2.0, 0.0), velocity=Vector3(SPEED, 0, 0),
        covariance=identity(6), moving=True, sensors=["scanner"],
    )  # fmt: skip


def car_at(number, x, y=0.0):
    return TrueObject(
        id=number, label="Car", classification=Object.CLASS_VEHICLE, pose=pose_at(x, y),
        size=Vector3(4.0, 2.0, 1.5), velocity=Vector3(SPEED, 0.0, 0.0), moving=True,
        visible_to=["scanner"], lidar_beams=3,
    )  # fmt: skip


def run_messages():
    """Returns topic -> messages of a run that tracks the car half a meter beside it, with id 7."""
    messages = {"/tracks": [], "/pose": []}
    for i in range(FRAMES):
        distance = SPEED * PERIOD * i
        tracks = [track_at(7, distance + CAR_AHEAD, 0.5)]
        pose = PoseWithCovarianceStamped(header=header("map", i))
        pose.pose.pose = pose_at(distance)
        pose.pose.covariance = identity(6)
        messages["/tracks"].append(TrackArray(header=header("map", i), tracks=tracks))
        messages["/pose"].append(pose)
    return messages


def truth_messages():
    """Returns topic -> messages of a car ahead of a vehicle that follows it, along x of the map."""
    messages = {"/ground_truth/objects": [], "/ground_truth/pose": []}
    for i in range(FRAMES):
        distance = SPEED * PERIOD * i
        objects = [car_at(1, distance + CAR_AHEAD)]
        pose = Odometry(header=header("map", i), child_frame_id="base_link_ground_truth")
        pose.pose.pose = pose_at(distance)
        messages["/ground_truth/objects"].append(
            TrueObjectArray(header=header("map", i), objects=objects)
        )
        messages["/ground_truth/pose"].append(pose)
    return messages


def mount():
    """Returns a scanner in the middle of the vehicle."""
    transform = TransformStamped(header=header("base_link", 0), child_frame_id="scanner")
    transform.transform.rotation.w = 1.0
    return TFMessage(transforms=[transform])


def scan_at(i):
    """Returns three beams, the middle one of which ends on the rear of the car ahead."""
    return LaserScan(
        header=header("scanner", i), angle_min=-0.2, angle_max=0.2, angle_increment=0.2,
        range_min=0.1, range_max=80.0, ranges=[float("inf"), CAR_AHEAD - 2.0, float("inf")],
    )  # fmt: skip


def write(path, messages):
    with rosbag.Bag(str(path), "w") as bag:
        for topic, items in messages.items():
            for i, item in enumerate(items):
                bag.write(topic, item, rospy.Time.from_sec(START + PERIOD * i))


class ScoreRunCase(unittest.TestCase):
    """Two bags, written as here unless a test changes them, and the program on them."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.run_bag = self.folder / "run.bag"
        self.truth_bag = self.folder / "truth.bag"
        self.report = self.folder / "report.json"
        self.run_messages = run_messages()
        self.truth_messages = truth_messages()

    def write_bags(self):
        write(self.run_bag, self.run_messages)
        write(self.truth_bag, self.truth_messages)

    def run_tool(self, *arguments):
        return subprocess.run([SCORE_RUN, *map(str, arguments)], stderr=subprocess.PIPE,
                              stdout=subprocess.PIPE, universal_newlines=True)

    def score(self, *options):
        """Returns the report of the two bags."""
        self.write_bags()
        done = self.run_tool(self.run_bag, self.truth_bag, "--out", self.report, *options)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        return json.loads(self.report.read_text())

    def assert_no_report(self, *expected, arguments=None):
        """Expects that there is no report, and that the message contains all of `expected`."""
        if arguments is None:
            arguments = (self.run_bag, self.truth_bag, "--out", self.report)
        before = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stdout, "")
        for part in expected:
            self.assertIn(str(part), done.stderr)
        after = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        self.assertEqual(before.keys(), after.keys())
        self.assertTrue(before == after, "a file was changed")

    def assert_refused(self, *expected):
        """Expects that the bags as they are now lead to no report."""
        self.write_bags()
        self.assert_no_report(*expected)
