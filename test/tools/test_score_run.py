#!/usr/bin/python3
"""score_run as a program, on small bags that are made here: exit codes, messages, whole reports."""

import copy
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import Point, Pose, PoseWithCovarianceStamped, Quaternion, Vector3
from nav_msgs.msg import Odometry
from std_msgs.msg import Header

from datmo_fusion.msg import (
    Object,
    ObjectArray,
    RoadBorders,
    StageTiming,
    Track,
    TrackArray,
    TrueObject,
    TrueObjectArray,
    TrueRoadBorders,
)

SCORE_RUN = os.environ["DATMO_FUSION_SCORE_RUN"]

FRAMES = 21
PERIOD = 0.1  # s
START = 1000.0  # s
SPEED = 10.0  # m/s, of the car and of the vehicle behind it
CAR_AHEAD = 20.0  # m

NAN = float("nan")


def header(frame, i):
    return Header(stamp=rospy.Time.from_sec(START + PERIOD * i), frame_id=frame)


def pose_at(x, y=0.0):
    return Pose(position=Point(x, y, 0.0), orientation=Quaternion(0.0, 0.0, 0.0, 1.0))


def identity(size):
    return [float(i % (size + 1) == 0) for i in range(size * size)]


def track_at(number, x, y=0.0):
    return Track(
        id=number, pose=pose_at(x, y), size=Vector3(4.0, 2.0, 0.0), velocity=Vector3(SPEED, 0, 0),
        covariance=identity(6), moving=True, sensors=["scanner"],
    )  # fmt: skip


def car_at(number, x, y=0.0):
    return TrueObject(
        id=number, label="Car", classification=Object.CLASS_VEHICLE, pose=pose_at(x, y),
        size=Vector3(4.0, 2.0, 1.5), velocity=Vector3(SPEED, 0.0, 0.0), moving=True,
        visible_to=["scanner"], lidar_beams=3,
    )  # fmt: skip


def run_messages():
    """Topic -> messages of a run that follows the car half a metre beside it, by id 7."""
    messages = {"/tracks": [], "/pose": []}
    for i in range(FRAMES):
        way = SPEED * PERIOD * i
        tracks = [track_at(7, way + CAR_AHEAD, 0.5)]
        pose = PoseWithCovarianceStamped(header=header("map", i))
        pose.pose.pose = pose_at(way)
        pose.pose.covariance = identity(6)
        messages["/tracks"].append(TrackArray(header=header("map", i), tracks=tracks))
        messages["/pose"].append(pose)
    return messages


def truth_messages():
    """Topic -> messages of a car ahead of a vehicle that follows it, along x of the map."""
    messages = {"/ground_truth/objects": [], "/ground_truth/pose": []}
    for i in range(FRAMES):
        way = SPEED * PERIOD * i
        objects = [car_at(1, way + CAR_AHEAD)]
        pose = Odometry(header=header("map", i), child_frame_id="base_link_ground_truth")
        pose.pose.pose = pose_at(way)
        messages["/ground_truth/objects"].append(
            TrueObjectArray(header=header("map", i), objects=objects)
        )
        messages["/ground_truth/pose"].append(pose)
    return messages


def write(path, messages):
    with rosbag.Bag(str(path), "w") as bag:
        for topic, items in messages.items():
            for i, item in enumerate(items):
                bag.write(topic, item, rospy.Time.from_sec(START + PERIOD * i))


class ScoreRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.run_bag = self.folder / "run.bag"
        self.truth_bag = self.folder / "truth.bag"
        self.report = self.folder / "report.json"
        self.run_messages = run_messages()
        self.truth_messages = truth_messages()

    def write_bags(self):
        write(self.run_bag, self.run_messages)
        write(self.truth_bag, self.truth_messages)

    def run_tool(self, *arguments):
        return subprocess.run([SCORE_RUN, *map(str, arguments)], stderr=subprocess.PIPE,
                              stdout=subprocess.PIPE, universal_newlines=True)

    def score(self, *options):
        """The report of the two bags."""
        self.write_bags()
        done = self.run_tool(self.run_bag, self.truth_bag, "--out", self.report, *options)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        return json.loads(self.report.read_text())

    def assert_no_report(self, *expected, arguments=None):
        """There is no report, and the message holds all of `expected`."""
        if arguments is None:
            arguments = (self.run_bag, self.truth_bag, "--out", self.report)
        before = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stdout, "")
        for part in expected:
            self.assertIn(str(part), done.stderr)
        after = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        self.assertEqual(before.keys(), after.keys())
        self.assertTrue(before == after, "a file was changed")

    def assert_refused(self, *expected):
        """The bags as they are now lead to no report."""
        self.write_bags()
        self.assert_no_report(*expected)


