#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""carmen_to_bag on made-up logs: contents of the bag, both clocks, errors, determinism."""

import contextlib
import io
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag
from datmo_tools.convert import carmen_odometry
from datmo_tools.convert.carmen_clock import rising, typical_steps
from datmo_tools.convert.carmen_to_bag import main
from tiny_log import START, flaser, odom, robot_laser, write_log

ORIGIN = (0.0, 0.0, 0.0)


class Conversion(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.log = self.root / "drive.clf"
        self.bag = self.root / "out.bag"

    def convert(self, *lines, options=(), expected_code=0):
        """Runs the tool without a subprocess; returns its standard error."""
        write_log(self.log, *lines)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = main([str(self.log), str(self.bag), *options])
        self.assertEqual(code, expected_code, said.getvalue())
        return said.getvalue()

    def messages(self, topic):
        with rosbag.Bag(str(self.bag)) as bag:
            return [message for _, message, _ in bag.read_messages([topic])]

    def times(self, topic):
        """Returns stamps in s after START."""
        return [round(m.header.stamp.to_sec() - START, 6) for m in self.messages(topic)]


class Contents(Conversion):
    def test_scan_of_half_a_turn(self):
        for count, step in ((180, 1.0), (181, 1.0), (360, 0.5), (361, 0.5)):
            self.convert(flaser(0, ORIGIN, ranges=[2.0] * count))
            scan = self.messages("/scan")[0]
            self.assertEqual(scan.header.frame_id, "scanner")
            self.assertAlmostEqual(math.degrees(scan.angle_min), -90.0, places=4)
            self.assertAlmostEqual(math.degrees(scan.angle_increment), step, places=5)
            last = -90.0 + (count - 1) * step
            self.assertAlmostEqual(math.degrees(scan.angle_max), last, places=4)
            self.assertEqual(len(scan.ranges), count)

    def test_no_return_is_infinite(self):
        self.convert(flaser(0, ORIGIN, ranges=(1.5, 79.9, 80.0, 81.83, "inf")))
        scan = self.messages("/scan")[0]
        np.testing.assert_allclose(scan.ranges, [1.5, 79.9] + [math.inf] * 3, rtol=1e-6)
        self.assertEqual(scan.range_max, 80.0)
        self.convert(flaser(0, ORIGIN, ranges=(1.5, 8.1)), options=["--range-max", "8"])
        self.assertEqual(self.messages("/scan")[0].ranges[1], math.inf)

    def test_scan_options(self):
        options = ["--field-of-view", "270", "--sweep-time", "0.03"]
        self.convert(flaser(0, ORIGIN, ranges=(1, 2, 3, 4)), options=options)
        scan = self.messages("/scan")[0]
        self.assertAlmostEqual(math.degrees(scan.angle_min), -135.0, places=4)
        self.assertAlmostEqual(math.degrees(scan.angle_increment), 90.0, places=4)
        self.assertAlmostEqual(scan.time_increment, 0.01)

    def test_scanner_of_a_robot_laser(self):
        self.convert(robot_laser(0, ORIGIN, (0.1, 0, 0), (1, 20, 30), range_max=25.0))
        scan = self.messages("/scan")[0]
        self.assertAlmostEqual(scan.angle_min, -0.5)
        self.assertAlmostEqual(scan.angle_increment, 0.01)
        self.assertEqual(scan.range_max, 25.0)
        self.assertEqual(scan.ranges, (1.0, 20.0, math.inf))
        mount = self.messages("/tf_static")[0].transforms[0]
        self.assertAlmostEqual(mount.transform.translation.x, 0.1)

    def test_mount(self):
        self.convert(flaser(0, ORIGIN), options=["--mount", "0.2", "-0.1", "90"])
        with rosbag.Bag(str(self.bag)) as bag:
            topic, message, time, header = next(bag.read_messages(return_connection_header=True))
        mount = message.transforms[0]
        self.assertEqual((topic, header["latching"]), ("/tf_static", b"1"))
        self.assertEqual(header["callerid"], b"/carmen_to_bag")
        self.assertLess(time.to_sec(), START)
        self.assertEqual((mount.header.frame_id, mount.child_frame_id), ("base_link", "scanner"))
        at, turn = mount.transform.translation, mount.transform.rotation
        np.testing.assert_allclose([at.x, at.y, at.z], [0.2, -0.1, 0.0])
        np.testing.assert_allclose([turn.z, turn.w], [math.sqrt(0.5)] * 2)

    def test_odometry_of_scans_and_of_lines_between(self):
        """1 m/s ahead for 0.2 s, then on a circle: 0.1 m and 0.1 rad in 0.2 s."""
        bend = 0.1 * np.sinc(0.05 / math.pi)
        end = (0.2 + bend * math.cos(0.05), bend * math.sin(0.05), 0.1)
        self.convert(
            flaser(0.0, ORIGIN), odom(0.1, (0.1, 0, 0)), flaser(0.2, (0.2, 0, 0)), odom(0.4, end)
        )
        samples = self.messages("/odometry")
        self.assertEqual(self.times("/odometry"), [0.0, 0.1, 0.2, 0.4])
        rates = [(m.twist.twist.linear.x, m.twist.twist.angular.z) for m in samples]
        np.testing.assert_allclose(rates, [(1, 0), (1, 0), (0.5, 0.5), (0.5, 0.5)], atol=1e-9)
        self.assertEqual(
            (samples[0].header.frame_id, samples[0].child_frame_id), ("odom", "base_link")
        )
        self.assertAlmostEqual(samples[3].pose.pose.position.x, end[0])
        variances = [m.pose.covariance[0] for m in samples]
        self.assertTrue(all(a < b for a, b in zip(variances, variances[1:])), variances)
        self.assertTrue(all(m.twist.covariance[0] > 0.0 for m in samples))
        transforms = [m.transforms[0] for m in self.messages("/tf")]
        self.assertEqual(
            [t.transform.translation.x for t in transforms],
            [m.pose.pose.position.x for m in samples],
        )

    def test_odometry_too_near_to_a_scan_is_left_out(self):
        self.convert(
            odom(0.0, ORIGIN),
            odom(0.005, ORIGIN),
            odom(0.1, ORIGIN),
            flaser(0.11, ORIGIN),
            odom(0.12, ORIGIN),
            odom(0.2, ORIGIN),
        )
        self.assertEqual(self.times("/odometry"), [0.0, 0.11, 0.2])

    def test_notes(self):
        said = self.convert(flaser(0, ORIGIN), "TRUEPOS 1 2 3", "SYNC a", "SYNC b", odom(1, ORIGIN))
        self.assertIn("1 scans of FLASER, 1 lines of odometry", said)
        self.assertIn("not used: 2 SYNC, 1 TRUEPOS", said)

    def test_same_bytes(self):
        lines = flaser(0, ORIGIN), flaser(0.2, (0.1, 0, 0.1))
        self.convert(*lines)
        first = self.bag.read_bytes()
        self.convert(*lines)
        self.assertEqual(first, self.bag.read_bytes())


class Clocks(Conversion):
    LINES = [flaser(time, (x, 0, 0)) for time, x in ((0.0, 0), (0.9, 1), (0.4, 2), (0.6, 3))]

    def positions(self):
        return [m.pose.pose.position.x for m in self.messages("/odometry")]

    def test_log(self):
        said = self.convert(*self.LINES, options=["--clock", "log"])
        self.assertEqual(self.times("/scan"), [0.0, 0.4, 0.6, 0.9])
        self.assertEqual(self.positions(), [0.0, 2.0, 3.0, 1.0])
        self.assertEqual(self.messages("/log_stamps"), [])
        self.assertIn(f"{self.log}: 1 of 4 scans, the first in line 3, are stamped no later", said)
        self.assertIn("sorted by stamp", said)

    def test_order(self):
        """Typical is 0.2 s, the least step 0.18 s.

        Beyond the least steps the scans are stamped 0, 0.72, 0.04, 0.06 s: the last three are pooled
        around their mean, 0.273333 s.
        """
        said = self.convert(*self.LINES)
        self.assertEqual(self.positions(), [0.0, 1.0, 2.0, 3.0])
        np.testing.assert_allclose(
            self.times("/scan"), [0.0, 0.453333, 0.633333, 0.813333], atol=2e-6
        )
        logged = [round(m.time_ref.to_sec() - START, 6) for m in self.messages("/log_stamps")]
        self.assertEqual(logged, [0.0, 0.9, 0.4, 0.6])
        self.assertIn("their stamps were moved", said)

    def test_increasing_stamps_are_the_same_with_both(self):
        lines = [flaser(0.2 * i, (0.1 * i, 0, 0)) for i in range(30)]
        self.convert(*lines)
        stamps = self.times("/scan")
        self.assertEqual(self.messages("/log_stamps"), [])
        self.convert(*lines, options=["--clock", "order"])
        self.assertEqual(self.times("/scan"), stamps)

    def test_repeated_stamp(self):
        lines = flaser(0.0, ORIGIN), flaser(0.5, ORIGIN), flaser(0.5, (1, 0, 0)), flaser(1, ORIGIN)
        said = self.convert(*lines, options=["--clock", "log"])
        self.assertIn("1 with a repeated stamp skipped", said)
        self.assertEqual(self.times("/scan"), [0.0, 0.5, 1.0])
        self.convert(*lines, options=["--clock", "order"])
        self.assertEqual(len(self.times("/scan")), 4)

    def test_rising(self):
        self.assertEqual(rising([5, 20, 35], [10, 10]), [5, 20, 35])
        self.assertEqual(rising([0, 100, 50, 200], [10, 10, 10]), [0, 70, 80, 200])
        self.assertEqual(rising([0, 10, 20], [5, 20]), [0, 5, 25])
        generator = np.random.Generator(np.random.PCG64(1))
        stamps = [int(s) for s in 1000 * np.arange(500) + generator.normal(0, 2000, 500)]
        moved = rising(stamps, [300] * 499)
        self.assertGreaterEqual(min(np.diff(moved)), 299)  # rounded
        # No feasible neighbor is nearer: the residuals of each run of moved stamps cancel.
        self.assertAlmostEqual(float(np.mean(np.subtract(moved, stamps))), 0.0, delta=1.0)

    def test_typical_steps_tolerate_bursts_and_pauses(self):
        even = [200 * i for i in range(100)]
        self.assertEqual(set(typical_steps(even)), {200})
        self.assertEqual(set(typical_steps(even + [10**6 + s for s in even])), {200})
        bursts = [s + (150 if i % 2 else 0) for i, s in enumerate(even)]
        self.assertEqual(set(typical_steps(bursts)), {200})
        self.assertEqual(typical_steps([0, 60]), [60])

    def test_typical_steps_follow_the_rate(self):
        slow = [200 * i for i in range(500)]
        steps = typical_steps(slow + [slow[-1] + 100 * i for i in range(1, 501)])
        self.assertEqual((steps[0], steps[-1], len(steps)), (200, 100, 999))

    def test_rates_tolerate_nearly_equal_stamps(self):
        """0.2 m/s throughout, though two stamps are 1 ms apart: 20 m/s between them."""
        stamps = [0, 200_000_000, 201_000_000, 400_000_000]
        poses = [np.array([x, 0.0, 0.0]) for x in (0.0, 0.04, 0.06, 0.08)]
        speeds = [sample.speed for sample in carmen_odometry.samples(stamps, poses)]
        self.assertLess(max(speeds), 0.31)


class Errors(Conversion):
    def assert_refused(self, *lines, text, options=()):
        """Expects exit code 1, the text in the message, and no bag left behind."""
        self.assertIn(text, self.convert(*lines, options=options, expected_code=1))
        self.assertEqual([path.name for path in self.root.iterdir()], ["drive.clf"])

    def test_malformed_line(self):
        self.assert_refused(flaser(0, ORIGIN), "ODOM 1", text=f"{self.log}:2: ODOM with 1 fields")
        said = self.convert(flaser(0, ORIGIN), "ODOM 1", options=["--skip-malformed"])
        self.assertIn(f"1 malformed lines skipped, the first: {self.log}:2", said)

    def test_options(self):
        good = flaser(0, ORIGIN)
        for option, value in (
            ("--field-of-view", "0"),
            ("--field-of-view", "361"),
            ("--range-max", "0"),
            ("--sweep-time", "-1"),
        ):
            self.assert_refused(good, text=f"{option} is", options=[option, value])

    def test_log_is_not_overwritten(self):
        text = flaser(0, ORIGIN)
        self.bag = self.root / "." / "drive.clf"
        self.assert_refused(text, text="the bag must not be the log")
        self.assertEqual(self.log.read_text(), text + "\n")

    def test_bag_that_cannot_be_written(self):
        self.bag = self.root / "no" / "out.bag"
        self.assert_refused(flaser(0, ORIGIN), text="cannot be written")


if __name__ == "__main__":
    unittest.main()
