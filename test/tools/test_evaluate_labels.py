#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate labels on a run of one second whose score is worked out by hand."""

import math
import unittest

import rosbag
from geometry_msgs.msg import Point, PoseWithCovarianceStamped, Quaternion
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

import simulated_recording as simulated
from datmo_fusion.msg import Track, TrackArray
from datmo_tools.errors import InputError
from datmo_tools.evaluate.track_lists import read_track_lists
from datmo_tools.transforms import quaternion_of_yaw
from evaluate_case import EvaluateCase

LABELS = "/people"
RECORDED_AFTER = 0.05  # s, from the stamp of a scan to its record
FRAMES = 10


def scan(frame):
    return LaserScan(header=Header(stamp=simulated.ros_time(0.1 * frame), frame_id="/laser"))


def label(number, x, y, stamp=None):
    """In the scanner's frame, which is 1 m ahead of base_link and faces left."""
    message = Marker(id=number)
    message.pose.position = Point(x, y, 0.0)
    if stamp is not None:
        message.header = Header(stamp=simulated.ros_time(stamp), frame_id="base_link")
    return message


def pose(frame):
    """base_link moves along x by 1 m a second."""
    message = PoseWithCovarianceStamped()
    message.header = Header(stamp=simulated.ros_time(0.1 * frame), frame_id="map")
    message.pose.pose.position = Point(0.1 * frame, 0.0, 0.0)
    message.pose.pose.orientation = Quaternion(0.0, 0.0, 0.0, 1.0)
    return message


def tracks(frame, *positions):
    """Returns a TrackArray of (id, x, y)."""
    message = TrackArray()
    message.header = Header(stamp=simulated.ros_time(0.1 * frame), frame_id="map")
    for number, x, y in positions:
        track = Track(id=number)
        track.pose.position = Point(x, y, 0.0)
        track.pose.orientation = Quaternion(0.0, 0.0, 0.0, 1.0)
        message.tracks.append(track)
    return message


class Tool(EvaluateCase):
    def score(self, labels, lists, *words, code=0):
        """labels: (frame, message); lists: frame -> positions of tracks."""
        recording, result = self.folder / "in.bag", self.folder / "out.bag"
        mount = simulated.transform(0.0, "base_link", "laser", (1.0, 0.0, 0.0),
                                    quaternion_of_yaw(math.pi / 2))  # fmt: skip
        with rosbag.Bag(str(recording), "w") as bag:
            bag.write("/tf_static", mount, simulated.ros_time(0.0))
            for frame in range(FRAMES):
                recorded = 0.1 * frame + RECORDED_AFTER
                bag.write("/scan", scan(frame), simulated.ros_time(recorded))
                for _, message in (item for item in labels if item[0] == frame):
                    bag.write(LABELS, message, simulated.ros_time(recorded + 0.01))
        with rosbag.Bag(str(result), "w") as bag:
            for frame in range(FRAMES):
                at = simulated.ros_time(0.1 * frame)
                bag.write("/pose", pose(frame), at)
                bag.write("/tracks", tracks(frame, *lists.get(frame, ())), at)
        words = ("labels", result, recording, "--labels", LABELS, *words)
        out, errors, score = self.evaluate(*words, code=code)
        return score or out + errors

    def test_label_of_the_scan_before_it(self):
        """2 m ahead of the scanner is 2 m left of it: (1.3, 2) in the map at frame 3."""
        score = self.score([(3, label(1, 2.0, 0.0))], {3: [(7, 1.3, 2.3)]})
        self.assertEqual((score["positions"], score["found"]), (1, 1))
        self.assertAlmostEqual(score["median_distance_m"], 0.3)

    def test_label_with_a_header(self):
        score = self.score([(5, label(1, 4.0, 1.0, stamp=0.4))], {4: [(7, 4.4, 1.1)]})
        self.assertAlmostEqual(score["median_distance_m"], 0.1)

    def test_gate(self):
        labels, lists = [(3, label(1, 2.0, 0.0))], {3: [(7, 1.3, 2.6)]}
        self.assertEqual(self.score(labels, lists)["found_share"], 0.0)
        self.assertEqual(self.score(labels, lists, "--gate", "0.7")["found_share"], 1.0)

    def test_one_track_serves_one_label(self):
        score = self.score([(3, label(1, 2.0, 0.1)), (3, label(2, 2.0, -0.1))],
                           {3: [(7, 1.2, 2.0)]})  # fmt: skip
        self.assertEqual((score["found"], score["ids_never_found"]), (1, [2]))

    def test_switches(self):
        """Track 7 in frames 1 and 2, none in 3, then 8: one switch."""
        labels = [(frame, label(1, 2.0, 0.0)) for frame in (1, 2, 3, 4, 5)]
        lists = {frame: [(7, 1.0 + 0.1 * frame, 2.0)] for frame in (1, 2)}
        lists.update({frame: [(8, 1.0 + 0.1 * frame, 2.0)] for frame in (4, 5)})
        score = self.score(labels, lists)
        self.assertEqual((score["found"], score["id_switches"]), (4, 1))
        self.assertEqual((score["switches"][0]["from"], score["switches"][0]["to"]), (7, 8))

    def test_nothing_labeled(self):
        self.assertIn("nothing on /people", self.score([], {}, code=1))

    def test_label_that_is_not_finite(self):
        text = self.score([(3, label(1, math.nan, 0.0))], {}, code=1)
        self.assertIn("in.bag: /people: id 1 at nan, 0, expected finite numbers", text)

    def test_result_without_tracks(self):
        self.score([(3, label(1, 2.0, 0.0))], {})
        with self.assertRaisesRegex(InputError, "nothing on /tracks, expected a bag of run_bag$"):
            read_track_lists(self.folder / "in.bag", ["/tracks"])

    def test_frame_without_mount(self):
        text = self.score([(3, label(1, 2.0, 0.0))], {}, "--base", "chassis", code=1)
        self.assertIn("no transform chassis -> laser", text)


if __name__ == "__main__":
    unittest.main()
