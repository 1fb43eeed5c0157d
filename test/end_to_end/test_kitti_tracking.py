#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""PointRCNN's detections of ten KITTI tracking sequences through kitti_tracking_run and
kitti_tracking_score.

Published for the validation sequences, which these are not (Weng et al. 2020): 93.34, 82.73 and
93.78 % sAMOTA for cars, pedestrians and cyclists with ego poses. AB3DMOT as described in its paper,
and without ego poses, scores 88.0, 67.4 and 53.6 % on these ten.
"""

import tempfile
import unittest
from pathlib import Path

from bounds import check
from recorded_figures import TRACKING, kitti_tracking, run_tracking, tracking_scores


@unittest.skipUnless(TRACKING.is_dir(), f"needs KITTI's tracking sequences, which are not in {TRACKING}")
class KittiTracking(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_tracks_are_as_good_as_they_were(self):
        check(self, "kitti_tracking", 1, kitti_tracking(self.folder, 1))

    def test_the_vehicles_motion_helps(self):
        switches = {}
        for estimated in ("true", "false"):
            results = self.folder / estimated
            run_tracking(results, options=("--set", f"estimate_ego_motion={estimated}"))
            score = tracking_scores(results, self.folder, "car")["Car"]
            switches[estimated] = score["best"]["id_switches"]
        self.assertLess(switches["true"], switches["false"])

    def test_the_same_input_gives_the_same_tracks(self):
        first, second = self.folder / "first", self.folder / "second"
        run_tracking(first)
        run_tracking(second)
        for file in sorted(first.glob("*.txt")):
            self.assertEqual(file.read_bytes(), (second / file.name).read_bytes(), file.name)


if __name__ == "__main__":
    unittest.main()
