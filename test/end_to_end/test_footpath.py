#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What moves on the footpath and near the curb stays tracked when what lies on the road's borders
and beyond is taken to be less likely to move (thesis 2.4): people who walk along the curb, away from it and along a wall, one
who steps on to the road, a car out of a driveway, cyclists. With several seeds, so that it is no
matter of luck.
"""

import tempfile
import unittest

from datmo_tools.evaluate.border_comparison import comparison_table
from datmo_tools.evaluate.compare_borders import compare
from evaluated_run import SCORE_RUN
from road_border_run import computed, simulated

SEEDS = (1, 2)

MIN_TRACKED = 14  # of 15 that move
MIN_REDUCTION = 0.5  # of false moving objects, all and in a scan
# Whose few beams hardly show that he moves may need more of them where most things stand.
CLEARLY_TRACKED = 0.05  # of the frames of one who moves
MIN_FRAMES_KEPT = 0.85  # of the frames in which one of the moving objects is tracked


class Footpath(unittest.TestCase):
    def test_nobody_is_lost(self):
        for seed in SEEDS:
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as folder:
                recorded = simulated(folder, "footpath", seed)
                alone, bordered = computed(recorded), computed(recorded, "--road-border")
                result = compare(alone, bordered, program=SCORE_RUN)
                print(f"\nseed {seed}\n{comparison_table(result)}", flush=True)
                tracked = [item["tracked_frames"]["without"] > 0 for item in result["objects"]]
                self.assertGreaterEqual(sum(tracked), MIN_TRACKED)
                clearly = [item["id"] for item in result["objects"]
                           if item["tracked_frames"]["without"] > CLEARLY_TRACKED * item["required_frames"]]
                self.assertEqual(set(result["lost"]) & set(clearly), set())
                frames = result["tracked_frames"]
                self.assertGreaterEqual(frames["with"], MIN_FRAMES_KEPT * frames["without"])
                for key in ("false_moving_objects_episodes", "false_moving_objects_frames"):
                    self.assertGreaterEqual(result["reduction"][key], MIN_REDUCTION, key)
                self.assertLessEqual(result["with"]["false_tracks"],
                                     result["without"]["false_tracks"])  # fmt: skip


if __name__ == "__main__":
    unittest.main()
