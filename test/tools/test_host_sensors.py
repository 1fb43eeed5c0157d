#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Simulated steering and acceleration agree with the truth, and run_bag and replay_risks read them
in the same way."""

import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag

REPOSITORY = Path(__file__).resolve().parents[2]
SCENE = REPOSITORY / "rosbag_fixtures" / "scenes" / "intersection.yaml"
CONFIG = REPOSITORY / "config" / "demonstrator.yaml"
WHEELBASE, RATE, DURATION = 2.7, 50.0, 8.0  # m, Hz, s: defaults of the sensors; of the drive
STEERING_NOISE, ACCELERATION_NOISE = math.radians(0.2), 0.2  # rad, m/s^2: defaults


def call(program, *arguments):
    return subprocess.run([os.environ[program], *map(str, arguments)], stderr=subprocess.PIPE,
                          stdout=subprocess.PIPE, universal_newlines=True)  # fmt: skip


def series(bag, topic, values):
    """Returns an array of the stamp (s) and values(message) of each message."""
    return np.array([(message.header.stamp.to_sec(), *values(message))
                     for _, message, _ in bag.read_messages(topic)])  # fmt: skip


def risks_of(path):
    """Returns times and bytes of /risks."""
    with rosbag.Bag(str(path)) as bag:
        return [(time, message[1]) for _, message, time in bag.read_messages("/risks", raw=True)]


class HostSensors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.drive, cls.run_file = cls.folder / "drive.bag", cls.folder / "run.bag"
        cls.expect_success(call("SIMULATE", SCENE, cls.drive, "--set", f"duration={DURATION}",
                                "--set", "vehicle_sensors/enabled=true"))  # fmt: skip
        cls.expect_success(call("RUN_BAG", cls.drive, cls.run_file, "--config", CONFIG, "--risk",
                                "--quiet"))  # fmt: skip

    @staticmethod
    def expect_success(done):
        if done.returncode != 0:
            raise AssertionError(done.stderr)

    def replay(self, drive, *options):
        replayed = self.folder / "replayed.bag"
        done = call("REPLAY_RISKS", self.run_file, drive, replayed, "--config", CONFIG, *options)
        return done, replayed

    def test_they_measure_the_truth(self):
        with rosbag.Bag(str(self.drive)) as bag:
            steering = series(bag, "/steering", lambda message: message.position)
            along = series(bag, "/acceleration", lambda message: (
                message.accel.accel.linear.x, message.accel.covariance[0]))  # fmt: skip
            truth = series(bag, "/ground_truth/pose", lambda message: (
                message.twist.twist.linear.x, message.twist.twist.angular.z))  # fmt: skip
        self.assertAlmostEqual(len(steering), DURATION * RATE, delta=1)
        self.assertEqual(len(along), len(steering))
        self.assertTrue(np.allclose(along[:, 2], ACCELERATION_NOISE**2))
        moving = truth[truth[:, 1] > 1.0]
        angles = np.arctan(WHEELBASE * moving[:, 2] / moving[:, 1])
        errors = np.interp(moving[:, 0], steering[:, 0], steering[:, 1]) - angles
        self.assertLess(np.median(np.abs(errors)), STEERING_NOISE)
        # Noise of 50 measurements a second, against the change of the speed from start to end.
        change = np.mean(along[:, 1]) * (truth[-1, 0] - truth[0, 0])
        self.assertAlmostEqual(change, truth[-1, 1] - truth[0, 1],
                               delta=4.0 * ACCELERATION_NOISE * math.sqrt(DURATION / RATE) + 0.1)  # fmt: skip

    def test_run_bag_and_replay_risks_give_the_same_risks(self):
        done, replayed = self.replay(self.drive)
        self.expect_success(done)
        self.assertGreater(len(risks_of(replayed)), 50)
        self.assertTrue(risks_of(replayed) == risks_of(self.run_file))

    def test_they_change_the_risks(self):
        without = self.folder / "without.bag"
        with rosbag.Bag(str(self.drive)) as bag, rosbag.Bag(str(without), "w") as out:
            for topic, message, time in bag.read_messages():
                if topic not in ("/steering", "/acceleration"):
                    out.write(topic, message, time)
        done, replayed = self.replay(without)
        self.expect_success(done)
        self.assertFalse(risks_of(replayed) == risks_of(self.run_file))

    def test_slashes_before_frames_are_ignored(self):
        slashed = self.folder / "slashed.bag"
        with rosbag.Bag(str(self.drive)) as bag, rosbag.Bag(str(slashed), "w") as out:
            for topic, message, time in bag.read_messages():
                if topic == "/odometry":
                    message.header.frame_id = "/" + message.header.frame_id
                    message.child_frame_id = "/" + message.child_frame_id
                elif topic == "/acceleration":
                    message.header.frame_id = "/base_link"
                out.write(topic, message, time)
        done, replayed = self.replay(slashed)
        self.expect_success(done)
        self.assertTrue(risks_of(replayed) == risks_of(self.run_file))

    def test_a_topic_that_is_asked_for_must_be_there(self):
        for option in ("--steering", "--acceleration"):
            done, replayed = self.replay(self.drive, option, "/none")
            self.assertEqual(done.returncode, 1)
            self.assertIn("on /none", done.stderr)
            self.assertFalse(replayed.exists())

    def tearDown(self):
        (self.folder / "replayed.bag").unlink(missing_ok=True)


if __name__ == "__main__":
    unittest.main()
