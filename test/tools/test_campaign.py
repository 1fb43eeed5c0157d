#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The campaign: what each fault does to the messages of a drive, by hand, and what is said of the poses."""

import unittest

import numpy as np
import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from datmo_tools.experiments.campaign import effect, page
from datmo_tools.experiments.line_faults import Message, faults, faulty

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
    """The drive with the fault of this name."""
    fault = next(each for each in faults() if each.name == name)
    return faulty(drive(), fault, BEGIN)


def of(messages, topic):
    return [message for message in messages if message.topic == topic]


def offsets(messages, topic):
    """s, stamps before when they were recorded."""
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

    def test_a_frozen_input_goes_on_under_new_stamps(self):
        scans = of(with_fault("scan frozen for 3 s"), "/scan")
        self.assertEqual(len({scan.content.header.stamp for scan in scans}), 200)
        self.assertIn(len({scan.content.ranges[0] for scan in scans}), (170, 171))

    def test_clocks_that_are_off(self):
        ahead = offsets(with_fault("odometry clock 5 s ahead for 3 s"), "/odometry")
        self.assertAlmostEqual(ahead.max(), 5.0, places=6)
        self.assertIn(int((ahead > 1.0).sum()), (30, 31))
        drift = offsets(with_fault("scan clock 100 ppm fast for 8 s"), "/scan")
        self.assertAlmostEqual(drift.max(), 8e-4, delta=2e-5)

    def test_what_happens_once_happens_once(self):
        for name, off in (("scan stamp 1 s ahead once", 1.0), ("scan stamp 1.5 s behind once", -1.5)):
            wrong = [value for value in offsets(with_fault(name), "/scan") if abs(value) > 0.1]
            self.assertEqual(len(wrong), 1)
            self.assertAlmostEqual(wrong[0], off, places=6)
        turns = [message.content.twist.twist.angular.z
                 for message in of(with_fault("odometry 3 rad/s once"), "/odometry")]  # fmt: skip
        self.assertEqual((turns.count(3.0), turns.count(0.0)), (1, 199))


class Effect(unittest.TestCase):
    """A drive of 20 s with a fault from 8 s to 11 s; without it the pose is 0.1 m off."""

    def setUp(self):
        self.stamps = np.arange(0.0, 20.0, 0.1)
        self.clean = (self.stamps, np.full(200, 0.1))

    def effect(self, errors):
        return effect(self.stamps, errors, self.clean, 8.0, 11.0)

    def test_one_that_is_as_good_has_nothing_to_recover_from(self):
        result = self.effect(np.full(200, 0.3))
        self.assertEqual((result["recovered_s"], result["recovered"]), (0.0, True))
        self.assertAlmostEqual(result["largest_error_m"], 0.3)

    def test_the_time_until_it_is_right_again(self):
        errors = np.full(200, 0.1)
        errors[90:131] = 2.0
        result = self.effect(errors)
        self.assertAlmostEqual(result["recovered_s"], 2.0)
        self.assertTrue(result["recovered"])

    def test_one_that_stays_wrong_says_so(self):
        result = self.effect(np.where(self.stamps < 9.0, 0.1, 3.0))
        self.assertFalse(result["recovered"])
        run = {"fault": "scan silent", "error": None, "pose": result,
               "tracks": {"mota": 0.5, "misses": 3, "false_positives": 0, "id_switches": 1}}  # fmt: skip
        text = page({"drive": "a.bag", "begin_s": 8.0, "runs": [run], "mutated": None})
        self.assertIn("| scan silent | 200 | 3.00 | 3.00 | never | 0.500 | 3 | 0 | 1 |", text)


if __name__ == "__main__":
    unittest.main()
