#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""score_run as a program, on bags that it must refuse: exit codes and messages."""

import copy
import json
import unittest

import rospy
from geometry_msgs.msg import Quaternion, Vector3
from score_run_bags import FRAMES, ScoreRunCase, header, identity, pose_at, run_messages

from datmo_fusion.msg import StageTiming

NAN = float("nan")


class BadBags(ScoreRunCase):
    def test_missing_topic(self):
        for messages, topic, kind in (
            (self.run_messages, "/tracks", "datmo_fusion/TrackArray"),
            (self.run_messages, "/pose", "geometry_msgs/PoseWithCovarianceStamped"),
            (self.truth_messages, "/ground_truth/objects", "datmo_fusion/TrueObjectArray"),
            (self.truth_messages, "/ground_truth/pose", "nav_msgs/Odometry"),
        ):
            with self.subTest(topic=topic):
                file = self.run_bag if messages is self.run_messages else self.truth_bag
                left_out = messages.pop(topic)
                self.assert_refused(f"{file}: no {kind} on {topic}; the bag holds:")
                messages[topic] = left_out

    def test_poses_are_not_needed_without_alignment(self):
        del self.run_messages["/pose"]
        report = self.score("--set", "align=none")
        self.assertEqual(report["clear_mot"]["mota"], 1.0)
        self.assertIsNone(report["pose"])

    def test_topic_of_another_type(self):
        self.run_messages["/tracks"] = self.run_messages["/pose"]
        self.assert_refused(f"{self.run_bag}: /tracks", "PoseWithCovarianceStamped",
                            "expected datmo_fusion/TrackArray")

    def test_empty_truth(self):
        for message in self.truth_messages["/ground_truth/objects"]:
            message.objects = []
        self.assert_refused(f"{self.truth_bag}: /ground_truth/objects holds no object",
                            "expected some")

    def test_stamps_that_do_not_overlap(self):
        for messages in self.run_messages.values():
            for message in messages:
                message.header.stamp += rospy.Duration(60.0)
        self.assert_refused(self.run_bag, self.truth_bag,
                            "tracks from 1060.000 s to 1062.000 s",
                            "true objects from 1000.000 s to 1002.000 s")

    def test_repeated_ids(self):
        self.run_messages["/tracks"][3].tracks *= 2
        self.assert_refused(f"{self.run_bag}: /tracks at 1000.3", "track 7 twice")
        self.run_messages = run_messages()
        self.truth_messages["/ground_truth/objects"][4].objects *= 2
        self.assert_refused(f"{self.truth_bag}: /ground_truth/objects at 1000.4", "object 1 twice")

    def test_repeated_and_zero_stamps(self):
        self.run_messages["/tracks"] *= 2
        self.assert_refused(f"{self.run_bag}: /tracks: two messages at 1000.0", "expected one")
        self.run_messages = run_messages()
        self.run_messages["/pose"][2].header.stamp = rospy.Time()
        self.assert_refused(f"{self.run_bag}: /pose at 0.0", "expected the time")

    def assert_change_refused(self, messages, topic, change, *expected):
        original = messages[topic][5]
        messages[topic][5] = copy.deepcopy(original)
        change(messages[topic][5])
        self.assert_refused(topic + " at 1000.5", *expected)
        messages[topic][5] = original

    def test_numbers_that_are_not_finite(self):
        def set_track(name, value):
            def change(message):
                setattr(message.tracks[0], name, value)

            return change

        covariance = identity(6)
        covariance[1] = NAN
        for name, value in (("pose", pose_at(NAN)), ("velocity", Vector3(NAN, 0.0, 0.0)),
                            ("size", Vector3(4.0, NAN, 0.0)), ("covariance", covariance)):
            with self.subTest(track=name):
                self.assert_change_refused(self.run_messages, "/tracks", set_track(name, value),
                                           "track 7", "nan", "expected finite")

        def shift_object(message):
            message.objects[0].velocity.x = float("inf")

        def shift_pose(message):
            message.pose.pose.position.x = NAN

        self.assert_change_refused(self.truth_messages, "/ground_truth/objects", shift_object,
                                   "object 1", "inf", "expected finite")
        self.assert_change_refused(self.truth_messages, "/ground_truth/pose", shift_pose, "nan")
        self.assert_change_refused(self.run_messages, "/pose", shift_pose, "nan")

        def lose_covariance(message):
            message.pose.covariance = covariance

        self.assert_change_refused(self.run_messages, "/pose", lose_covariance, "covariance", "nan")
        self.run_messages["/timing"] = [
            StageTiming(header=header("map", i), stage="tracker") for i in range(FRAMES)
        ]

        def lose_time(message):
            message.processing_time = NAN

        self.assert_change_refused(self.run_messages, "/timing", lose_time, "tracker", "nan")

    def test_invalid_poses_and_boxes(self):
        def lose_rotation(message):
            message.tracks[0].pose.orientation = Quaternion()

        def turn_inside_out(message):
            message.objects[0].size.x = -4.0

        self.assert_change_refused(self.run_messages, "/tracks", lose_rotation,
                                   "quaternion of length 0")
        self.assert_change_refused(self.truth_messages, "/ground_truth/objects", turn_inside_out,
                                   "-4", "expected at least 0")

    def test_frames_that_do_not_fit(self):
        self.run_messages["/tracks"][6].header.frame_id = "odom"
        self.assert_refused(f"{self.run_bag}: /tracks at 1000.6", "'odom'", "'map'",
                            "expected one frame")
        for message in self.run_messages["/tracks"]:
            message.header.frame_id = "odom"
        self.assert_refused(f"{self.run_bag}: /tracks is in frame 'odom', but /pose in 'map'")

    def test_truncated_bag(self):
        self.write_bags()
        content = self.run_bag.read_bytes()
        self.run_bag.write_bytes(content[: len(content) // 2])
        self.assert_no_report(self.run_bag)

    def test_bag_that_is_corrupt_anywhere(self):
        """Bytes that are not read may have any value;
        for others the file is named. It ends in no other way."""
        self.write_bags()
        content = self.truth_bag.read_bytes()
        refused = 0
        for tenth in range(1, 10):
            broken = bytearray(content)
            begin = tenth * len(content) // 10
            broken[begin : begin + 300] = b"\xff" * 300
            self.truth_bag.write_bytes(broken)
            done = self.run_tool(self.run_bag, self.truth_bag)
            self.assertIn(done.returncode, (0, 2))
            if done.returncode == 0:
                self.assertEqual(json.loads(done.stdout)["frames"], FRAMES)
            else:
                self.assertIn(str(self.truth_bag), done.stderr)
                self.assertEqual(done.stdout, "")
                refused += 1
        self.assertGreater(refused, 0)

    def test_files_that_are_not_bags(self):
        self.write_bags()
        self.truth_bag.write_text("not a bag")
        self.assert_no_report(f"{self.truth_bag}: is not a bag")
        self.truth_bag.unlink()
        self.assert_no_report(f"{self.truth_bag}: no such file")


if __name__ == "__main__":
    unittest.main()
