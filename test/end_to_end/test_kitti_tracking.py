#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""PointRCNN's detections of ten KITTI tracking sequences through kitti_tracking_run and
kitti_tracking_score.

Published for the validation sequences, which these are not (Weng et al. 2020): 93.34, 82.73 and
93.78 % sAMOTA for cars, pedestrians and cyclists with ego poses. AB3DMOT as described in its paper,
and without ego poses, scores 88.0, 67.4 and 53.6 % on these ten.
"""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

RUN = os.environ.get("KITTI_TRACKING_RUN", "kitti_tracking_run")
SCORE = os.environ.get("KITTI_TRACKING_SCORE", "kitti_tracking_score")

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data" / "kitti_tracking"
CONFIG = ROOT / "config" / "kitti_tracking"

MIN_SAMOTA = {"Car": 0.92, "Pedestrian": 0.73, "Cyclist": 0.65}
MAX_ID_SWITCHES = {"Car": 15, "Pedestrian": 3, "Cyclist": 1}


@unittest.skipUnless(DATA.is_dir(), f"needs KITTI's tracking sequences, which are not in {DATA}")
class KittiTracking(unittest.TestCase):
    def run_all(self, results, *options):
        subprocess.run(
            [RUN, str(DATA / "pointrcnn"), str(DATA / "calib"), str(results)]
            + ["--config", str(CONFIG), *options],
            check=True,
        )

    def scores(self, results, folder, kind="all"):
        """By class, at an overlap of 0.25."""
        report = Path(folder) / "report.json"
        subprocess.run(
            [SCORE, str(DATA / "label_02"), str(results)]
            + ["--class", kind, "--iou", "0.25", "--out", str(report)],
            check=True,
        )
        return {score["class"]: score for score in json.loads(report.read_text(encoding="utf-8"))}

    def test_tracks_are_as_good_as_they_were(self):
        with tempfile.TemporaryDirectory() as folder:
            results = Path(folder) / "results"
            self.run_all(results)
            for kind, score in self.scores(results, folder).items():
                with self.subTest(kind=kind):
                    self.assertGreaterEqual(score["samota"], MIN_SAMOTA[kind])
                    self.assertLessEqual(score["best"]["id_switches"], MAX_ID_SWITCHES[kind])

    def test_the_vehicles_motion_helps(self):
        with tempfile.TemporaryDirectory() as folder:
            switches = {}
            for estimated in ("true", "false"):
                results = Path(folder) / estimated
                self.run_all(results, "--set", f"estimate_ego_motion={estimated}")
                score = self.scores(results, folder, "car")["Car"]
                switches[estimated] = score["best"]["id_switches"]
            self.assertLess(switches["true"], switches["false"])

    def test_the_same_input_gives_the_same_tracks(self):
        with tempfile.TemporaryDirectory() as folder:
            first, second = Path(folder) / "first", Path(folder) / "second"
            self.run_all(first)
            self.run_all(second)
            for file in sorted(first.glob("*.txt")):
                self.assertEqual(file.read_bytes(), (second / file.name).read_bytes(), file.name)


if __name__ == "__main__":
    unittest.main()
