#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Moving objects on the footpath and near the curb stay tracked although objects on and beyond road
borders are considered less likely to move (thesis 2.4): people who walk along the curb, away from
it and along a wall, one who steps on to the road, a car out of a driveway, cyclists. Several seeds
are used, so that the result does not depend on chance.
"""

import tempfile
import unittest
from pathlib import Path

from bounds import check, seeds
from scene_figures import footpath


class Footpath(unittest.TestCase):
    def test_nobody_is_lost(self):
        for seed in seeds("footpath"):
            with tempfile.TemporaryDirectory() as folder:
                check(self, "footpath", seed, footpath(Path(folder), seed))


if __name__ == "__main__":
    unittest.main()
