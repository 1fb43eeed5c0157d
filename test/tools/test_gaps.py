#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The sweep of gaps: what it removes from a drive, and its score, worked out by hand, with a
stand-in for run_bag."""

import contextlib
import io
import json
import math
import tempfile
import unittest
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from datmo_tools.experiments.gap_score import Gap, passed, score, table
from datmo_tools.experiments.gaps import cut, main

START = 1000  # s
SPEED = 5.0  # m/s, along x


def pose_at(seconds, message, error=0.0, turn=0.0):
    """Returns `message` filled with the pose at a time,
    `error` (m) to the left and `turn` (rad) off."""
    message.header.stamp = rospy.Time.from_sec(START + seconds)
    pose = message.pose.pose if hasattr(message.pose, "pose") else message.pose
    pose.position.x, pose.position.y = SPEED * seconds, error
    pose.orientation.z, pose.orientation.w = math.sin(turn / 2.0), math.cos(turn / 2.0)
    return message


def estimate_at(seconds, error, turn, sigma):
    message = pose_at(seconds, PoseWithCovarianceStamped(), error, turn)
    message.pose.covariance = [sigma**2 if i % 7 == 0 else 0.0 for i in range(36)]
    return message


class Gaps(unittest.TestCase):
    """A straight drive of 40 s, with ten messages a second."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.drive = self.folder / "drive.bag"
        with rosbag.Bag(str(self.drive), "w") as bag:
            bag.write("/tf_static", String("mounts"), rospy.Time.from_sec(START))
            for i in range(400):
                truth = pose_at(0.1 * i, PoseStamped())
                bag.write("/ground_truth/pose", truth, truth.header.stamp)
                for topic in ("/scan", "/odometry", "/tf", "/other"):
                    bag.write(topic, String(topic), truth.header.stamp)

    def counts(self, kind):
        written = self.folder / "cut.bag"
        cut(self.drive, Gap(kind, (START + 20) * 10**9, 2.0), written)
        with rosbag.Bag(str(written)) as bag:
            topics = bag.get_type_and_topic_info().topics
            return {topic: info.message_count for topic, info in topics.items()}

    def test_messages_removed_by_a_gap(self):
        # 12 s before, 2 s, 6 s after: 201 messages, of which the 20 after the start of the gap are
        # removed.
        whole, holed = 201, 181
        self.assertEqual(self.counts("scan"), {"/tf_static": 1, "/ground_truth/pose": whole,
                                               "/scan": holed, "/odometry": whole, "/tf": whole})
        self.assertEqual(self.counts("odometry")["/scan"], whole)
        self.assertEqual(self.counts("odometry")["/tf"], holed)
        both = self.counts("both")
        self.assertEqual((both["/scan"], both["/odometry"], both["/tf"]), (holed, holed, holed))

    def test_carried_elsewhere(self):
        source, written = self.folder / "moving.bag", self.folder / "carried.bag"
        with rosbag.Bag(str(source), "w") as bag:
            for i in range(400):
                odometry = pose_at(0.1 * i, Odometry())
                moved = TransformStamped(header=odometry.header)
                moved.transform.translation.x = SPEED * 0.1 * i
                moved.transform.rotation.w = 1.0
                for topic, message in (("/odometry", odometry), ("/tf", TFMessage([moved])),
                                       ("/ground_truth/pose", pose_at(0.1 * i, PoseStamped()))):
                    bag.write(topic, message, odometry.header.stamp)
        cut(source, Gap("carried", (START + 20) * 10**9, 2.0), written)
        positions = {"/odometry": [], "/tf": [], "/ground_truth/pose": []}
        stamps = []
        with rosbag.Bag(str(written)) as bag:
            for topic, message, at in bag.read_messages():
                stamped = message.transforms[0] if topic == "/tf" else message
                self.assertEqual(stamped.header.stamp, at)
                stamps.append(at.to_sec())
                if topic == "/tf":
                    positions[topic].append(stamped.transform.translation.x)
                else:
                    pose = message.pose.pose if topic == "/odometry" else message.pose
                    positions[topic].append(pose.position.x)
        # From 8 to 20 s, and from 22.1 to 28 s, immediately after.
        self.assertEqual((len(stamps), stamps[0], stamps[-1]), (543, START + 8.0, START + 26.0))
        for topic in ("/odometry", "/tf"):
            steps = [b - a for a, b in zip(positions[topic], positions[topic][1:])]
            self.assertAlmostEqual(steps[120], 0.0, places=6)
            self.assertAlmostEqual(max(steps), 0.5, places=6)
        self.assertAlmostEqual(positions["/ground_truth/pose"][121], 110.5, places=6)

    def scored(self, error, turn, sigma, kind="both"):
        """After a gap of 2 s from 20 s on the pose is off."""
        computed = self.folder / "computed.bag"
        with rosbag.Bag(str(computed), "w") as bag:
            for tenths in (*range(100, 201), *range(221, 281)):
                off = tenths > 200
                pose = estimate_at(0.1 * tenths, error * off, turn * off, sigma)
                bag.write("/pose/local", pose, pose.header.stamp)
        return score(computed, self.drive, Gap(kind, (START + 20) * 10**9, 2.0))

    def test_within_the_limits(self):
        result = self.scored(0.6, math.radians(1.0), 0.01)  # at 10.5 m: 0.605 m
        self.assertTrue(passed(result))
        self.assertAlmostEqual(result["end"]["position_m"], 0.6, places=6)
        self.assertAlmostEqual(result["end"]["distance_m"], 40.0, places=6)
        self.assertAlmostEqual(result["speed_mps"], SPEED, places=6)

    def test_a_wrong_pose_that_is_overconfident(self):
        result = self.scored(2.0, 0.0, 0.5)
        self.assertEqual(result["confident_wrong"], 60)
        self.assertFalse(passed(result))

    def test_a_wrong_pose_with_large_covariance_is_off_but_not_confident(self):
        result = self.scored(2.0, 0.0, 1.0)
        self.assertEqual(result["confident_wrong"], 0)
        self.assertTrue(result["end"]["beyond"] and result["end"]["admitted"])
        self.assertFalse(passed(result))

    def test_carried_elsewhere_it_may_be_anywhere_if_uncertain(self):
        self.assertTrue(passed(self.scored(2.0, 0.0, 1.0, "carried")))
        self.assertFalse(passed(self.scored(2.0, 0.0, 0.5, "carried")))

    def test_a_wrong_heading_alone_counts(self):
        self.assertEqual(self.scored(0.0, math.radians(10.0), 0.01)["confident_wrong"], 60)
        self.assertEqual(self.scored(0.0, math.radians(10.0), 0.1)["confident_wrong"], 0)

    def test_no_pose_at_all_after_the_gap_is_a_failure(self):
        computed = self.folder / "computed.bag"
        with rosbag.Bag(str(computed), "w") as bag:
            for seconds in (19.0, 20.0):
                pose = estimate_at(seconds, 0.0, 0.0, 0.1)
                bag.write("/pose/local", pose, pose.header.stamp)
        result = score(computed, self.drive, Gap("scan", (START + 20) * 10**9, 2.0))
        self.assertFalse(passed(result))
        run = {"kind": "scan", "seconds": 2.0, "score": result}
        self.assertEqual(table([run]).splitlines()[1].split()[:4], ["scan", "2", "1", "1"])

    def sweep(self, *words):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            code = main([str(self.drive), "--config", str(self.folder / "config.yaml"),
                         "--programs", str(self.folder), "--out", str(self.folder / "out.json"),
                         "--seconds", "1", "--every", "10", "--first", "15", *words])  # fmt: skip
        return code, out.getvalue()

    def test_command_line(self):
        result = self.folder / "result.bag"
        (self.folder / "config.yaml").touch()
        for name, text in (("simulate", "exit 1"), ("run_bag", f'cp {result} "$2"')):
            program = self.folder / name
            program.write_text(f"#!/bin/sh\n{text}\n")
            program.chmod(0o755)
        for error, expected in ((0.0, 0), (3.0, 1)):
            with rosbag.Bag(str(result), "w") as bag:
                for tenths in range(400):
                    pose = estimate_at(0.1 * tenths, error * (tenths > 150), 0.0, 0.1)
                    bag.write("/pose/local", pose, pose.header.stamp)
            code, out = self.sweep("--kinds", "scan", "both")
            self.assertEqual(code, expected)
            runs = json.loads((self.folder / "out.json").read_text())["runs"]
            # From 15 and 25 s on, and not so late that nothing follows.
            self.assertEqual([(run["kind"], run["begin_s"]) for run in runs],
                             [("scan", 1015.0), ("scan", 1025.0),
                              ("both", 1015.0), ("both", 1025.0)])  # fmt: skip
            self.assertEqual("drive, both 1 s from 1015.0 s" in out, bool(error))

    def test_a_run_that_failed_counts_and_the_others_go_on(self):
        result = self.folder / "result.bag"
        with rosbag.Bag(str(result), "w") as bag:
            for tenths in range(400):
                pose = estimate_at(0.1 * tenths, 0.0, 0.0, 0.1)
                bag.write("/pose/local", pose, pose.header.stamp)
        (self.folder / "config.yaml").touch()
        once = f'[ -e {self.folder}/ran ] || {{ touch {self.folder}/ran; echo "out of memory" >&2; exit 1; }}'
        for name, text in (("simulate", "exit 1"), ("run_bag", f'{once}\ncp {result} "$2"')):
            program = self.folder / name
            program.write_text(f"#!/bin/sh\n{text}\n")
            program.chmod(0o755)
        code, out = self.sweep("--kinds", "scan")
        self.assertEqual(code, 1)
        self.assertIn("drive, scan 1 s from 1015.0 s: out of memory\n", out)
        runs = json.loads((self.folder / "out.json").read_text())["runs"]
        self.assertEqual([run["error"] for run in runs], ["out of memory", None])


if __name__ == "__main__":
    unittest.main()