class WholeRun(ScoreRun):
    def test_what_it_scores(self):
        report = self.score()
        self.assertEqual(report["run"], str(self.run_bag))
        self.assertEqual(report["truth"], str(self.truth_bag))
        self.assertEqual(report["frames"], FRAMES)
        self.assertEqual(report["clear_mot"]["matches"], FRAMES)
        self.assertEqual(report["clear_mot"]["mota"], 1.0)
        self.assertAlmostEqual(report["errors"]["position_rmse_m"], 0.5)
        self.assertAlmostEqual(report["consistency"]["position"]["mean_nees"], 0.25)
        self.assertAlmostEqual(report["pose"]["way_m"], 20.0)
        self.assertAlmostEqual(report["pose"]["end_error_m"], 0.0)
        self.assertEqual(report["pose"]["mean_nees"], 0.0)
        self.assertEqual(report["objects"][0]["track_ids"], [7])
        self.assertIsNone(report["timing"])
        self.assertIsNone(report["thesis"]["intersections"])
        self.assertIsNone(report["thesis"]["false_moving_objects_frames"])

    def test_the_same_bags_give_the_same_bytes(self):
        self.score()
        first = self.report.read_bytes()
        self.score()
        self.assertEqual(first, self.report.read_bytes())

    def test_one_bag_with_both_and_standard_output(self):
        write(self.run_bag, {**self.run_messages, **self.truth_messages})
        done = self.run_tool(self.run_bag)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(json.loads(done.stdout)["clear_mot"]["mota"], 1.0)

    def test_optional_topics(self):
        self.run_messages["/objects"] = [
            ObjectArray(header=header("base_link", i), objects=[
                Object(pose=pose_at(CAR_AHEAD), dynamic_state=Object.STATE_MOVING),
                Object(pose=pose_at(CAR_AHEAD, 10.0), dynamic_state=Object.STATE_MOVING),
                Object(pose=pose_at(CAR_AHEAD, 12.0), dynamic_state=Object.STATE_STATIC),
            ]) for i in range(FRAMES)
        ]  # fmt: skip
        self.run_messages["/road_borders"] = [
            RoadBorders(header=header("map", i), at_intersection=i in (5, 18))
            for i in range(FRAMES)
        ]
        self.run_messages["/timing"] = [
            StageTiming(header=header("map", i), stage=stage, processing_time=1e-3 * (i + 1),
                        latency=latency)
            for i in range(FRAMES) for stage, latency in (("grid_slam", -1.0), ("tracker", 4e-3))
        ]  # fmt: skip
        self.truth_messages["/ground_truth/road_borders"] = [
            TrueRoadBorders(header=header("map", i), at_intersection=4 <= i <= 6)
            for i in range(FRAMES)
        ]
        report = self.score("--set", "intersection_merge_gap=0.5")
        self.assertEqual(report["thesis"]["false_moving_objects_frames"], 1.0)
        # It goes with the vehicle, 1 m from frame to frame, within the gate.
        self.assertEqual(report["thesis"]["false_moving_objects_episodes"], 1)
        self.assertEqual(report["thesis"]["intersections"], 1)
        self.assertEqual(report["thesis"]["intersections_found"], 1)
        self.assertEqual(report["thesis"]["intersections_false"], 1)
        self.assertAlmostEqual(report["timing"]["tracker"]["median_ms"], 11.0)
        self.assertAlmostEqual(report["timing"]["tracker"]["worst_ms"], 21.0)
        self.assertAlmostEqual(report["timing"]["tracker"]["latency"]["median_ms"], 4.0)
        self.assertIsNone(report["timing"]["grid_slam"]["latency"])

    def test_a_track_on_a_parked_car_is_false(self):
        for i, message in enumerate(self.truth_messages["/ground_truth/objects"]):
            parked = car_at(2, 30.0, 8.0)
            parked.moving = False
            message.objects.append(parked)
            if i < 5:
                self.run_messages["/tracks"][i].tracks.append(track_at(8, 30.0, 7.0))
        report = self.score()
        self.assertEqual(report["clear_mot"]["false_positives"], 5)
        self.assertEqual(report["thesis"]["false_tracks"], 1)
        self.assertEqual(report["truth_objects"], 1)
        self.assertEqual(
            report["standing_objects"],
            [{"id": 2, "label": "Car", "class": "vehicle", "frames": FRAMES, "tracked_frames": 5}],
        )

    def test_options_from_file_and_command_line(self):
        options = self.folder / "options.yaml"
        options.write_text("matching: {gate: 0.4, distance: to_centre}\nregion: {range: 40.0}\n")
        report = self.score("--options", options, "--set", "region/range=30")
        self.assertEqual(report["clear_mot"]["matches"], 0)
        self.assertEqual(report["options"]["matching/gate"], 0.4)
        self.assertEqual(report["options"]["region/range"], 30.0)

    def test_what_no_sensor_sees_need_not_be_found_unless_wanted(self):
        for message in self.truth_messages["/ground_truth/objects"]:
            message.objects[0].visible_to = []
        self.assertEqual(self.score()["clear_mot"]["required"], 0)
        report = self.score("--set", "truth/visible_to=none")
        self.assertEqual(report["clear_mot"]["required"], FRAMES)

    def test_topics_of_another_name(self):
        self.run_messages["/tracker/tracks"] = self.run_messages.pop("/tracks")
        report = self.score("--set", "topics/tracks=/tracker/tracks")
        self.assertEqual(report["clear_mot"]["mota"], 1.0)

    def test_a_run_that_finds_nothing_is_a_run(self):
        for message in self.run_messages["/tracks"]:
            message.tracks = []
        report = self.score()
        self.assertEqual(report["clear_mot"]["misses"], FRAMES)
        self.assertIsNone(report["clear_mot"]["motp_m"])
        self.assertIsNone(report["errors"]["position_rmse_m"])
        self.assertEqual(report["thesis"]["missed_objects"], 1)

    def test_help_and_options(self):
        self.assertIn("usage: score_run", self.run_tool("--help").stdout)
        self.assertIn("| `matching/gate` | m |", self.run_tool("--list-options").stdout)


