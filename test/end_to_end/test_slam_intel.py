#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Intel Research Lab of the SLAM benchmark through carmen_to_bag, run_bag and evaluate slam.

Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", 2009, published for this log: scan
matching 0.220 m, Rao-Blackwellized particle filter 0.070 m, graph mapping 0.031 m.
"""

import os
import unittest
from pathlib import Path

from datmo_tools.convert.carmen_bag import Options
from datmo_tools.experiments.slam_benchmark import benchmark, find_pairs, table

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data" / "slam2d"
CONFIG = ROOT / "config" / "indoor.yaml"
PROGRAMS = Path(os.environ.get("RUN_BAG", "run_bag")).parent

ODOMETRY = (7.370, 14.349)  # m: mean and standard deviation, the known figure
MAX_TRANSLATION = 0.020  # m, mean; ours is 0.017, the published particle filter 0.070
MAX_TRANSLATION_WITH_LOOPS = 0.020  # m, mean; ours is 0.015, published graph mapping 0.031
MIN_RELATIONS_WITH_LOOPS = 2960  # those in a gap, where the pose is not known, have no pose
RELATIONS = 2984


@unittest.skipUnless(
    (DATA / "intel.relations").is_file(), f"needs the Intel Research Lab, which is not in {DATA}"
)
class Intel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        (pair,) = [pair for pair in find_pairs(DATA) if pair[1].stem == "intel"]
        cls.result = benchmark(*pair, PROGRAMS, CONFIG, Options(clock="order"))
        print(f"\n{table([cls.result])}", flush=True)

    def test_every_relation_counts(self):
        for path in ("odometry", "pose"):
            self.assertEqual(self.result[path]["used"], RELATIONS)

    def test_metric_gives_the_known_figure_of_the_odometry(self):
        scored = self.result["odometry"]["translation_m"]
        self.assertAlmostEqual(scored["mean"], ODOMETRY[0], places=3)
        self.assertAlmostEqual(scored["std"], ODOMETRY[1], places=3)

    def test_pose(self):
        self.assertLessEqual(self.result["pose"]["translation_m"]["mean"], MAX_TRANSLATION)

    def test_loops_closed(self):
        scored = self.result["loops_closed"]
        self.assertLessEqual(scored["translation_m"]["mean"], MAX_TRANSLATION_WITH_LOOPS)
        self.assertLess(scored["translation_m"]["mean"], self.result["pose"]["translation_m"]["mean"])
        self.assertGreaterEqual(scored["used"], MIN_RELATIONS_WITH_LOOPS)


if __name__ == "__main__":
    unittest.main()
