#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The campaign: what each fault does to the messages of a drive."""

import unittest

import numpy as np
import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from datmo_tools.experiments.line_faults import JUMP, STEREO_INPUTS, Message, faults, faulty

BEGIN = 100.0  # s


def drive():
    """20 s: scans, odometry and transforms at 10 Hz."""
    messages = []
    for i in range(200):
        stamp = rospy.Time.from_sec(90.0 + 0.1 * i)
        scan, odometry, transform = LaserScan(), Odometry(), TransformStamped()
        for each in (scan, odometry, transform):
            each.header.stamp = stamp
        scan.ranges = [float(i)]
        odometry.twist.twist.linear.x = 5.0
        messages += [Message("/scan", scan, stamp.to_sec()), Message("/odometry", odometry, stamp.to_sec()),
                     Message("/tf", TFMessage([transform]), stamp.to_sec())]  # fmt: skip
    return messages


def with_fault(name):
    """Returns the drive with the fault of this name."""
    fault = next(each for each in faults() if each.name == name)
    return faulty(drive(), fault, BEGIN)


def of(messages, topic):
    return [message for message in messages if message.topic == topic]


def offsets(messages, topic):
    """Returns stamps minus record times (s)."""
    return np.array([message.content.header.stamp.to_sec() - message.recorded
                     for message in of(messages, topic)])  # fmt: skip


class LineFaults(unittest.TestCase):
    def test_none_changes_nothing(self):
        self.assertEqual(with_fault("none"), drive())

    def test_a_silent_input_is_left_out(self):
        messages = with_fault("scan silent for 3 s")
        self.assertIn(len(of(messages, "/scan")), (169, 170))
        self.assertEqual(len(of(messages, "/odometry")), 200)

    def test_half_and_double_rates(self):
        self.assertIn(len(of(with_fault("odometry at half the rate for 5 s"), "/odometry")), (174, 175))
        self.assertIn(len(of(with_fault("tf twice each for 5 s"), "/tf")), (250, 251))

    def test_late_messages_keep_their_stamps_and_are_in_order_of_arrival(self):
        messages = with_fault("scan late by 0.5 s for 5 s")
        self.assertAlmostEqual(offsets(messages, "/scan").min(), -0.5, places=6)
        recorded = [message.recorded for message in messages]
        self.assertEqual(recorded, sorted(recorded))

    def test_a_frozen_input_continues_with_new_stamps(self):
        scans = of(with_fault("scan frozen for 3 s"), "/scan")
        self.assertEqual(len({scan.content.header.stamp for scan in scans}), 200)
        self.assertIn(len({scan.content.ranges[0] for scan in scans}), (170, 171))

    def test_clocks_that_are_off(self):
        ahead = offsets(with_fault("odometry clock 5 s ahead for 3 s"), "/odometry")
        self.assertAlmostEqual(ahead.max(), 5.0, places=6)
        self.assertIn(int((ahead > 1.0).sum()), (30, 31))
        drift = offsets(with_fault("scan clock 100 ppm fast for 8 s"), "/scan")
        self.assertAlmostEqual(drift.max(), 8e-4, delta=2e-5)

    def test_single_faults_occur_once(self):
        for name, off in (("scan stamp 1 s ahead once", 1.0), ("scan stamp 1.5 s behind once", -1.5)):
            wrong = [value for value in offsets(with_fault(name), "/scan") if abs(value) > 0.1]
            self.assertEqual(len(wrong), 1)
            self.assertAlmostEqual(wrong[0], off, places=6)
        turns = [message.content.twist.twist.angular.z
                 for message in of(with_fault("odometry 3 rad/s once"), "/odometry")]  # fmt: skip
        self.assertEqual((turns.count(3.0), turns.count(0.0)), (1, 199))

    def test_clocks_that_jump_jump_all_at_once_and_the_mounts_stay(self):
        for jump, name in ((-JUMP, f"all clocks back by {JUMP:g} s (a looped bag)"), (JUMP, f"all clocks ahead by {JUMP:g} s")):
            for topic in ("/scan", "/odometry"):
                off = offsets(with_fault(name), topic)
                np.testing.assert_allclose(off, np.where(np.arange(200) < 100, 0.0, jump), atol=1e-6)

    def test_clocks_that_are_off_from_the_start(self):
        np.testing.assert_allclose(offsets(with_fault("scan clock always 0.1 s ahead"), "/scan"), 0.1, atol=1e-6)
        messages = with_fault("odometry clock always 1 s behind")
        np.testing.assert_allclose(offsets(messages, "/odometry"), -1.0, atol=1e-6)
        np.testing.assert_allclose(offsets(messages, "/scan"), 0.0, atol=1e-6)

    def test_mounts_that_are_missing_late_or_sent_again(self):
        mounts = Message("/tf_static", TFMessage(), 90.0)
        for name, times in (("mounts missing in all of the drive", []), ("mounts late by 1 s", [91.0]), ("mounts twice", [90.0, BEGIN])):
            fault = next(each for each in faults() if each.name == name)
            messages = faulty([mounts, *drive()], fault, BEGIN)
            self.assertEqual([each.recorded for each in of(messages, "/tf_static")], times, name)
            self.assertEqual([each for each in messages if each.topic != "/tf_static"], drive(), name)

    def test_the_drive_with_a_camera_has_also_the_faults_of_its_clouds(self):
        names = [fault.name for fault in faults(STEREO_INPUTS)]
        for name in ("stereo frozen for 3 s", "odometry silent for 3 s", "tf late by 1 s for 5 s", "tf twice each for 5 s"):
            self.assertIn(name, names)
        self.assertFalse([name for name in names if name.startswith("all")])
        fault = next(each for each in faults(STEREO_INPUTS) if each.name == "stereo silent for 3 s")
        clouds = [message._replace(topic="/stereo/points2") for message in of(drive(), "/scan")]
        self.assertIn(len(faulty(clouds, fault, BEGIN)), (169, 170))


if __name__ == "__main__":
    unittest.main()
