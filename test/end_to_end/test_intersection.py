#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The simulated intersection through the whole chain, against what is asked: every object that the
scanner sees moving for more than a second is found. With the seed of the committed bag and with
others, so that it is no matter of luck. And without odometry: the pose holds all the same.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import yaml
from datmo_tools.evaluate.metric_groups import OBJECT_METRICS, metric_groups
from evaluated_run import RUN_BAG, evaluated

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "rosbag_fixtures" / "scenes" / "intersection.yaml"
CONFIG = ROOT / "config" / "demonstrator.yaml"
SIMULATE = os.environ.get("SIMULATE", "simulate")

# What the scanner sees moving has to be found at any distance.
ASKED = ("truth/visible_to=scanner", "truth/min_time_seen=1.0", "region/range=500")
MIN_MOVERS = 6
MAX_POSE_ERROR = 0.01  # of the way
MAX_POSE_ERROR_WITHOUT_ODOMETRY = 0.02
SEEDS = (1, 2, 3)

# The scene has one intersection, and the stack does not yet say where it sees any.
NOT_MEASURED = {"thesis.intersections_found", "thesis.intersections_false"}


class Intersection(unittest.TestCase):
    def run_seed(self, folder, seed, config=CONFIG):
        """The score of the scene made with this seed."""
        recorded, computed = Path(folder) / "drive.bag", Path(folder) / "output.bag"
        subprocess.run(
            [SIMULATE, str(SCENE), str(recorded), "--seed", str(seed), "--quiet"], check=True
        )
        subprocess.run(
            [RUN_BAG, str(recorded), str(computed), "--config", str(config), "--quiet"], check=True
        )
        print(f"\nseed {seed}, {config.name}", flush=True)
        return evaluated(computed, recorded, ASKED, attainable=recorded)

    def test_every_mover_is_found(self):
        for seed in SEEDS:
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as folder:
                result = self.run_seed(folder, seed)
                self.assertGreaterEqual(len(result["objects"]), MIN_MOVERS)
                missed = [item["id"] for item in result["objects"] if not item["found"]]
                self.assertEqual(missed, [])
                self.assertLessEqual(result["pose"]["end_error_share"], MAX_POSE_ERROR)
                self.assert_all_is_measured(result)

    def test_pose_without_odometry(self):
        settings = yaml.safe_load(CONFIG.read_text())
        settings["motion"] = {"source": "none"}
        for seed in SEEDS:
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as folder:
                config = Path(folder) / "without_odometry.yaml"
                config.write_text(yaml.safe_dump(settings))
                pose = self.run_seed(folder, seed, config)["pose"]
                self.assertLessEqual(pose["end_error_share"], MAX_POSE_ERROR_WITHOUT_ODOMETRY)

    def assert_all_is_measured(self, result):
        """What evaluate shows is in what score_run writes, under the same names."""
        for group in metric_groups([result]):
            for metric in group.metrics:
                measured = metric.value(result) is not None
                self.assertNotEqual(measured, metric.path in NOT_MEASURED, metric.path)
        for metric in OBJECT_METRICS:
            self.assertTrue([item for item in result["objects"] if metric.value(item) is not None])


if __name__ == "__main__":
    unittest.main()
