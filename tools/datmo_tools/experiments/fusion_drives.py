# SPDX-License-Identifier: BSD-3-Clause
"""The drives and the levels of fusion that compare_fusion runs."""

from pathlib import Path
from typing import NamedTuple, Optional

from datmo_tools.evaluate.thesis_tables import PUBLISHED, Published
from datmo_tools.experiments import simulated_run
from datmo_tools.programs import call

# By name, the words for run_bag.
LEVELS = {
    "none": (),
    "low": ("--low-level-fusion",),
    "object": ("--object-fusion",),
    "track": ("--track-fusion",),
    "low+object": ("--low-level-fusion", "--object-fusion"),
    "low+track": ("--low-level-fusion", "--track-fusion"),
    "object+track": ("--object-fusion", "--track-fusion"),
    "low+object+track": ("--low-level-fusion", "--object-fusion", "--track-fusion"),
}

# All objects count that were seen moving, as in the thesis, also those gone in a moment: by the
# scanner, so that all levels have the same to find, and by any sensor.
BY_SCANNER = ("truth/min_time_seen=0", "truth/visible_to=scanner")
BY_ANY = ("truth/min_time_seen=0", "truth/visible_to=any")

# Labels know the camera's view alone, and not which sensor sees what: all that moves in it counts.
LABELED = ("truth/min_time_seen=0", "truth/visible_to=none", "region/range=500",
            "region/half_angle=0.7")  # fmt: skip

# The GPS/IMU's odometry is better than wheels': 3 % too long, and 0.5 deg/s too much to the left.
ODOMETRY_ERRORS = ("--odometry-scale-error", "0.03", "--odometry-yaw-bias", "0.5")


class Simulated(NamedTuple):
    """One of the data sets of thesis table 3.1."""

    scene: Path
    config: Path
    published: Optional[Published]
    score_options: tuple = BY_SCANNER
    wide_score_options: Optional[tuple] = BY_ANY

    @property
    def name(self):
        """Of its folder, and in the table."""
        return self.scene.stem

    def record(self, programs, bag):
        """Simulates it with the stereo camera into a bag (Path)."""
        drive = simulated_run.SimulatedDrive(self.scene, ("stereo/enabled=true",))
        simulated_run.record(drive, programs, bag)


class Kitti(NamedTuple):
    """A labeled KITTI raw drive."""

    folder: Path  # ..._drive_NUMBER_sync
    config: Path
    published: Optional[Published] = None
    score_options: tuple = LABELED
    wide_score_options: Optional[tuple] = None

    @property
    def name(self):
        """As Simulated's."""
        return self.folder.name

    def record(self, programs, bag):
        """Converts it with its stereo images to a bag (Path)."""
        call(programs / "kitti_to_bag", self.folder, bag, "--images", *ODOMETRY_ERRORS)


def data_sets(scenes, config, numbers):
    """Simulated drives: those of these numbers (from 1) in the folder of scenes (Path)."""
    return [
        Simulated(scenes / f"data_set_{number}.yaml", config, PUBLISHED[number - 1])
        for number in numbers
    ]


def within(view, score_options):
    """The same words for score_run, with a CameraView as the region that is scored."""
    others = [word for word in score_options if not word.startswith("region/")]
    return (*others, f"region/range={view.range}", f"region/half_angle={view.half_angle}")
