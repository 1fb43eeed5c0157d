#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The simulated intersection with a stereo camera, with and without low-level fusion: what fusion
takes from the lidar's grids and adds to them, and what comes of it in the objects.
"""

import subprocess
import tempfile
import unittest
from pathlib import Path

from datmo_tools.evaluate.grids import score, sections
from datmo_tools.evaluate.report import as_text
from evaluated_run import RUN_BAG, evaluated
from test_intersection import ASKED, CONFIG, MAX_POSE_ERROR, SCENE, SIMULATE

IN_VIEW = 1  # column of evaluate grids

MIN_PAINT_GONE = 75.0  # percent of the false cells
MAX_OBSTACLES_LOST = 2.0  # percent of the true ones
MIN_POLES = 90.0  # percent of the thin ones in the camera's view, scan by scan
MAX_FALSE_MOVERS_SHARE = 0.5  # of those without fusion


def run_stack(recorded, computed, *options):
    """The score of a run with these options of run_bag."""
    subprocess.run(
        [RUN_BAG, str(recorded), str(computed), "--config", str(CONFIG), "--quiet", *options],
        check=True,
    )
    print(f"\n{options}", flush=True)
    return evaluated(computed, recorded, ASKED)


class LowLevelFusion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as name:
            recorded, alone, fused = (Path(name) / f"{i}.bag" for i in ("drive", "alone", "fused"))
            subprocess.run(
                [SIMULATE, str(SCENE), str(recorded), "--quiet", "--set", "stereo/enabled=true",
                 "--set", "ground_truth/echoes=true"], check=True)  # fmt: skip
            cls.alone = run_stack(recorded, alone)
            cls.fused = run_stack(recorded, fused, "--low-level-fusion", "--write-grids")
            cls.grids = score(fused, recorded)
            print(f"\n{as_text(sections(cls.grids))}", flush=True)

    def percent(self, row):
        """Of a row of evaluate grids, in the camera's view."""
        self.assertGreater(self.grids[row]["of"][IN_VIEW], 0)
        return self.grids[row]["percent"][IN_VIEW]

    def test_every_scan_has_its_fused_grid(self):
        self.assertEqual(self.grids["scans_scored"], self.grids["scans_with_truth"])

    def test_paint_is_gone(self):
        self.assertGreaterEqual(self.percent("paint_gone"), MIN_PAINT_GONE)

    def test_obstacles_stay(self):
        self.assertLessEqual(self.percent("bodies_lost"), MAX_OBSTACLES_LOST)

    def test_thin_poles_are_added(self):
        self.assertGreaterEqual(self.percent("poles_in_fused"), MIN_POLES)
        self.assertLess(self.percent("poles_in_lidar"), self.percent("poles_in_fused"))

    def test_false_moving_objects_are_fewer(self):
        alone, fused = (
            run["thesis"]["false_moving_objects_frames"] for run in (self.alone, self.fused)
        )
        self.assertLessEqual(fused, MAX_FALSE_MOVERS_SHARE * alone)

    def test_no_more_is_missed(self):
        missed = [
            sum(not item["found"] for item in run["objects"]) for run in (self.alone, self.fused)
        ]
        self.assertLessEqual(missed[1], missed[0])

    def test_pose(self):
        self.assertLessEqual(self.fused["pose"]["end_error_share"], MAX_POSE_ERROR)


if __name__ == "__main__":
    unittest.main()
