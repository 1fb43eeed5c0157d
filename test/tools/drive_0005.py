# SPDX-License-Identifier: BSD-3-Clause
"""Where the recorded drive for the tests is, outside of the repository."""

import unittest
from pathlib import Path

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
DRIVE = DATA / "kitti_raw" / "2011_09_26" / "2011_09_26_drive_0005_sync"
LABELS = DATA / "kitti_tracking" / "label_02" / "0000.txt"

needs_drive_0005 = unittest.skipUnless(
    DRIVE.is_dir() and LABELS.is_file(), f"needs KITTI's drive 0005, which is not in {DATA}"
)
