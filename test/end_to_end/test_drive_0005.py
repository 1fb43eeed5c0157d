#!/usr/bin/python3
"""KITTI's drive 0005 through the whole chain, from folder to tracks, against what is asked.

The scanner is emulated from the Velodyne (see kitti_to_bag --help); the odometry is 3 % too long
and turns 0.5 deg/s too much. What is asked of "the cyclist" and of "the van" is asked of every
cyclist and vehicle that moves and is labelled in nearly every frame; the objects are picked by
that, not by their ids.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from datmo_tools.kitti_to_bag import main as kitti_to_bag
from drive_0005 import DRIVE, needs_drive_0005
from score_drive import score, table

CONFIG = Path(__file__).resolve().parents[2] / "config" / "kitti.yaml"
RUN_BAG = os.environ.get("RUN_BAG", "run_bag")
ODOMETRY_ERRORS = ("--odometry-scale-error", "0.03", "--odometry-yaw-bias", "0.5")

MAX_SHARE_OF_ODOMETRY_ERROR = 0.25
MAX_SHARE_OF_DISTANCE = 0.01
WHOLE_DRIVE = 0.9  # share of the frames in which an object of the whole drive is labelled
MIN_CYCLIST_SHARE = 0.95
MAX_IDS = 2
MAX_PARKED_MOVING_SHARE = 0.05


def is_cyclist(item):
    """Whether an ObjectScore is a cyclist's."""
    return item.label == "Cyclist"


def run_drive(folder, resolution):
    """DriveScore of the drive with beams every `resolution` degrees; prints its table."""
    recorded, computed = Path(folder) / "drive.bag", Path(folder) / "output.bag"
    if (
        kitti_to_bag(
            [str(DRIVE), str(recorded), "--scan-resolution", str(resolution), *ODOMETRY_ERRORS]
        )
        != 0
    ):
        raise RuntimeError("kitti_to_bag failed")
    subprocess.run(
        [RUN_BAG, str(recorded), str(computed), "--config", str(CONFIG), "--quiet"], check=True
    )
    result = score(recorded, computed)
    print(f"\nbeams every {resolution} degrees\n{table(result)}", flush=True)
    return result


class Figures:
    """The issue's figures; the classes below say for which scanner."""

    resolution = None  # degrees
    min_vehicle_share = None

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.result = run_drive(folder, cls.resolution)

    def whole_drive(self, wanted):
        """Objects that move, labelled through the whole drive; at least one, or all is void."""
        tracking = self.result.tracking
        found = [
            item
            for item in tracking.objects
            if wanted(item) and item.moving_frames >= WHOLE_DRIVE * tracking.frames
        ]
        self.assertTrue(found)
        return found

    def test_pose(self):
        self.assertLessEqual(
            self.result.pose_error, MAX_SHARE_OF_ODOMETRY_ERROR * self.result.odometry_error
        )
        self.assertLessEqual(self.result.pose_error, MAX_SHARE_OF_DISTANCE * self.result.distance)

    def test_cyclist_keeps_its_id(self):
        for item in self.whole_drive(is_cyclist):
            self.assertLessEqual(len(item.track_frames), MAX_IDS)

    def test_vehicle_is_tracked(self):
        for item in self.whole_drive(lambda item: item.is_vehicle):
            self.assertGreaterEqual(item.tracked_share, self.min_vehicle_share)
            self.assertLessEqual(len(item.track_frames), MAX_IDS)

    def test_parked_cars_do_not_move(self):
        parked = [item for item in self.result.tracking.objects if item.is_parked]
        self.assertTrue(parked)
        for item in parked:
            self.assertLessEqual(
                item.reported_moving_share, MAX_PARKED_MOVING_SHARE, f"object {item.number}"
            )


@needs_drive_0005
class TwoDegrees(Figures, unittest.TestCase):
    resolution = 2.0
    min_vehicle_share = 0.75

    def test_cyclist_is_tracked(self):
        """Asked of this scanner alone; of the finer one the share is printed."""
        for item in self.whole_drive(is_cyclist):
            self.assertGreaterEqual(item.tracked_share, MIN_CYCLIST_SHARE)


@needs_drive_0005
class OneDegree(Figures, unittest.TestCase):
    resolution = 1.0
    min_vehicle_share = 0.85


if __name__ == "__main__":
    unittest.main()
