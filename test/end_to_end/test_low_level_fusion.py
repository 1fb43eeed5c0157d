#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The simulated intersection with a stereo camera, with and without low-level fusion: what fusion
removes from the lidar's grids and adds to them, and the effect on the objects.
"""

import tempfile
import unittest
from pathlib import Path

from bounds import check, seeds
from scene_figures import low_level_fusion


class LowLevelFusion(unittest.TestCase):
    def test_paint_is_gone_and_obstacles_stay(self):
        for seed in seeds("low_level_fusion"):
            with tempfile.TemporaryDirectory() as folder:
                check(self, "low_level_fusion", seed, low_level_fusion(Path(folder), seed))


if __name__ == "__main__":
    unittest.main()
