#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""mocap_to_bag on made-up recordings: contents of the bag, options, errors, determinism."""

import contextlib
import io
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag
from datmo_tools.convert.mocap_to_bag import main
from datmo_tools.pose_path import planar
from tiny_capture import SCANS, START, write_recording

EGO_SPEED, RED_SPEED = 1.0, 0.5  # m/s
EXACT = ("--range-errors", "0:0", "--scan-delay", "0")


def ego(seconds):
    """Along y of the room from (2, 1)."""
    return (2.0, 1.0 + EGO_SPEED * seconds, 0.5 * math.pi)


def red(seconds):
    """2 m ahead of the ego car's start, in its direction, and slower."""
    return (2.0, 3.0 + RED_SPEED * seconds, 0.5 * math.pi)


class Conversion(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.recording, self.bag = self.root / "drive.bag", self.root / "out.bag"

    def convert(self, *options, expected_code=0, **recorded):
        """Runs the tool without a subprocess; returns its standard error."""
        content = {"ego": ego, "red": red, "ranges": [1.0, 2.0, 4.0, math.inf], **recorded}
        write_recording(self.recording, **content)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = main([str(self.recording), str(self.bag), *options])
        self.assertEqual(code, expected_code, said.getvalue())
        return said.getvalue()

    def messages(self, topic):
        with rosbag.Bag(str(self.bag)) as bag:
            return [message for _, message, _ in bag.read_messages([topic])]


def seconds_of(message):
    return (message.header.stamp.to_nsec() - START) * 1e-9


class Scans(Conversion):
    def test_clockwise_beams_are_in_order_of_time(self):
        self.convert(*EXACT)
        scan = self.messages("/scan")[0]
        self.assertEqual(scan.header.frame_id, "scanner")
        self.assertEqual(list(scan.ranges), [math.inf, 4.0, 2.0, 1.0])
        self.assertAlmostEqual(scan.angle_min, math.pi, places=5)
        self.assertAlmostEqual(scan.angle_increment, -0.5 * math.pi, places=5)
        self.assertAlmostEqual(scan.angle_max, -0.5 * math.pi, places=5)
        self.assertAlmostEqual(scan.time_increment, 0.08 / 3, places=6)

    def test_beams_in_order(self):
        self.convert(*EXACT, "--beams-in-order", "--sweep-time", "0.03")
        scan = self.messages("/scan")[0]
        self.assertEqual(list(scan.ranges), [1.0, 2.0, 4.0, math.inf])
        self.assertAlmostEqual(scan.angle_increment, 0.5 * math.pi, places=5)
        self.assertAlmostEqual(scan.time_increment, 0.01, places=6)

    def test_stamp_is_of_the_first_beam_and_recorded_with_the_last(self):
        self.convert("--scan-delay", "-0.03")
        with rosbag.Bag(str(self.bag)) as bag:
            times = [
                (seconds_of(message), time.to_nsec() - START)
                for _, message, time in bag.read_messages(["/scan"])
            ]
        self.assertEqual(len(times), SCANS)
        for index, (stamp, recorded) in enumerate(times):
            self.assertAlmostEqual(stamp, 0.08 * index - 0.03, places=6)
            self.assertAlmostEqual(recorded * 1e-9, 0.08 * index + 0.05, places=6)

    def test_short_ranges_are_corrected(self):
        self.convert("--range-errors", "1:0.1", "3:0.3", ranges=[0.5, 2.0, 6.0, 0.1, 9.0, math.nan])
        scan = self.messages("/scan")[0]
        expected = [0.6, 2.2, 6.3, math.inf, math.inf, math.inf]
        np.testing.assert_allclose(scan.ranges[::-1], expected, rtol=1e-6)
        self.assertAlmostEqual(scan.range_max, 8.3, places=6)

    def test_mount(self):
        self.convert("--mount", "0.2", "-0.1", "90")
        with rosbag.Bag(str(self.bag)) as bag:
            topic, message, _, header = next(bag.read_messages(return_connection_header=True))
        self.assertEqual((topic, header["latching"]), ("/tf_static", b"1"))
        mount = message.transforms[0]
        self.assertEqual((mount.header.frame_id, mount.child_frame_id), ("base_link", "scanner"))
        pose = mount.transform
        np.testing.assert_allclose([pose.translation.x, pose.translation.y], [0.2, -0.1])
        np.testing.assert_allclose([pose.rotation.z, pose.rotation.w], [math.sqrt(0.5)] * 2)


class Truth(Conversion):
    def test_map_is_the_first_pose_at_a_scan(self):
        self.convert(*EXACT)
        for message in self.messages("/ground_truth/pose"):
            expected = [EGO_SPEED * seconds_of(message), 0.0, 0.0]
            np.testing.assert_allclose(planar(message.pose.pose), expected, atol=1e-6)
            self.assertAlmostEqual(message.twist.twist.linear.x, EGO_SPEED, places=6)

    def test_others_at_the_stamps_of_the_scans(self):
        self.convert(*EXACT, "--object-center", "0.1", "0.02", "180")
        found = self.messages("/ground_truth/objects")
        self.assertEqual(len(found), SCANS)
        for message in found:
            (car,) = message.objects
            x, y, yaw = planar(car.pose)
            np.testing.assert_allclose([x, y], [2.1 + RED_SPEED * seconds_of(message), 0.02])
            self.assertAlmostEqual(abs(yaw), math.pi, places=6)
            np.testing.assert_allclose([car.velocity.x, car.velocity.y], [0.5, 0.0], atol=1e-6)
            self.assertTrue(car.moving)

    def test_slow_objects_are_stationary(self):
        self.convert("--moving-speed", "0.6")
        (car,) = self.messages("/ground_truth/objects")[0].objects
        self.assertFalse(car.moving)
        self.assertEqual(car.velocity.x, 0.0)

    def test_beams_on_the_other_car(self):
        """Its rear side is straight ahead, 1.9 m from the scanner, and 0.1 m from its middle."""
        size = ("--object-size", "0.2", "0.1", "0.1", "--object-center", "0", "0", "0")
        centered = (*EXACT, *size, "--mount", "0", "0", "0")
        self.convert(*centered, ranges=[5.0, 1.9, 5.0, 5.0])
        first = self.messages("/ground_truth/objects")[0].objects[0]
        self.assertEqual((first.lidar_beams, first.visible_to), (1, ["scanner"]))
        self.convert(*centered, ranges=[5.0, 3.0, 5.0, 5.0])
        first = self.messages("/ground_truth/objects")[0].objects[0]
        self.assertEqual((first.lidar_beams, first.visible_to), (0, []))

    def test_either_car_may_be_the_observed_one(self):
        self.convert(*EXACT, "--ego-pose", "/red_pose", "--object-pose", "/ego_pose")
        last = self.messages("/ground_truth/pose")[-1]
        self.assertAlmostEqual(last.twist.twist.linear.x, RED_SPEED, places=6)

    def test_scans_without_capture_have_no_truth(self):
        said = self.convert(*EXACT, red=lambda seconds: red(seconds) if seconds < 0.4 else None)
        self.assertEqual(len(self.messages("/scan")), SCANS)
        stamps = [seconds_of(message) for message in self.messages("/ground_truth/objects")]
        self.assertEqual(len(stamps), 6)
        self.assertIn(f"5 of {SCANS} scans without truth", said)

    def test_repeated_poses_are_ignored(self):
        """Motion capture that has lost the car keeps reporting its last pose."""
        self.convert(*EXACT, ego=lambda seconds: ego(min(seconds, 0.4)))
        stamps = [seconds_of(message) for message in self.messages("/ground_truth/pose")]
        self.assertAlmostEqual(stamps[-1], 0.4, places=6)
        self.assertEqual(len(self.messages("/ground_truth/objects")), 6)
        said = self.convert(*EXACT, ego=lambda _: ego(0.0), expected_code=1)
        self.assertIn("/ego_pose never changes", said)


class Odometry(Conversion):
    WHEELS, YAW_RATE, BIAS = 20.0, 0.4, 0.1  # rad/s

    def rates(self, seconds):
        """Stationary for 0.3 s, then drives in a circle."""
        return (0.0, 0.0) if seconds < 0.295 else (self.WHEELS, self.YAW_RATE)

    def check_twists(self):
        samples = self.messages("/odometry")
        self.assertEqual(len(samples), len(self.messages("/tf")))
        for message in samples:
            wheels, yaw_rate = self.rates(seconds_of(message))
            twist = message.twist.twist
            self.assertAlmostEqual(twist.linear.x, 0.05 * wheels, places=6)
            self.assertAlmostEqual(twist.angular.z, yaw_rate, places=6)
        return samples

    def test_median_of_the_wheels_and_turn_about_the_vertical(self):
        for vertical in ((0.0, 0.0, 1.0), (0.6, 0.0, -0.8)):
            sensors = {"rates": self.rates, "vertical": vertical, "yaw_rate_bias": self.BIAS}
            self.convert("--wheel-radius", "0.05", drive_sensors=sensors)
            samples = self.check_twists()
        x, y, yaw = planar(samples[-1].pose.pose)
        # Rates between two samples are the mean: half a step at the start counts.
        turned = self.YAW_RATE * (seconds_of(samples[-1]) - 0.295)
        radius = 0.05 * self.WHEELS / self.YAW_RATE
        expected = [radius * math.sin(turned), radius * (1.0 - math.cos(turned)), turned]
        np.testing.assert_allclose([x, y, yaw], expected, atol=1e-3)

    def test_without(self):
        self.assertIn("no odometry, which needs /wheel_speeds and /imu/data", self.convert())
        self.assertEqual(self.messages("/odometry"), [])
        self.convert("--no-odometry", drive_sensors={"rates": self.rates})
        self.assertEqual(self.messages("/odometry") + self.messages("/tf"), [])

    def test_topics_of_other_types(self):
        sensors = {"rates": self.rates}
        said = self.convert("--wheel-speeds", "/scan", drive_sensors=sensors, expected_code=1)
        self.assertIn("/scan: expected finite numbers FL, FR, BL, BR", said)
        said = self.convert("--imu", "/scan", drive_sensors=sensors, expected_code=1)
        self.assertIn("expected sensor_msgs/Imu", said)


class Errors(Conversion):
    def test_missing_topics_are_named(self):
        said = self.convert(expected_code=1, topics=("/scan", "/ego_pose"))
        self.assertIn("/red_pose", said)
        self.assertIn("/scan", self.convert(expected_code=1, topics=("/ego_pose", "/red_pose")))
        self.assertFalse(self.bag.exists())

    def test_topic_of_another_type(self):
        self.assertIn(
            "expected sensor_msgs/LaserScan", self.convert("--scan", "/ego_pose", expected_code=1)
        )
        self.assertIn("/scan is", self.convert("--ego-pose", "/scan", expected_code=1))

    def test_options_out_of_range(self):
        for option in (
            ("--sweep-time", "-1"),
            ("--scan-delay", "5"),
            ("--range-errors", "2:0.1", "1:0.1"),
            ("--range-errors", "1:0.5", "1.2:0.1"),
            ("--wheel-radius", "0"),
            ("--object-size", "0", "1", "1"),
            ("--moving-speed", "0"),
        ):
            self.assertIn(option[0], self.convert(*option, expected_code=1))

    def test_no_bag(self):
        self.bag.write_text("no bag")
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(main([str(self.bag), str(self.root / "new.bag")]), 1)
        self.assertIn("is not a bag", said.getvalue())


class Determinism(Conversion):
    def test_same_bytes(self):
        self.convert()
        first = self.bag.read_bytes()
        self.convert()
        self.assertEqual(self.bag.read_bytes(), first)


if __name__ == "__main__":
    unittest.main()
