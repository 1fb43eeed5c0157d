#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reading CARMEN logs: what the lines say, which are left out, what is refused."""

import bz2
import gzip
import tempfile
import unittest
from pathlib import Path

import numpy as np
from datmo_tools.convert.carmen_lines import parse_line
from datmo_tools.convert.carmen_log import out_of_order, read_log, scans_of
from datmo_tools.convert.carmen_mount import scanner_mount
from datmo_tools.errors import InputError
from tiny_log import flaser, odom, robot_laser, write_log

ORIGIN = (0.0, 0.0, 0.0)


class Lines(unittest.TestCase):
    def parse(self, line):
        return parse_line(line.split())

    def assert_refused(self, line, text):
        with self.assertRaises(ValueError) as caught:
            self.parse(line)
        self.assertIn(text, str(caught.exception))

    def test_front_laser(self):
        line = self.parse(flaser(0.25, robot=(1, 2, 0.5), laser=(3, 4, 0.75), ranges=(5, 81.83)))
        self.assertEqual(line.stamp, 1000_250_000_000)
        self.assertEqual(line.ranges.tolist(), [5.0, 81.83])
        self.assertEqual(line.laser_pose.tolist(), [3.0, 4.0, 0.75])
        self.assertEqual(line.robot_pose.tolist(), [1.0, 2.0, 0.5])
        self.assertTrue(np.isnan(line.step))

    def test_stamps_are_exact(self):
        line = flaser(0, ORIGIN).replace("1000.000000", "976052905.167303")
        self.assertEqual(self.parse(line).stamp, 976052905_167303000)

    def test_robot_laser_without_remissions(self):
        """As CARMEN's first releases logged it, after the header of their files."""
        head, readings = "ROBOTLASER1 0 -0.5 0.03 0.01 50 0.01 0", "3 7 8 9"
        poses, speeds, tail = "1 2 0.1 4 5 0.2", "0.1 0.2 1 2", "1001.5 host 1.5"
        line = self.parse(" ".join((head, readings, poses, speeds, tail)))
        np.testing.assert_array_equal(line.ranges, [7, 8, 9])
        np.testing.assert_array_equal(line.laser_pose, [1, 2, 0.1])
        np.testing.assert_array_equal(line.robot_pose, [4, 5, 0.2])
        self.assertEqual(line.stamp, 1001_500_000_000)

    def test_robot_laser(self):
        line = self.parse(
            robot_laser(1.0, (1, 2, 3), (4, 5, 6), (7, 8), remissions=(9, 9, 9), range_max=20.0)
        )
        self.assertEqual((line.first_bearing, line.step, line.range_max), (-0.5, 0.01, 20.0))
        self.assertEqual(line.ranges.tolist(), [7.0, 8.0])
        self.assertEqual(line.robot_pose.tolist(), [1.0, 2.0, 3.0])
        self.assertEqual(line.laser_pose.tolist(), [4.0, 5.0, 6.0])
        self.assertEqual(line.stamp, 1001_000_000_000)

    def test_odometry_and_parameters(self):
        line = self.parse(odom(2.0, (1, 2, 3)))
        self.assertEqual((line.stamp, line.pose.tolist()), (1002_000_000_000, [1.0, 2.0, 3.0]))
        line = self.parse("PARAM robot_frontlaser_offset 0.3 host 0")
        self.assertEqual(line, ("robot_frontlaser_offset", "0.3"))

    def test_other_kinds(self):
        for kind in ("SYNC", "TRUEPOS", "RAWLASER1", "NMEA-GGA", "GPSGGA", "ROBOTLASER5"):
            self.assertIsNone(self.parse(f"{kind} tag 1 host 0"), kind)
        self.assert_refused("WHATSIT 1 2 3", "WHATSIT is not a kind of line of a CARMEN log")

    def test_no_return_may_be_infinite(self):
        self.assertEqual(self.parse(flaser(0, ORIGIN, ranges=(1, "inf"))).ranges[1], np.inf)

    def test_malformed(self):
        good = flaser(0, ORIGIN)
        self.assert_refused(good.replace("FLASER 4", "FLASER 40"), "expected 41 or more")
        self.assert_refused(good.replace("FLASER 4", "FLASER 4.5"), "'4.5'")
        self.assert_refused(good.replace("FLASER 4", "FLASER 999999999"), "'999999999'")
        self.assert_refused(good.replace("2.0", "nan"), "a reading is nan")
        self.assert_refused(good.replace("2.0", "-2.0"), "a reading is -2.0")
        self.assert_refused(good.replace("2.0", "2.0.0"), "readings")
        self.assert_refused(flaser(0, (0.0, "nan", 0.0), ORIGIN), "the robot's pose: nan")
        self.assert_refused(flaser(0, ORIGIN, (0.0, "inf", 0.0)), "the laser's pose: inf")
        self.assert_refused(good.replace("1000.000000", "never"), "'never' is not a number")
        self.assert_refused(good.replace("1000.000000", "nan"), "nan")
        self.assert_refused(good.replace("1000.000000", "-1"), "-1 s is not a time")
        self.assert_refused(flaser(0, ORIGIN, ranges=(1.0,)), "1 readings, expected two or more")
        self.assert_refused("FLASER", "FLASER with 0 fields")
        self.assert_refused("ODOM 1 2 3 0 0", "ODOM with 5 fields")
        self.assert_refused("PARAM lonely", "a value")
        robot = robot_laser(0, ORIGIN, ORIGIN, (1, 2))
        self.assert_refused(robot_laser(0, ORIGIN, ORIGIN, (1, 2), step=7.0), "within one turn")
        self.assert_refused(robot_laser(0, ORIGIN, ORIGIN, (1, 2), step=0.0), "within one turn")
        self.assert_refused(robot_laser(0, ORIGIN, ORIGIN, (1, 2), range_max=0.0), "maximum range")
        self.assert_refused(" ".join(robot.split()[:-8]), "ends before")


