#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""KITTI's drive 0005 through the whole chain, from folder to tracks, against the requirements.

The scanner is emulated from the Velodyne (see kitti_to_bag --help), with beams every two degrees
and every degree. The requirements on the cyclist and the van apply to every cyclist and vehicle
that moves and is labeled in nearly every frame.
"""

import tempfile
import unittest
from pathlib import Path

from bounds import check
from drive_0005 import needs_drive_0005
from recorded_figures import RECORDINGS


@needs_drive_0005
class Drive(unittest.TestCase):
    def check_scene(self, scene):
        with tempfile.TemporaryDirectory() as folder:
            check(self, scene, 1, RECORDINGS[scene](Path(folder), 1))

    def test_two_degrees(self):
        self.check_scene("drive_0005_2_degrees")

    def test_one_degree(self):
        self.check_scene("drive_0005_1_degree")


if __name__ == "__main__":
    unittest.main()
