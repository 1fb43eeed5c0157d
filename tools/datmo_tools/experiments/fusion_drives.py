# SPDX-License-Identifier: BSD-3-Clause
"""The drives and the levels of fusion that compare_fusion runs."""

from pathlib import Path
from typing import NamedTuple, Optional

from datmo_tools.evaluate.thesis_tables import PUBLISHED, Published
from datmo_tools.experiments import simulated_run
from datmo_tools.programs import call

LOW, OBJECT, TRACK = (f"--{level}-fusion" for level in ("low-level", "object", "track"))
BORDERS = "--road-border"

# By name, the words for run_bag; `recommended` is the one of launch files and run_bag.
LEVELS = {
    "none": (),
    "low": (LOW,),
    "object": (OBJECT,),
    "track": (TRACK,),
    "none+borders": (BORDERS,),
    "low+borders": (LOW, BORDERS),
    "object+borders": (OBJECT, BORDERS),
    "recommended": ("--fusion", "recommended"),
}

# Several at once, on request.
COMBINATIONS = {
    "low+object": (LOW, OBJECT),
    "low+track": (LOW, TRACK),
    "object+track": (OBJECT, TRACK),
    "low+object+track": (LOW, OBJECT, TRACK),
}

# All objects that were seen moving count, as in the thesis, also those visible only for a moment:
# by the scanner, so that all levels have to find the same, and by any sensor.
BY_SCANNER = ("truth/min_time_seen=0", "truth/visible_to=scanner")
BY_ANY = ("truth/min_time_seen=0", "truth/visible_to=any")

# Labels cover only the camera's view, and not which sensor sees what: all that moves in it counts.
LABELED = ("truth/min_time_seen=0", "truth/visible_to=none", "region/range=500",
            "region/half_angle=0.7")  # fmt: skip

# The GPS/IMU's odometry is better than a wheel's: here 3 % too long, and 0.5 deg/s too much to the
# left.
ODOMETRY_ERRORS = ("--odometry-scale-error", "0.03", "--odometry-yaw-bias", "0.5")


class Simulated(NamedTuple):
    """One of the data sets of thesis table 3.1, driven with one seed."""

    scene: Path
    config: Path
    published: Optional[Published]
    seed: int
    score_options: tuple = BY_SCANNER
    wide_score_options: Optional[tuple] = BY_ANY

    @property
    def name(self):
        """Returns the name in the table, the same for all seeds."""
        return self.scene.stem

    @property
    def folder_name(self):
        """Returns the name of this seed's folder."""
        return f"{self.scene.stem}_{self.seed}"

    def record(self, programs, bag):
        """Simulates it with the stereo camera into a bag (Path)."""
        options = (f"seed={self.seed}", "stereo/enabled=true")
        drive = simulated_run.SimulatedDrive(self.scene, options)
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
        """See Simulated."""
        return self.folder.name

    @property
    def folder_name(self):
        """See Simulated; there is one recording."""
        return self.name

    def record(self, programs, bag):
        """Converts it with its stereo images to a bag (Path)."""
        call(programs / "kitti_to_bag", self.folder, bag, "--images", *ODOMETRY_ERRORS)


def data_sets(scenes, config, numbers, seeds):
    """Returns simulated drives: scenes of these numbers (from 1) in a folder (Path), for each
    seed."""
    return [
        Simulated(scenes / f"data_set_{number}.yaml", config, PUBLISHED[number - 1], seed)
        for number in numbers
        for seed in seeds
    ]


def within(view, score_options):
    """Returns the words for score_run, with a CameraView as the evaluated region."""
    others = [word for word in score_options if not word.startswith("region/")]
    return (*others, f"region/range={view.range}", f"region/half_angle={view.half_angle}")
