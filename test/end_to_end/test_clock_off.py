#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One sensor's clock is set by 0.1 s while the others keep running, in the committed drive, as in
scripts/campaign: the pose is as accurate as without the step."""

import json
import os
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments.campaign import main

ROOT = Path(__file__).resolve().parents[2]
MAX_ADDED = 0.1  # m, at the end of the drive; without the correction 1.3 m and more


class ClockOff(unittest.TestCase):
    def test_the_pose_is_as_accurate_as_with_a_correct_clock(self):
        with tempfile.TemporaryDirectory() as name:
            report = Path(name) / "report.json"
            code = main([str(ROOT / "rosbag_fixtures/intersection.bag"),
                         "--config", str(ROOT / "config/demonstrator.yaml"),
                         "--programs", str(Path(os.environ["RUN_BAG"]).parent),
                         "--bounds", str(ROOT / "test/campaign/fault_bounds.yaml"),
                         "--page", str(Path(name) / "page.md"), "--out", str(report),
                         "--faults", "scan clock 0.1 s", "odometry clock 0.1 s"])  # fmt: skip
            self.assertEqual(code, 0, "within the campaign's bounds")
            clean, *faulty = json.loads(report.read_text(encoding="utf-8"))["drives"][0]["runs"]
        self.assertEqual(len(faulty), 4, "of each sensor, ahead and behind")
        for run in faulty:
            self.assertIsNone(run["error"], run["fault"])
            self.assertGreaterEqual(run["pose"]["poses"], clean["pose"]["poses"] - 5, run["fault"])
            self.assertLess(run["pose"]["final_error_m"], clean["pose"]["final_error_m"] + MAX_ADDED, run["fault"])


if __name__ == "__main__":
    unittest.main()