class BadBags(ScoreRun):
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

    def test_poses_and_boxes_that_are_none(self):
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

    def test_bag_that_is_cut_short(self):
        self.write_bags()
        content = self.run_bag.read_bytes()
        self.run_bag.write_bytes(content[: len(content) // 2])
        self.assert_no_report(self.run_bag)

    def test_bag_that_is_broken_anywhere(self):
        """Bytes that nobody reads may be any; else the file is named. It never ends otherwise."""
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

    def test_files_that_are_no_bags(self):
        self.write_bags()
        self.truth_bag.write_text("not a bag")
        self.assert_no_report(f"{self.truth_bag}: cannot be read as a bag")
        self.truth_bag.unlink()
        self.assert_no_report(f"{self.truth_bag}: no such file")


class BadUsage(ScoreRun):
    def setUp(self):
        super().setUp()
        self.write_bags()

    def refuse(self, *arguments, expected):
        self.assert_no_report(*expected, arguments=arguments)

    def test_wrong_words(self):
        self.refuse(expected=["0 bags are named"])
        self.refuse("a.bag", "b.bag", "c.bag", expected=["3 bags are named"])
        self.refuse(self.run_bag, "--fast", expected=["'--fast'"])
        self.refuse(self.run_bag, "--out", expected=["--out: expected a value"])
        self.refuse(self.run_bag, "--set", "gate", expected=["gate", "key=value"])

    def test_misspelt_and_bad_options(self):
        options = self.folder / "options.yaml"
        options.write_text("matching: {gte: 1.0}\n")
        self.refuse(self.run_bag, "--options", options,
                    expected=[f"{options}: matching/gte", "matching/gate"])
        options.write_text("matching: {gate: -1.0}\n")
        self.refuse(self.run_bag, "--options", options,
                    expected=[f"{options}: matching/gate = -1"])
        self.refuse(self.run_bag, "--options", self.folder / "none.yaml", expected=["none.yaml"])
        self.refuse(self.run_bag, "--set", "align=somehow", expected=["'somehow'", "first_pose"])

    def test_inputs_are_not_overwritten(self):
        self.refuse(self.run_bag, self.truth_bag, "--out", self.folder / "." / "run.bag",
                    expected=["must not be an input"])

    def test_reports_that_cannot_be_written(self):
        self.refuse(self.run_bag, self.truth_bag, "--out", self.folder, expected=["is a folder"])
        self.refuse(self.run_bag, self.truth_bag, "--out", self.folder / "none" / "report.json",
                    expected=["none/report.json: cannot be written"])

    def test_an_old_report_stays_if_there_is_no_new_one(self):
        self.report.write_text("old")
        self.truth_bag.unlink()
        self.assert_no_report(self.truth_bag)
        self.assertEqual(self.report.read_text(), "old")


if __name__ == "__main__":
    unittest.main()
