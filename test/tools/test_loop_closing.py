#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""loop_closing without the stack: errors of a path, the table, rejected input."""

import contextlib
import io
import math
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments.loop_closing import errors, loop_figures, main, table
from datmo_tools.pose_path import PosePath


class LoopClosing(unittest.TestCase):
    def test_errors_are_those_after_the_first_pose(self):
        truth = PosePath([0, 10, 20], [[5, 5, 0], [15, 5, 0], [25, 5, 0]])
        path = PosePath([0, 10, 20], [[0, 0, math.pi / 2], [0, 10, math.pi / 2], [3, 20, 1.5]])
        found = errors(path, truth)
        self.assertAlmostEqual(found["end_m"], 3.0)
        self.assertAlmostEqual(found["end_share"], 3.0 / 20.0)
        self.assertAlmostEqual(found["end_deg"], math.degrees(math.pi / 2 - 1.5))
        self.assertAlmostEqual(found["max_m"], 3.0)

    def test_both_paths_are_in_the_table(self):
        scored = {"end_m": 3.0, "end_deg": 2.0, "end_share": 0.0125, "max_m": 4.0}
        time = {stage: {"mean_s": 0.0015} for stage in ("grid_slam", "loop_closing")}
        loops = {"closed": 12, "false": 1, "max_m": 0.625, "max_deg": None}
        text = table([{"seed": 7, "live pose": scored, "with loops closed": scored, "loops": loops,
                       "time": time}])  # fmt: skip
        self.assertRegex(text, r"7 +live pose +3\.000 +1\.250 +2\.000 +4\.00")
        self.assertRegex(text, r"7 +with loops closed +3\.000.* 12 +1 +0\.62 +-")
        self.assertIn("loop_closing: 1.50 ms a scan", text)

    def test_a_loop_that_is_far_off_is_false(self):
        second = 1_000_000_000
        truth = PosePath([5 * second, 15 * second], [[0, 0, math.pi / 2], [0, 10, math.pi / 2]])
        loop = {"from_s": 1.0, "to_s": 9.0, "x_m": 8.0, "y_m": 0.0, "heading_rad": 0.0}
        loops = [loop, {**loop, "y_m": 0.4}, {**loop, "x_m": 8.6}, {**loop, "heading_rad": 0.1}]
        found = loop_figures({"closed": loops, "refuted": 3}, 5 * second, truth)
        self.assertEqual((found["closed"], found["false"], found["refuted"]), (4, 2, 3))
        self.assertAlmostEqual(found["max_m"], 0.6)
        self.assertAlmostEqual(found["max_deg"], math.degrees(0.1))
        self.assertIsNone(loop_figures({"closed": []}, 0, truth)["max_m"])

    def test_a_missing_scene_is_refused(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as name, contextlib.redirect_stderr(said):
            scene = Path(name) / "none.yaml"
            words = [str(scene), "--programs", name, "--config", str(scene)]
            self.assertEqual(main(words), 1)
        self.assertIn("none.yaml: no such file", said.getvalue())


if __name__ == "__main__":
    unittest.main()