class Logs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "drive.clf"

    def read(self, *lines, **options):
        return read_log(write_log(self.path, *lines), **options)

    def assert_refused(self, *lines, texts, **options):
        with self.assertRaises(InputError) as caught:
            self.read(*lines, **options)
        for text in texts:
            self.assertIn(text, str(caught.exception))

    def test_records_in_the_order_of_the_file(self):
        log = self.read(
            "# a comment", "", odom(0.3, ORIGIN), flaser(0.2, ORIGIN), odom(0.1, ORIGIN)
        )
        self.assertEqual([record.number for record in log.records], [3, 4, 5])
        self.assertEqual([record.number for record in scans_of(log)], [4])
        self.assertEqual((log.skipped, log.malformed), ({}, []))

    def test_unused_records_are_counted(self):
        log = self.read(
            flaser(0, ORIGIN),
            flaser(0, ORIGIN, kind="RLASER"),
            "SYNC a",
            "SYNC b",
            "PARAM robot_frontlaser_offset 0.5",
        )
        self.assertEqual(log.laser, "FLASER")
        self.assertEqual(log.skipped, {"RLASER": 1, "SYNC": 2})
        self.assertEqual(log.parameters, {"robot_frontlaser_offset": "0.5"})

    def test_chosen_laser(self):
        lines = flaser(0, ORIGIN), flaser(0, ORIGIN, kind="RLASER")
        log = self.read(*lines, laser="RLASER")
        self.assertEqual(([record.number for record in log.records], log.laser), ([2], "RLASER"))
        self.assert_refused(*lines, laser="ROBOTLASER1", texts=["no line of ROBOTLASER1", "RLASER"])

    def test_packed_logs(self):
        text = flaser(0, ORIGIN).encode()
        for suffix, pack in ((".bz2", bz2.compress), (".gz", gzip.compress)):
            path = self.path.with_suffix(suffix)
            path.write_bytes(pack(text))
            self.assertEqual(len(read_log(path).records), 1)
            path.write_bytes(pack(text)[:-8])
            with self.assertRaisesRegex(InputError, f"drive{suffix}: expected a CARMEN log"):
                read_log(path)

    def test_broken_archive(self):
        path = self.path.with_suffix(".gz")
        packed = bytearray(gzip.compress(flaser(0, ORIGIN).encode()))
        packed[10] = 0b111  # behind the header: a last block, of the reserved type
        path.write_bytes(packed)
        with self.assertRaisesRegex(InputError, "drive.gz: expected a CARMEN log .*block type"):
            read_log(path)

    def test_not_a_log(self):
        self.path.write_bytes(bytes(range(1, 256)) * 100)
        with self.assertRaises(InputError) as caught:
            read_log(self.path)
        message = str(caught.exception)
        self.assertIn(f"{self.path}:1: ", message)
        self.assertIn("is not a kind of line of a CARMEN log", message)
        self.assertTrue(message.isascii() and message.isprintable())
        self.assertLess(len(message) - len(str(self.path)), 300)

    def test_malformed_lines_stop_or_are_left_out(self):
        lines = flaser(0, ORIGIN), "ODOM 1 2", flaser(1, ORIGIN), "ODOM"
        self.assert_refused(
            *lines, texts=[f"{self.path}:2: ODOM with 2 fields", "--skip-malformed"]
        )
        log = self.read(*lines, skip_malformed=True)
        self.assertEqual(len(log.records), 2)
        self.assertEqual(len(log.malformed), 2)
        self.assertIn(f"{self.path}:2", log.malformed[0])

    def test_files_without_a_scan(self):
        self.assert_refused(
            odom(0, ORIGIN), texts=[f"{self.path}: no line of FLASER", "holds ODOM"]
        )
        self.assert_refused(texts=["it holds nothing"])
        with self.assertRaisesRegex(InputError, "expected a CARMEN log"):
            read_log(self.path.with_name("nowhere"))

    def test_stamps_that_are_mixed_up(self):
        log = self.read(*(flaser(time, ORIGIN) for time in (1.0, 2.0, 1.5, 1.5, 3.0)))
        self.assertEqual([record.number for record in out_of_order(scans_of(log))], [3, 4])

    def test_clock_that_is_set_back(self):
        self.assert_refused(
            flaser(20, ORIGIN),
            flaser(9, ORIGIN),
            texts=[f"{self.path}:2: FLASER is stamped 11.000 s before", "expected increasing"],
        )


