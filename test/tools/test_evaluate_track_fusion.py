#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate track_fusion on drives of one second whose score is worked out by hand."""

import math
import unittest

from datmo_tools import bag_messages
from datmo_tools.bag_file import whole_bag
from nav_msgs.msg import OccupancyGrid

from datmo_fusion.msg import Object
from evaluate_case import EvaluateCase
from track_samples import SPEED, START, car, track, view, write_run

DRIVING = car(1, 20.0, 0.0, SPEED)
PARKED = car(2, 15.0, 8.0)
POLE = car(3, 10.0, -8.0, label="Pole", classification=Object.CLASS_POLE)


class Tool(EvaluateCase):
    def setUp(self):
        super().setUp()
        self.bag = self.folder / "run.bag"

    def write(self, lidar=(), stereo=(), fused=(), objects=(DRIVING, PARKED, POLE), views=None):
        lists = {"/tracks/lidar": lidar, "/tracks/stereo": stereo, "/tracks": fused}
        write_run(self.bag, lists, objects, [view()] if views is None else views)

    def run_tool(self, *words, code=0):
        return self.evaluate("track_fusion", self.bag, *words, code=code)

    def score(self, *words):
        return self.run_tool(*words)[2]

    def test_car_that_both_track(self):
        """Both track it from 0.2 s on, and it passes at 0.4 s."""
        members = ("lidar", 7), ("stereo", 4)
        self.write([track(7, 20.0, 0.5, SPEED)], [track(4, 21.0, 0.0, SPEED, range(2, 11))],
                   [track(1, 20.0, 0.3, SPEED, sources=members, sources_from=4)])  # fmt: skip
        out, _, score = self.run_tool()
        self.assertEqual(score["tracks"], {"fused": 1, "lidar": 1, "stereo": 1})
        passed = score["passed"]
        self.assertEqual((passed["tracks"], passed["true_movers"]), (1, 1))
        self.assertEqual((passed["true_movers_share"], passed["false"]), (1.0, []))
        self.assertEqual(passed["pairs"]["right"], 1)
        both = score["objects"]["followed_by_all"]
        self.assertEqual((both["objects"], both["passed"], both["in_time"]), (1, 1, 1))
        self.assertEqual((both["frames"], both["passed_frames"]), (9, 7))
        self.assertEqual(both["late_or_never"], [])
        visible = score["objects"]["visible_to_all"]
        self.assertEqual((visible["objects"], visible["passed_share"]), (1, 1.0))
        self.assertEqual((visible["frames"], visible["for_that_long"]["objects"]), (11, 1))
        self.assertIn("108", out)
        self.assertIn("100.0 % (1 of 1)", out)

    def test_too_late(self):
        members = ("lidar", 7), ("stereo", 4)
        self.write([track(7, 20.0, 0.5, SPEED)], [track(4, 21.5, 0.5, SPEED, range(2, 11))],
                   [track(1, 20.0, 0.0, SPEED, sources=members, sources_from=4)])  # fmt: skip
        out, _, score = self.run_tool("--soon", "0.1")
        both = score["objects"]["followed_by_all"]
        self.assertEqual((both["passed"], both["in_time"]), (1, 0))
        late = both["late_or_never"][0]
        self.assertEqual((late["id"], late["from_s"], late["to_s"]), (1, 1000.2, 1001.0))
        self.assertAlmostEqual(late["delay_s"], 0.2)
        self.assertAlmostEqual(late["median_distance_m"], 1.5)
        self.assertEqual(late["tracks"], [["lidar", 7], ["stereo", 4]])
        self.assertIn("0.20 s late, lidar 7 and stereo 4 1.5 m apart", out)

    def test_time_without_one_of_the_tracks_does_not_count(self):
        """The stereo camera tracks it in the first two frames, and again after 0.6 s."""
        members = ("lidar", 7), ("stereo", 4)
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 0.0, SPEED, (0, 1, 7, 8, 9, 10))],
                   [track(1, 20.0, 0.0, SPEED, sources=members, sources_from=9)])  # fmt: skip
        both = self.score("--soon", "0.31")["objects"]["followed_by_all"]
        self.assertEqual((both["frames"], both["passed_frames"], both["in_time"]), (6, 2, 1))
        both = self.score("--soon", "0.29")["objects"]["followed_by_all"]
        self.assertAlmostEqual(both["late_or_never"][0]["delay_s"], 0.3)

    def test_track_that_goes_over_to_another_object(self):
        """Two slow cars, 1.5 m apart; the stereo camera's track is on the first of them for 1 s,
        then on the other for 2 s. It was never of both, though within the gate of both."""
        cars = [car(1, 20.0, 0.0, 0.1), car(4, 20.0, 3.5, 0.1)]
        lidar = [track(7, 20.0, 0.0, frames=range(31)), track(8, 20.0, 3.5, frames=range(31))]

        def stereo(frame):
            return track(4, 20.0, 0.8 if frame < 10 else 2.7, frames=range(31))(frame)

        lists = {"/tracks/lidar": lidar, "/tracks/stereo": [stereo], "/tracks": []}
        write_run(self.bag, lists, cars, [view()], frames=31)
        both = self.score()["objects"]["followed_by_all"]
        self.assertEqual([(item["id"], item["frames"]) for item in both["late_or_never"]],
                         [(1, 10), (4, 21)])  # fmt: skip

    def test_two_tracks_of_one_source_each(self):
        """They remain two tracks: a ghost in each frame, and nothing has passed."""
        tracks = [track(1, 20.0, 0.0, SPEED, sources=(("lidar", 7),)),
                  track(2, 21.0, 0.0, SPEED, sources=(("stereo", 4),))]  # fmt: skip
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 21.0, 0.0, SPEED)], tracks)
        score = self.score()
        self.assertEqual(score["passed"]["true_movers_share"], None)
        both = score["objects"]["followed_by_all"]
        self.assertEqual((both["passed_share"], both["for_that_long"]["objects"]), (0.0, 1))
        self.assertEqual(both["late_or_never"][0]["delay_s"], None)
        never = score["objects"]["visible_to_all"]["never"][0]
        self.assertEqual((never["id"], never["followed_by_all"]), (1, True))
        self.assertEqual(never["followed_frames"], {"lidar": 11, "stereo": 11})
        self.assertEqual((score["ghosts"]["fused"]["ghosts"], score["ghosts"]["lidar"]["ghosts"]),
                         (11, 0))  # fmt: skip

    def test_parked_car_reported_as_moving(self):
        """False if only moving objects count, but on a real road user."""
        members = ("lidar", 8), ("stereo", 5)
        at = 15.0, 8.5
        self.write([track(8, *at)], [track(5, *at)], [track(2, *at, sources=members)])
        passed = self.score()["passed"]
        self.assertEqual((passed["judged"], passed["true_movers"], passed["true_road_users"]),
                         (1, 0, 1))  # fmt: skip
        false = passed["false"][0]
        self.assertEqual((false["id"], false["frames"], false["members"]),
                         (2, 11, [["lidar", 8], ["stereo", 5]]))  # fmt: skip
        self.assertEqual(false["position_m"], [15.0, 8.5])
        self.assertAlmostEqual(false["range_m"], math.hypot(*at), places=2)
        self.assertEqual(false["nearest"],
                         {"id": 2, "label": "Car", "moving": False, "distance_m": 0.0})  # fmt: skip

    def test_true_in_half_of_the_frames_that_count(self):
        """With both sensors it is on the car in 5 frames of 10, then in 6 of 10."""
        members = ("lidar", 8), ("stereo", 5)
        for frames, true in ((range(1, 6), 0), (range(1, 7), 1)):
            def at(frame, frames=frames):
                y = 0.0 if frame in frames else 5.0
                return track(1, 20.0, y, SPEED, sources=members, sources_from=1)(frame)

            self.write(fused=[at])
            self.assertEqual(self.score()["passed"]["true_movers"], true)

    def test_stationary_tracks_are_not_judged(self):
        members = ("lidar", 8), ("stereo", 5)
        self.write(fused=[track(2, 15.0, 8.5, sources=members, moving=False)])
        score = self.score()
        self.assertEqual((score["passed"]["tracks"], score["passed"]["judged"]), (1, 0))
        self.assertEqual(score["false"]["fused"]["all"], 0)

    def test_pair_of_two_objects(self):
        """The cars are side by side: the fused track is near both."""
        other = car(4, 20.0, 3.5, SPEED)
        members = ("lidar", 7), ("stereo", 4)
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 3.5, SPEED)],
                   [track(1, 20.0, 1.7, SPEED, sources=members)], [DRIVING, other])  # fmt: skip
        passed = self.score()["passed"]
        self.assertEqual((passed["true_movers"], passed["pairs"]["right"]), (1, 0))
        wrong = passed["pairs"]["wrong_pairs"][0]
        self.assertEqual((wrong["objects"], wrong["frames"]), ([1, 4], 11))

    def test_false_tracks_within_the_view(self):
        """One on the parked car, one on a pole, one on nothing, one behind the camera,
        and one that is right."""
        lidar = [track(1, 15.0, 8.5), track(2, 10.0, -8.0), track(3, 25.0, -20.0),
                 track(4, -10.0, 0.0), track(5, 20.0, 0.0, SPEED)]  # fmt: skip
        fused = [track(9, 15.0, 8.5, sources=(("lidar", 1),)), track(5, 20.0, 0.0, SPEED)]
        self.write(lidar, fused=fused)
        out, _, score = self.run_tool()
        false = score["false"]
        self.assertEqual((false["lidar"]["all"], false["lidar"]["in_view"]), (4, 3))
        self.assertEqual(false["lidar"]["by_what"], {"double": 0, "standing road user": 1,
                                                     "other object": 1, "nothing": 1})  # fmt: skip
        self.assertEqual((false["fused"]["in_view"], false["stereo"]["in_view"]), (1, 0))
        self.assertEqual((false["lidar"]["in_view_frames"], false["lidar"]["frames"]), (33, 11))
        self.assertAlmostEqual(false["reduction"], 2.0 / 3.0)
        self.assertAlmostEqual(false["frames_reduction"], 2.0 / 3.0)
        self.assertIn("track 9 of lidar 1 from 1000.00 s to 1001.00 s, 11 of 11 frames", out)

    def test_hidden_from_the_camera(self):
        self.write([track(3, 25.0, -20.0)], views=[view(reach=30.0)])
        false = self.score()["false"]["lidar"]
        self.assertEqual((false["in_view"], false["visible"]), (1, 0))
        self.write([track(3, 25.0, -20.0)], views=[view(reach=32.0)])
        self.assertEqual(self.score()["false"]["lidar"]["visible"], 1)

    def test_no_views(self):
        self.write([track(3, 25.0, -20.0)], views=[])
        out, _, score = self.run_tool()
        self.assertEqual((score["false"]["views"], score["false"]["reduction"]), (False, None))
        self.assertIn("has no views", out)

    def test_object_that_changes_its_track(self):
        self.write(fused=[track(1, 20.0, 0.0, SPEED, range(0, 5)),
                          track(2, 20.0, 0.0, SPEED, range(3, 11))])  # fmt: skip
        ghosts = self.score()["ghosts"]["fused"]
        self.assertEqual((ghosts["ghost_frames"], ghosts["id_switches"]), (2, 1))
        self.assertEqual(ghosts["objects"],
                         [{"id": 1, "label": "Car", "ghost_frames": 2, "id_switches": 1}])

    def test_labels_that_do_not_know_who_sees(self):
        """As in KITTI: objects outside the camera's view are neither counted for nor against."""
        members = ("lidar", 7), ("stereo", 4)
        self.write([track(7, 20.0, 0.0, SPEED), track(8, 0.0, 20.0)], [track(4, 20.0, 0.0, SPEED)],
                   [track(1, 20.0, 0.0, SPEED, sources=members)],
                   [car(1, 20.0, 0.0, SPEED, visible_to=())])  # fmt: skip
        score = self.score("--visible-to", "none", "--half-angle", "0.7")
        self.assertEqual(score["objects"]["followed_by_all"]["in_time_share"], 1.0)
        self.assertEqual(score["objects"]["visible_to_all"], None)
        self.assertEqual(score["false"]["lidar"]["all"], 0)

    def test_truth_of_another_bag(self):
        self.write(fused=[track(1, 20.0, 0.0, SPEED)])
        drive = self.bag.with_name("drive.bag")
        write_run(drive, {}, [car(1, 20.0, 8.0, SPEED)])
        self.assertEqual(self.score("--truth", str(drive))["false"]["fused"]["all"], 1)
        self.assertEqual(self.score()["false"]["fused"]["all"], 0)

    def test_bad_input(self):
        self.write()
        said = self.run_tool("--visible-to", "radar", code=1)[1]
        self.assertIn("no true object is visible to radar, only to scanner, stereo", said)
        for name in ("range", "gate", "soon", "half-angle"):
            self.assertIn(f"--{name} is 0", self.run_tool(f"--{name}", "0", code=1)[1])
        self.assertIn("no such file", self.run_tool("--truth", "/nowhere", code=1)[1])
        write_run(self.bag, {"/tracks": [], "/tracks/lidar": []}, [DRIVING])
        said = self.run_tool(code=1)[1]
        self.assertIn("nothing on /tracks/stereo, expected a bag of run_bag --track-fusion", said)
        with whole_bag(self.bag, "test") as bag:
            grid = OccupancyGrid(header=bag_messages.header(START, "map"))
            bag.write("/tracks", START, grid)
        self.assertIn("/tracks is nav_msgs/OccupancyGrid", self.run_tool(code=1)[1])


if __name__ == "__main__":
    unittest.main()
