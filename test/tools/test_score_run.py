#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""score_run as a program, on small bags: whole reports, and how it is called."""

import json
import unittest

from score_run_bags import (
    CAR_AHEAD,
    FRAMES,
    PERIOD,
    ScoreRunCase,
    car_at,
    header,
    identity,
    mount,
    pose_at,
    scan_at,
    track_at,
    write,
)

from datmo_fusion.msg import Object, ObjectArray, RoadBorders, StageTiming, TrueRoadBorders


class WholeRun(ScoreRunCase):
    def test_what_it_scores(self):
        report = self.score()
        self.assertEqual(report["run"], str(self.run_bag))
        self.assertEqual(report["truth"], str(self.truth_bag))
        self.assertEqual(report["frames"], FRAMES)
        self.assertEqual(report["clear_mot"]["matches"], FRAMES)
        self.assertEqual(report["clear_mot"]["mota"], 1.0)
        self.assertAlmostEqual(report["errors"]["position_rmse_m"], 0.5)
        self.assertAlmostEqual(report["consistency"]["position"]["mean_nees"], 0.25)
        self.assertAlmostEqual(report["pose"]["path_length_m"], 20.0)
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
        # It moves with the vehicle, 1 m from frame to frame, within the gate.
        self.assertEqual(report["thesis"]["false_moving_objects_episodes"], 1)
        self.assertEqual(report["thesis"]["intersections"], 1)
        self.assertEqual(report["thesis"]["intersections_found"], 1)
        self.assertEqual(report["thesis"]["intersections_false"], 1)
        self.assertAlmostEqual(report["timing"]["tracker"]["median_ms"], 11.0)
        self.assertAlmostEqual(report["timing"]["tracker"]["worst_ms"], 21.0)
        self.assertAlmostEqual(report["timing"]["tracker"]["latency"]["median_ms"], 4.0)
        self.assertIsNone(report["timing"]["grid_slam"]["latency"])

    def test_attainable_delays(self):
        """One beam on the rear of a car 20 m ahead: 10 m/s, distinguishable by the second scan."""
        drive = self.folder / "drive.bag"
        write(drive, {"/tf_static": [mount()], "/scan": [scan_at(i) for i in range(FRAMES)]})
        report = self.score("--attainable", drive, "--set", "attainable/range_noise=0.2")
        car = report["objects"][0]
        self.assertAlmostEqual(car["attainable_delay_s"], PERIOD)
        self.assertAlmostEqual(car["excess_delay_s"], -PERIOD)
        self.assertAlmostEqual(car["delay_ratio"], 0.5)
        self.assertAlmostEqual(car["beams_per_scan"], 1.0)
        self.assertEqual(report["attainable"]["detectable"], 1)
        self.assertEqual(report["attainable"]["by_class"]["vehicle"]["ratio"]["median"], 0.5)

    def test_attainable_delays_need_scans_and_their_mount(self):
        self.write_bags()
        self.assert_no_report(
            "truth.bag", "LaserScan", "/scan",
            arguments=(self.run_bag, self.truth_bag, "--attainable", self.truth_bag))  # fmt: skip
        drive = self.folder / "drive.bag"
        write(drive, {"/scan": [scan_at(0)]})
        self.assert_no_report(
            "drive.bag", "scanner",
            arguments=(self.run_bag, self.truth_bag, "--attainable", drive))  # fmt: skip

    def test_without_scans_nothing_is_attainable(self):
        report = self.score()
        self.assertIsNone(report["attainable"])
        self.assertNotIn("delay_ratio", report["objects"][0])

    def test_objects_are_those_that_the_tracker_used(self):
        def objects(moving):
            return [
                ObjectArray(header=header("base_link", i), objects=[
                    Object(pose=pose_at(CAR_AHEAD, 10.0), dynamic_state=Object.STATE_MOVING)
                    for _ in range(moving)
                ]) for i in range(FRAMES)
            ]  # fmt: skip

        self.run_messages["/objects"] = objects(1)
        self.assertEqual(self.score()["thesis"]["false_moving_objects_frames"], 1.0)
        self.run_messages["/objects/fused"] = objects(2)
        self.assertEqual(self.score()["thesis"]["false_moving_objects_frames"], 2.0)
        report = self.score("--set", "topics/objects=/objects")
        self.assertEqual(report["thesis"]["false_moving_objects_frames"], 1.0)

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
        options.write_text("matching: {gate: 0.4, distance: to_center}\nregion: {range: 40.0}\n")
        report = self.score("--options", options, "--set", "region/range=30")
        self.assertEqual(report["clear_mot"]["matches"], 0)
        self.assertEqual(report["options"]["matching/gate"], 0.4)
        self.assertEqual(report["options"]["region/range"], 30.0)

    def test_objects_seen_by_no_sensor_are_not_required_by_default(self):
        for message in self.truth_messages["/ground_truth/objects"]:
            message.objects[0].visible_to = []
        self.assertEqual(self.score()["clear_mot"]["required"], 0)
        report = self.score("--set", "truth/visible_to=none")
        self.assertEqual(report["clear_mot"]["required"], FRAMES)

    def test_topics_of_another_name(self):
        self.run_messages["/tracker/tracks"] = self.run_messages.pop("/tracks")
        report = self.score("--set", "topics/tracks=/tracker/tracks")
        self.assertEqual(report["clear_mot"]["mota"], 1.0)

    def test_matches_of_each_frame(self):
        """Two cars that swap their tracks halfway, and a track of neither."""
        for i, (truth, tracks) in enumerate(zip(self.truth_messages["/ground_truth/objects"],
                                                self.run_messages["/tracks"])):
            x = CAR_AHEAD + i
            numbers = (7, 8) if i < FRAMES // 2 else (8, 7)
            truth.objects = [car_at(1, x, 0.0), car_at(2, x, 6.0)]
            tracks.tracks = [track_at(numbers[0], x, 0.25), track_at(9, x, -9.0)]
            tracks.tracks += [track_at(numbers[1], x, 6.5)] * (i > 0)
        file = self.folder / "matches.json"
        report = self.score("--matches", str(file), "--set", "matching/distance=to_center")
        with open(file, encoding="utf-8") as text:
            frames = json.load(text)["frames"]
        self.assertEqual([frame["stamp_ns"] for frame in frames],
                         [item.header.stamp.to_nsec() for item in self.run_messages["/tracks"]])
        self.assertEqual(frames[0]["matches"], [
            {"truth_id": 1, "track_id": 7, "distance_m": 0.25, "required": True}])
        self.assertEqual((frames[0]["missed"], frames[0]["false"]), ([2], [9]))
        self.assertEqual([pair["track_id"] for pair in frames[-1]["matches"]], [8, 7])
        changed = [(i, item["truth_id"], item["from"], item["to"])
                   for i, frame in enumerate(frames) for item in frame["switches"]]
        self.assertEqual(changed, [(FRAMES // 2, 1, 7, 8), (FRAMES // 2, 2, 8, 7)])
        self.assertEqual(report["clear_mot"]["id_switches"], 2)

    def test_a_run_that_finds_nothing_is_a_run(self):
        for message in self.run_messages["/tracks"]:
            message.tracks = []
        report = self.score()
        self.assertEqual(report["clear_mot"]["misses"], FRAMES)
        self.assertIsNone(report["clear_mot"]["motp_m"])
        self.assertIsNone(report["errors"]["position_rmse_m"])
        self.assertEqual(report["thesis"]["missed_objects"], 1)

    def test_invalid_covariances_are_counted_and_reported(self):
        for message in self.run_messages["/tracks"][:3]:
            message.tracks[0].covariance = [0.0] * 36
        self.run_messages["/pose"][0].pose.covariance = [-value for value in identity(6)]
        self.write_bags()
        done = self.run_tool(self.run_bag, self.truth_bag)
        self.assertEqual(done.returncode, 0)
        for remark in (
            f"3 of {FRAMES} covariances of the tracks' position",
            f"3 of {FRAMES} covariances of the tracks' velocity",
            f"1 of {FRAMES} covariances of the vehicle's pose",
        ):
            self.assertIn(remark, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report["consistency"]["position"]["unusable"], 3)
        self.assertEqual(report["pose"]["unusable"], 1)

    def test_a_label_that_is_not_utf_8_is_no_reason_to_stop(self):
        for message in self.truth_messages["/ground_truth/objects"]:
            message.objects[0].label = "Car#"
        self.write_bags()
        self.truth_bag.write_bytes(self.truth_bag.read_bytes().replace(b"Car#", b"Car\xff"))
        done = self.run_tool(self.run_bag, self.truth_bag)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(json.loads(done.stdout)["objects"][0]["label"], "Car\ufffd")

    def test_help_and_options(self):
        self.assertIn("usage: score_run", self.run_tool("--help").stdout)
        self.assertIn("| `matching/gate` | m |", self.run_tool("--list-options").stdout)


class BadUsage(ScoreRunCase):
    def setUp(self):
        super().setUp()
        self.write_bags()

    def refuse(self, *arguments, expected):
        self.assert_no_report(*expected, arguments=arguments)

    def test_wrong_arguments(self):
        self.refuse(expected=["0 bags are given"])
        self.refuse("a.bag", "b.bag", "c.bag", expected=["3 bags are given"])
        self.refuse(self.run_bag, "--fast", expected=["'--fast'"])
        self.refuse(self.run_bag, "--out", expected=["--out: expected a value"])
        self.refuse(self.run_bag, "--set", "gate", expected=["gate", "key=value"])

    def test_misspelled_and_bad_options(self):
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

    def test_each_output_has_a_file_of_its_own(self):
        self.refuse(self.run_bag, self.truth_bag, "--out", self.report, "--matches", self.report,
                    expected=["expected another file for each output"])

    def test_reports_that_cannot_be_written(self):
        self.refuse(self.run_bag, self.truth_bag, "--out", self.folder, expected=["is a folder"])
        self.refuse(self.run_bag, self.truth_bag, "--out", self.folder / "none" / "report.json",
                    expected=["none/report.json: cannot be written"])

    def test_an_old_report_is_kept_if_there_is_no_new_one(self):
        self.report.write_text("old")
        self.truth_bag.unlink()
        self.assert_no_report(self.truth_bag)
        self.assertEqual(self.report.read_text(), "old")


if __name__ == "__main__":
    unittest.main()
