#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate slam on paths and relations that are worked out by hand."""

import contextlib
import io
import json
import math
import unittest

import numpy as np
import rosbag
from datmo_tools import bag_messages
from datmo_tools.convert import carmen_to_bag
from datmo_tools.errors import InputError
from datmo_tools.pose_path import PosePath
from datmo_tools.evaluate.relations import Relation, errors_of, read_relations, statistics
from datmo_tools.evaluate.slam import score
from datmo_tools.stamps import to_ros_time
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovarianceStamped, Quaternion
from tiny_log import START, flaser, write_log
from evaluate_case import EvaluateCase

SECOND = 10**9
FAR = 10 * SECOND


def ns(time):
    """Returns the stamp (ns) of `time` (s after START)."""
    return round((START + time) * SECOND)


def relation(begin, end, x, y, yaw):
    """Returns a relation between two times (s after START)."""
    return Relation(ns(begin), ns(end), np.array([x, y, yaw]))


class Metric(unittest.TestCase):
    def errors(self, poses, *relations, times=None, tolerance=FAR):
        stamps = [ns(time) for time in (times or range(len(poses)))]
        return errors_of(PosePath(stamps, poses), relations, tolerance)

    def test_perfect_path_has_no_error_wherever_its_origin_is(self):
        poses = [(5, 5, math.pi / 2), (5, 7, math.pi)]
        errors = self.errors(poses, relation(0, 1, 2, 0, math.pi / 2))
        np.testing.assert_allclose([errors.translation, errors.rotation], 0.0, atol=1e-9)

    def test_errors_by_hand(self):
        """2.3 m instead of 2 m ahead, 0.4 m to the left, 0.1 rad turned too far."""
        errors = self.errors([(0, 0, 0), (2.3, 0.4, 0.6)], relation(0, 1, 2, 0, 0.5))
        self.assertAlmostEqual(errors.translation[0], 0.5)
        self.assertAlmostEqual(errors.rotation[0], 0.1)

    def test_rotation_across_half_a_turn(self):
        errors = self.errors([(0, 0, 0), (0, 0, 3.1)], relation(0, 1, 0, 0, -3.1))
        self.assertAlmostEqual(errors.rotation[0], 2 * math.pi - 6.2)

    def test_backward_in_time(self):
        poses = [(0, 0, 0), (1, 0, math.pi / 2)]
        errors = self.errors(poses, relation(1, 0, 0, 1, -math.pi / 2))
        np.testing.assert_allclose([errors.translation, errors.rotation], 0.0, atol=1e-9)

    def test_poses_are_interpolated(self):
        errors = self.errors([(0, 0, 0), (4, 0, 0)], relation(0.25, 0.75, 2, 0, 0))
        self.assertAlmostEqual(errors.translation[0], 0.0)

    def test_uncovered_relations(self):
        poses = [(0, 0, 0), (1, 0, 0), (2, 0, 0)]
        wanted = relation(0, 1, 1, 0, 0), relation(1, 2.4, 1, 0, 0), relation(-1, 0, 1, 0, 0)
        errors = self.errors(poses, *wanted, tolerance=SECOND // 2)
        self.assertEqual((len(errors.translation), errors.not_covered), (2, 1))
        errors = self.errors(poses, *wanted, tolerance=0)
        self.assertEqual((len(errors.translation), errors.not_covered), (1, 2))

    def test_a_gap_is_not_covered(self):
        poses, times = [(0, 0, 0), (1, 0, 0)], [0, 10]
        errors = self.errors(poses, relation(0, 5, 1, 0, 0), times=times, tolerance=SECOND)
        self.assertEqual(errors.not_covered, 1)

    def test_statistics(self):
        figures = statistics(np.array([1.0, 3.0]))
        self.assertEqual(figures, (2.0, 1.0, 3.0))  # divided by two, not by one


class Files(EvaluateCase):
    def setUp(self):
        super().setUp()
        self.relations = self.folder / "drive.relations"
        self.bag = self.folder / "poses.bag"

    def write_relations(self, *lines):
        self.relations.write_text("".join(line + "\n" for line in lines))

    def write_bag(self, topic, *messages):
        with rosbag.Bag(str(self.bag), "w") as bag:
            for message in messages:
                bag.write(topic, message, message.header.stamp)

    def run_tool(self, *options, expected_code=0):
        """Returns the tool's standard output and error."""
        return self.evaluate("slam", self.bag, self.relations, *options, code=expected_code)[:2]


def pose(time, x, yaw=0.0):
    """Returns a PoseWithCovarianceStamped at `time` (s after START)."""
    message = PoseWithCovarianceStamped(header=bag_messages.header(ns(time), "map"))
    message.pose.pose.position = Point(x, 0.0, 0.0)
    message.pose.pose.orientation = Quaternion(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
    return message


class Reading(Files):
    def test_comments(self):
        """The published files have no comments; people who edit them add some."""
        self.write_relations("# places", "1 2 1 0 0 0 0 0 # the corner", "  # and", "", "2 3 1 0 0 0 0 0")
        self.assertEqual([found.begin for found in read_relations(self.relations)],
                         [1_000_000_000, 2_000_000_000])  # fmt: skip

    def assert_refused(self, *lines, text):
        self.write_relations(*lines)
        with self.assertRaises(InputError) as caught:
            read_relations(self.relations)
        self.assertIn(text, str(caught.exception))

    def test_fields(self):
        self.write_relations("", "976052905.167303 976052911.885496 -0.05 -0.12 9 8 7 -1.68")
        (found,) = read_relations(self.relations)
        self.assertEqual((found.begin, found.end), (976052905_167303000, 976052911_885496000))
        self.assertEqual(found.motion.tolist(), [-0.05, -0.12, -1.68])

    def test_refused(self):
        self.assert_refused(text="no relation in it")
        good = "1 2 0 0 0 0 0 0"
        self.assert_refused(good, "1 2 3", text=f"{self.relations}:2: 3 fields, expected 8")
        self.assert_refused("1 2 a 0 0 0 0 0", text=f"{self.relations}:1: ")
        self.assert_refused("1 2 nan 0 0 0 0 0", text="not finite")
        self.assert_refused("now 2 0 0 0 0 0 0", text="'now' is not a number of seconds")
        self.relations.unlink()
        with self.assertRaisesRegex(InputError, "expected a relations file"):
            read_relations(self.relations)


class Tool(Files):
    def test_table_and_json(self):
        self.write_bag("/pose", pose(0, 0.0), pose(1, 1.0), pose(2, 2.5, yaw=math.radians(2)))
        self.write_relations("1000 1001 1 0 0 0 0 0", "1001 1002 1 0 0 0 0 0", "1 2 0 0 0 0 0 0")
        report = self.folder / "slam.json"
        out, errors = self.run_tool()
        self.assertIn("1 of 3 relations are not covered", errors)
        self.assertIn("2 relations used, 1 not covered", out)
        figures = json.loads(report.read_text())
        self.assertEqual((figures["used"], figures["not_covered"]), (2, 1))
        for key, mean, maximum in (
            ("translation_m", 0.25, 0.5),
            ("rotation_deg", 1.0, 2.0),
            ("squared_translation_m2", 0.125, 0.25),
            ("squared_rotation_deg2", 2.0, 4.0),
        ):
            self.assertAlmostEqual(figures[key]["mean"], mean)
            self.assertAlmostEqual(figures[key]["max"], maximum)

    def test_types_with_a_pose(self):
        self.write_relations("1000 1001 1 0 0 0 0 0")
        stamped = [
            PoseStamped(header=message.header, pose=message.pose.pose)
            for message in (pose(0, 0.0), pose(1, 1.0))
        ]
        self.write_bag("/somewhere", *stamped)
        self.assertEqual(score(self.bag, self.relations, "/somewhere")["translation_m"]["max"], 0.0)

    def test_errors(self):
        self.write_bag("/pose", pose(0, 0.0), pose(1, 1.0))
        self.write_relations("1 2 0 0 0 0 0 0")
        for options, text in (
            ([], "none of 1 relations lies in the time of /pose"),
            (["--topic", "/map"], "0 poses on /map, expected two or more"),
            (["--tolerance", "-1"], "--tolerance is -1"),
        ):
            self.assertIn(text, self.run_tool(*options, expected_code=1)[1])
        self.bag.write_text("no bag")
        self.assertIn("is not a bag", self.run_tool(expected_code=1)[1])
        self.bag.unlink()
        self.assertIn("no such file", self.run_tool(expected_code=1)[1])

    def test_nan_pose(self):
        self.write_bag("/pose", pose(0, 0.0), pose(1, math.nan), pose(2, 1.0))
        self.write_relations("1000 1002 1 0 0 0 0 0")
        report = self.folder / "slam.json"
        out, errors = self.run_tool(expected_code=1)
        self.assertIn(f"{self.bag}: /pose at 1001.000000 s", errors)
        self.assertEqual(out, "")
        self.assertFalse(report.exists())

    def test_topic_without_poses(self):
        write_log(self.folder / "drive.clf", *(flaser(time, (0.0, 0.0, 0.0)) for time in (0, 1)))
        self.convert("log")
        self.write_relations("1000 1001 1 0 0 0 0 0")
        said = self.run_tool("--topic", "/scan", expected_code=1)[1]
        self.assertIn("/scan is sensor_msgs/LaserScan, expected one of", said)

    def test_moved_stamps(self):
        """The scan at 0.9 s was taken before those at 0.4 and 0.6 s: relations know that."""
        positions = (0.0, 0.0), (0.9, 1.0), (0.4, 2.0), (0.6, 3.0)
        lines = [flaser(time, (x, 0.0, 0.0)) for time, x in positions]
        write_log(self.folder / "drive.clf", *lines)
        self.write_relations("1000 1000.9 1 0 0 0 0 0", "1000.9 1000.6 2 0 0 0 0 0")
        for clock in ("log", "order"):
            self.convert(clock)
            figures = score(self.bag, self.relations, "/odometry", tolerance=0.0)
            self.assertEqual((figures["used"], figures["not_covered"]), (2, 0), clock)
            self.assertAlmostEqual(figures["translation_m"]["max"], 0.0)

    def test_recording_of_another_drive(self):
        lines = [flaser(time, (0.0, 0.0, 0.0)) for time in (0, 1)]
        write_log(self.folder / "drive.clf", *lines)
        self.convert("order")
        other = self.folder / "other.bag"
        with rosbag.Bag(str(other), "w") as bag:
            for message in (pose(50, 0.0), pose(51, 0.0)):
                bag.write("/pose", message, to_ros_time(ns(0)))
        self.write_relations("1000 1001 1 0 0 0 0 0")
        with self.assertRaisesRegex(InputError, "has 0 of the poses' stamps"):
            score(other, self.relations, recording=self.bag)

    def convert(self, clock):
        with contextlib.redirect_stderr(io.StringIO()):
            arguments = [str(self.folder / "drive.clf"), str(self.bag), "--clock", clock]
            self.assertEqual(carmen_to_bag.main(arguments), 0)


if __name__ == "__main__":
    unittest.main()
