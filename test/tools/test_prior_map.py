#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Starts in a prior map: what is cut out of a drive, and the score of poses, worked out by hand."""

import math
import tempfile
import unittest
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import String

from datmo_tools.experiments.map_coverage import MapSurfaces
from datmo_tools.experiments.prior_map import cut, score, table
from datmo_tools.pose_path import PosePath

START = 1000  # s
BEGIN = START * 10**9  # ns


def pose_at(seconds, offset, turn, sigma):
    """Returns a pose at 1 m/s along x, `offset` (m) to the left and `turn` (degrees) off."""
    message = PoseWithCovarianceStamped()
    message.header.stamp = rospy.Time.from_sec(START + seconds)
    pose = message.pose.pose
    pose.position.x, pose.position.y = seconds, offset
    pose.orientation.z, pose.orientation.w = (f(math.radians(turn) / 2) for f in (math.sin, math.cos))
    message.pose.covariance = [sigma**2 if i % 7 == 0 else 0.0 for i in range(36)]
    return message


class PriorMap(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.reference = PosePath([BEGIN, BEGIN + 20 * 10**9], [[0, 0, 0], [20, 0, 0]])

    def scored(self, offset, turn=0.0, found_at=6):
        """Returns poses once a second that claim to be located from `found_at` (s) on."""
        computed = self.folder / "computed.bag"
        with rosbag.Bag(str(computed), "w") as bag:
            for second in range(15):
                is_found = second >= found_at
                pose = pose_at(second, offset if is_found else 9.0, turn, 0.1 if is_found else 8.0)
                bag.write("/pose/local", pose, pose.header.stamp)
        return score(computed, self.reference, BEGIN)

    def test_found(self):
        result = self.scored(0.1, 1.0)
        self.assertAlmostEqual(result["found_after_s"], 6.0)
        self.assertAlmostEqual(result["position_m"], 0.1)
        self.assertAlmostEqual(result["heading_deg"], 1.0)
        self.assertFalse(result["wrong"])

    def test_a_pose_is_wrong_by_position_or_heading(self):
        self.assertTrue(self.scored(0.6)["wrong"])
        self.assertTrue(self.scored(0.1, 6.0)["wrong"])

    def test_lost_is_not_wrong(self):
        result = self.scored(30.0, 0.0, found_at=99)
        self.assertIsNone(result["found_after_s"])
        self.assertFalse(result["wrong"])

    def test_table_counts(self):
        results = [self.scored(0.1), self.scored(0.1, found_at=12), self.scored(5.0),
                   self.scored(0.0, found_at=99)]  # fmt: skip
        for one, share in zip(results, (1.0, 0.9, 0.8, 0.3)):
            one["known_share"] = share
        rows = [line.split() for line in table(results, within=10.0).splitlines()]
        self.assertEqual(rows[1][:5], ["all", "4", "1", "2", "1"])
        self.assertEqual(rows[2][:3], ["90", "to", "100"])
        counts = [" ".join(row[10:14]) for row in rows[2:]]
        self.assertEqual(counts, ["2 1 2 0", "1 0 0 1", "0 0 0 0", "1 0 0 0"])

    def test_known_share_of_a_view(self):
        (self.folder / "hall.pgm").write_bytes(b"P5\n10 5\n255\n" + bytes(10) + bytes([254] * 40))
        described = self.folder / "hall.yaml"
        described.write_text("image: hall.pgm\nresolution: 1.0\norigin: [-2.0, 3.0, 0.0]\n"
                             "occupied_thresh: 0.65\n")  # fmt: skip
        surfaces = MapSurfaces(described)
        # The image's first row is at the top: y from 7 to 8 m.
        known = surfaces.known([(0.5, 7.5), (0.5, 6.5), (-1.5, 7.1), (7.5, 7.5), (8.5, 7.5)])
        self.assertEqual(list(known), [True, False, True, True, False])

    def test_cut_keeps_mounts_and_all_topics_of_its_time(self):
        drive, written = self.folder / "drive.bag", self.folder / "cut.bag"
        with rosbag.Bag(str(drive), "w") as bag:
            bag.write("/tf_static", String("mounts"), rospy.Time.from_sec(START))
            for second in range(30):
                for topic in ("/scan", "/odometry", "/tf", "/other"):
                    bag.write(topic, String(topic), rospy.Time.from_sec(START + second))
        cut(drive, BEGIN + 10 * 10**9, BEGIN + 14 * 10**9, written)
        with rosbag.Bag(str(written)) as bag:
            topics = bag.get_type_and_topic_info().topics
            counts = {topic: info.message_count for topic, info in topics.items()}
        self.assertEqual(counts, {"/tf_static": 1, "/scan": 5, "/odometry": 5, "/tf": 5, "/other": 5})


if __name__ == "__main__":
    unittest.main()
