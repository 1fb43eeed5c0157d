#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate borders on drives of two seconds whose score is worked out by hand."""

import math
import unittest

from datmo_tools.evaluate.border_tally import BANDS

from evaluate_case import EvaluateCase
from border_samples import CURBS, along, border, left, parked, right, write_drive
from datmo_fusion.msg import RoadBorder

NEAR, WHOLE = BANDS.index((0.0, 20.0)), -1
STATIONS = 21 * 100  # of one side, in all frames


class Tool(EvaluateCase):
    def setUp(self):
        super().setUp()
        self.bag = self.folder / "run.bag"

    def run_tool(self, *words, code=0):
        return self.evaluate("borders", self.bag, *words, code=code)

    def score(self, *borders, options=(), **drive):
        write_drive(self.bag, borders, **drive)
        return self.run_tool(*options)[2]

    def test_errors_of_straight_borders(self):
        """The left one is 0.2 m too far out, the right one 0.1 m too far in."""
        score = self.score(left(5.2), right(-4.9))
        on_left, on_right = (score["borders"][name][WHOLE] for name in ("left", "right"))
        self.assertEqual((on_left["stations"], on_left["found_share"]), (STATIONS, 1.0))
        self.assertAlmostEqual(on_left["mean_m"], 0.2, 4)
        self.assertAlmostEqual(on_right["mean_m"], -0.1, 4)
        self.assertAlmostEqual(on_left["mean_nees"], 1.0, 3)
        self.assertAlmostEqual(on_right["median_nees"], 0.25, 3)
        both = score["borders"]["all"]
        self.assertAlmostEqual(both[NEAR]["rms_m"], math.sqrt(0.5 * (0.04 + 0.01)), 4)
        self.assertAlmostEqual(both[NEAR]["quantile_90_m"], 0.2, 4)
        self.assertEqual((both[NEAR]["near_share"], both[NEAR]["in_gate_95"]), (1.0, 1.0))
        self.assertEqual(score["borders"]["curve"][WHOLE]["stations"], 0)
        self.assertEqual(score["false"]["false_m"], 0.0)

    def test_each_range_has_its_own_figures(self):
        """A right border that ends at x = 45.2 m; the vehicle comes from x = 0 m to x = 20 m."""
        bands = self.score(right(-5.0, last=45.2))["borders"]["right"]
        self.assertEqual([item["found_share"] for item in bands[:3]], [1.0, 1.0, 1.0])
        self.assertEqual({item["stations"] for item in bands[1:5]}, {21 * 20})
        # Of 20 stations each: all in 16 frames, then 19, 17, ..., 11; all in 6, then 19, 17, ...,
        # 1.
        self.assertAlmostEqual(bands[3]["found_share"], (16 * 20 + 75) / 420)
        self.assertAlmostEqual(bands[4]["found_share"], (6 * 20 + 100) / 420)

    def test_nothing_published(self):
        score = self.score()
        both = score["borders"]["all"][WHOLE]
        self.assertEqual((both["stations"], both["found_share"]), (2 * STATIONS, 0.0))
        self.assertEqual((both["rms_m"], both["mean_nees"]), (None, None))
        self.assertEqual(score["false"]["false_share"], None)

    def test_side_without_curb_is_not_evaluated(self):
        score = self.score(right(-5.0), curbs=CURBS[1:])
        self.assertEqual(score["borders"]["left"][WHOLE]["stations"], 0)
        self.assertEqual(score["borders"]["all"][WHOLE]["found_share"], 1.0)

    def test_far_off_is_counted_by_itself(self):
        on_left = self.score(left(9.0))["borders"]["left"][WHOLE]
        self.assertEqual((on_left["beyond_gate"], on_left["found_share"]), (STATIONS, 0.0))
        self.assertEqual(on_left["rms_m"], None)
        on_left = self.score(left(9.0), options=["--gate", "5"])["borders"]["left"][WHOLE]
        self.assertAlmostEqual(on_left["rms_m"], 4.0, 4)

    def test_row_of_parked_cars_ends_the_road(self):
        """Faces at y = -3 m from x = -38 m to x = 88 m, bridged over 2 m from car to car."""
        row = [parked(i + 1, -36.0 + 6.0 * i, -4.0) for i in range(21)]
        on_right = self.score(right(-3.0), objects=row)["borders"]["right"][WHOLE]
        self.assertAlmostEqual(on_right["rms_m"], 0.0, 4)
        self.assertAlmostEqual(on_right["curb_rms_m"], 2.0, 4)
        on_right = self.score(right(-5.0), objects=row)["borders"]["right"][WHOLE]
        self.assertAlmostEqual(on_right["mean_m"], 2.0, 4)
        self.assertAlmostEqual(on_right["curb_rms_m"], 0.0, 4)
        unbridged = self.score(right(-5.0), objects=row, options=["--bridged", "0"])
        self.assertAlmostEqual(unbridged["borders"]["right"][WHOLE]["near_share"], 1.0 / 3.0, 2)

    def test_curve(self):
        """To the left round a center 100 m away, at 10 m/s."""
        turned = [0.01 * i for i in range(21)]
        trajectory = along(*((100.0 * math.sin(a), 100.0 * (1.0 - math.cos(a)), a) for a in turned))

        def arc(radius):
            angles = [0.005 * i for i in range(-200, 301)]
            return [(radius * math.sin(a), 100.0 - radius * math.cos(a)) for a in angles]

        curbs = [arc(95.0), arc(105.0)]
        score = self.score(border(RoadBorder.LEFT, *arc(95.3)), curbs=curbs, trajectory=trajectory)
        curve = score["borders"]["curve"]
        self.assertEqual(score["borders"]["straight"][WHOLE]["stations"], 0)
        self.assertAlmostEqual(curve[1]["mean_m"], -0.3, 2)
        self.assertAlmostEqual(curve[1]["found_share"], 0.5)
        score = self.score(curbs=curbs, trajectory=trajectory, options=["--curve-radius", "80"])
        self.assertEqual(score["borders"]["curve"][WHOLE]["stations"], 0)

    def test_junction_is_not_evaluated(self):
        """The vehicle is in it from x = 5 m to x = 10 m; 1 m before and after belong to it."""
        score = self.score(left(5.0), right(-5.0), at_intersection=range(5, 11))
        # 15 stations of a side, of which the last frames have 13, 11, ..., 3 in their range.
        left_out = 15 * 15 + 48
        self.assertEqual(score["borders"]["all"][WHOLE]["stations"], 2 * (STATIONS - left_out))

    def test_border_of_a_side_street(self):
        """It lies across the path, and is no border along it."""
        street = border(RoadBorder.RIGHT, (10.0, -5.0), (10.0, -20.0), side_street=True)
        on_right = self.score(street)["borders"]["right"][WHOLE]
        self.assertEqual(on_right["published"], 0)

    def test_false_borders(self):
        """Of 40 m of one on the road, and of one beyond the curb; one where no curb is."""
        score = self.score(left(2.0, 0.0, 40.0), right(-9.0, 0.0, 40.0))["false"]
        self.assertEqual(score["false_share"], 1.0)
        self.assertEqual(score["lists_with_false"], 21)
        self.assertAlmostEqual(score["by_where_m"]["road"], score["by_where_m"]["beyond"], -1)
        self.assertEqual([(item["side"], item["where"]) for item in score["episodes"]],
                         [("left", "road"), ("right", "beyond")])  # fmt: skip
        self.assertEqual(score["episodes"][0]["lists"], 21)
        score = self.score(left(5.0, 0.0, 40.0), curbs=CURBS[1:])["false"]
        self.assertEqual(score["by_where_m"]["open"], score["false_m"])
        self.assertGreater(score["false_m"], 0.0)

    def test_false_border_in_a_junction(self):
        """Curbs are open from x = 0 to x = 20 m, and a border continues over the opening."""
        curbs = [((-100.0, y), (0.0, y)) for y in (5.0, -5.0)]
        curbs += [((20.0, y), (200.0, y)) for y in (5.0, -5.0)]
        score = self.score(left(5.0), curbs=curbs, at_intersection=range(21))["false"]
        self.assertEqual(score["by_where_m"]["junction"], score["false_m"])
        self.assertAlmostEqual(score["episodes"][0]["longest_m"], 20.0 - 2.0 * 1.5, 0)

    def test_truth_of_another_bag(self):
        write_drive(self.bag, [left(5.0)])
        drive = self.bag.with_name("drive.bag")
        write_drive(drive, None, curbs=[((-100.0, 6.0), (200.0, 6.0))])
        score = self.run_tool("--truth", str(drive), "--found-within", "1.1")[2]
        self.assertAlmostEqual(score["borders"]["left"][WHOLE]["mean_m"], -1.0, 4)

    def test_table(self):
        write_drive(self.bag, [left(5.2), right(-9.0)])
        out = self.run_tool()[0]
        self.assertIn("found, %", out)
        self.assertRegex(out, r"left +100\.0 of 420")
        self.assertIn("right, beyond", out)

    def test_bad_input(self):
        write_drive(self.bag, None)
        said = self.run_tool(code=1)[1]
        self.assertIn("nothing on /road_borders, expected a bag of run_bag --road-border", said)
        for name in ("gate", "found-within", "false-from", "curve-radius", "car-length"):
            self.assertIn(f"--{name} is 0", self.run_tool(f"--{name}", "0", code=1)[1])
        self.assertIn("--bridged is -1", self.run_tool("--bridged", "-1", code=1)[1])
        write_drive(self.bag, [border(RoadBorder.LEFT, (0.0, 5.0))])
        self.assertIn("with 1 points and 1 sigmas", self.run_tool(code=1)[1])
        write_drive(self.bag, [border(2, (0.0, 5.0), (9.0, 5.0))])
        self.assertIn("a border of side 2", self.run_tool(code=1)[1])
        write_drive(self.bag, [left(math.nan)])
        self.assertIn("a border is not finite", self.run_tool(code=1)[1])
        write_drive(self.bag, [left(5.0)])
        self.assertIn("no such file", self.run_tool("--truth", "/nowhere", code=1)[1])


if __name__ == "__main__":
    unittest.main()