class Mounts(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "drive.clf"

    def mount(self, *lines, laser=None):
        log = read_log(write_log(self.path, *lines), laser)
        pose, note = scanner_mount(self.path, log, [record.line for record in scans_of(log)])
        return pose, note

    def test_laser_beside_the_robot(self):
        """The robot looks along y: 0.2 m ahead of it is further along y."""
        lines = [
            flaser(0, (1, 1, np.pi / 2), (1, 1.2, np.pi / 2 + 0.1)),
            flaser(1, (2, 1, 0), (2.2, 1, 0.1)),
        ]
        pose, note = self.mount(*lines)
        np.testing.assert_allclose(pose, [0.2, 0.0, 0.1], atol=1e-12)
        self.assertIsNone(note)
        pose, _ = self.mount("PARAM robot_frontlaser_offset 0.9", *lines)
        np.testing.assert_allclose(pose, [0.2, 0.0, 0.1], atol=1e-12)

    def test_setting_of_lines_without_one(self):
        lines = (
            "PARAM robot_frontlaser_offset 0.3",
            "PARAM robot_frontlaser_side_offset -0.1",
            flaser(0, ORIGIN),
        )
        pose, note = self.mount(*lines)
        np.testing.assert_allclose(pose, [0.3, -0.1, 0.0])
        self.assertEqual(note, "mount from robot_frontlaser_offset")

    def test_corrected_poses_are_no_mount(self):
        lines = flaser(0, ORIGIN), flaser(1, (1, 0, 0), (1.5, 0, 0))
        pose, note = self.mount("PARAM robot_frontlaser_offset 0.3", *lines)
        np.testing.assert_allclose(pose, [0.3, 0.0, 0.0])
        self.assertIn("not those of a fixed mount", note)
        with self.assertRaisesRegex(InputError, r"on the robot varies by 0.50 m.*expected --mount"):
            self.mount(*lines)

    def test_non_numeric_setting(self):
        with self.assertRaisesRegex(InputError, "could not convert"):
            self.mount("PARAM robot_frontlaser_offset off", flaser(0, ORIGIN))
        with self.assertRaisesRegex(InputError, "expected finite numbers"):
            self.mount("PARAM robot_frontlaser_offset nan", flaser(0, ORIGIN))

    def test_setting_of_the_front_laser_does_not_apply_to_the_rear_one(self):
        rear = flaser(0, ORIGIN, (-0.3, 0, np.pi), kind="RLASER")
        pose, _ = self.mount("PARAM robot_frontlaser_offset 0.5", rear)
        np.testing.assert_allclose(np.abs(pose), [0.3, 0.0, np.pi], atol=1e-12)


if __name__ == "__main__":
    unittest.main()
