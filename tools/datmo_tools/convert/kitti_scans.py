# SPDX-License-Identifier: BSD-3-Clause
"""Makes planar scans from the Velodyne's clouds of a KITTI drive by the program clouds_to_scans.

It is an emulation. The Velodyne looks down from 1.73 m, so it sees over low obstacles into areas
that a scanner at the bumper would not see; and a band of several rows replaces the scanner's
opening angle.
"""

import math
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import rosbag
import yaml

from datmo_tools import programs
from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_messages import SCANNER
from datmo_tools.convert import kitti_messages
from datmo_tools.errors import InputError

# The recording car itself in the Velodyne's frame (m): its hood and mirrors return, too, and a
# scanner at the bumper does not see them. A VW Passat, with mirrors; the hood's returns are up to
# 2.53 m ahead.
CAR_REAR, CAR_FRONT, CAR_HALF_WIDTH = -2.7, 2.7, 1.15

FINEST_RESOLUTION = 0.02  # degrees: a fifth of the Velodyne's own; the finest of cloud_to_scan
COARSEST_RESOLUTION = 10.0  # degrees: the coarsest

CHUNK = 50  # clouds at a time, which limits the disk space of intermediate files

# Exit code of clouds_to_scans if no cloud of a chunk gives a scan.
NO_USABLE_CLOUD = 2


class ScannerOptions(NamedTuple):
    """Geometry of the emulated scanner; the defaults are the demonstrator's (thesis 1.3.3)."""

    resolution: float = 2.0  # degrees from beam to beam
    field_of_view: float = 160.0  # degrees, first to last beam, symmetric about straight ahead
    range_min: float = 1.0  # m
    range_max: float = 50.0  # m: beyond it, at most one beam hits an object (thesis 1.3.3)
    band_low: float = 0.3  # m above the road: over curbs and over errors of the road plane
    band_high: float = (
        0.9  # m: two rows of the Velodyne (0.4 degrees) at 40 m, below hoods and bumpers
    )
    beam_width: float = 0.0  # degrees that a beam covers; 0: up to the neighboring beams

    @property
    def height(self):
        """Returns the height (m) of the scanner above the road: the middle of the band."""
        return 0.5 * (self.band_low + self.band_high)

    @property
    def turn_share(self):
        """Returns the part of the Velodyne's turn from the first to the last beam."""
        return self.field_of_view / 360.0


def check(options):
    """Raises InputError if the options do not describe a scanner."""
    steps = options.field_of_view / options.resolution if options.resolution > 0.0 else 0.0
    rules = (
        (
            FINEST_RESOLUTION <= options.resolution <= COARSEST_RESOLUTION,
            f"--scan-resolution is {options.resolution:g}, expected {FINEST_RESOLUTION:g} to "
            f"{COARSEST_RESOLUTION:g}",
        ),
        (
            1.0 <= options.field_of_view < 360.0,
            f"--scan-fov is {options.field_of_view:g}, expected from 1 to less than 360 degrees",
        ),
        (
            steps >= 1.0 and abs(steps - round(steps)) < 1e-6,
            f"--scan-fov {options.field_of_view:g} is no multiple of "
            f"--scan-resolution {options.resolution:g}, expected one",
        ),
        (
            0.0 <= options.range_min < options.range_max,
            f"--scan-range is {options.range_min:g} {options.range_max:g}, expected 0 <= MIN < MAX",
        ),
        (
            options.band_low < options.band_high,
            f"--scan-band is {options.band_low:g} {options.band_high:g}, expected LOW < HIGH",
        ),
        (
            0.0 <= options.beam_width <= options.resolution,
            f"--beam-width is {options.beam_width:g}, expected 0 to {options.resolution:g}",
        ),
    )
    for holds, message in rules:
        if not holds:
            raise InputError(message)


def on_own_car(x, y):
    """Whether points (x, y: n, m, the Velodyne's frame) are on the recording car."""
    return (x > CAR_REAR) & (x < CAR_FRONT) & (abs(y) < CAR_HALF_WIDTH)


def configuration(options, fit_road, calibration, turn_duration):
    """Returns the sensor set of clouds_to_scans (dictionary); turn_duration: of the Velodyne (ns).

    The Velodyne turns to the right and faces forward at the stamp, in the middle of its turn:
    clouds of drive 0005, aligned a second apart, fit best if the beams toward the left are taken to
    be earlier by 1.1 times their share of a turn.
    """
    ahead, left = (float(arc_length) for arc_length in calibration.base_from_velodyne[:2, 3])
    scan = {
        "scan_frame": SCANNER,
        "min_height": options.band_low,
        "max_height": options.band_high,
        "min_range": options.range_min,
        "max_range": options.range_max,
        "beam_spacing": math.radians(options.resolution),
        "beam_width": math.radians(options.beam_width),
        "field_of_view": math.radians(options.field_of_view),
        "ground": {"estimate": fit_road},
        "sweep": {
            "duration": turn_duration * 1e-9,
            "clockwise": True,
            "first_bearing": math.pi,
            "stamp_share": 0.5,
        },
    }
    car = {
        "rear": CAR_REAR + ahead,
        "front": CAR_FRONT + ahead,
        "half_width": CAR_HALF_WIDTH + abs(left),
    }
    return {"cloud_to_scan": scan, "vehicle": {"own_points": car}}


class DriveScans:
    """Makes the scans of a drive's frames, a chunk of frames at a time, in the order of frames."""

    def __init__(self, drive, frames, sections, mounts):
        """sections: see configuration(). mounts: TFMessage with the Velodyne's.

        Raises InputError if the program is missing.
        """
        self._drive = drive
        self._frames = [frame for frame in frames if drive.has_cloud(frame)]
        self._sections = sections
        self._mounts = mounts
        self._program = Path(programs.find("clouds_to_scans", sys.argv[0]))
        self._scans = {}

    def scan_of(self, frame):
        """Returns the LaserScan of a frame with a cloud; None if its cloud is empty."""
        if frame not in self._scans:
            begin = self._frames.index(frame)
            self._scans = self._convert(self._frames[begin : begin + CHUNK])
        return self._scans[frame]

    def _convert(self, frames):
        """Returns a dictionary frame -> LaserScan or None."""
        with tempfile.TemporaryDirectory(prefix="kitti_to_bag_") as folder:
            clouds, scans = Path(folder) / "clouds.bag", Path(folder) / "scans.bag"
            config = Path(folder) / "scanner.yaml"
            config.write_text(yaml.safe_dump(self._sections))
            with whole_bag(clouds, "kitti_to_bag") as bag:
                bag.write_latched("/tf_static", self._drive.scan_stamps[frames[0]], self._mounts)
                for frame in frames:
                    stamp = self._drive.scan_stamps[frame]
                    message = kitti_messages.point_cloud(stamp, self._drive.cloud(frame))
                    bag.write("/cloud", stamp, message)
            try:
                programs.call(self._program, clouds, scans, "--config", config)
            except programs.StepFailed as error:
                if error.code == NO_USABLE_CLOUD:
                    return dict.fromkeys(frames)
                raise InputError(f"{error} (frames {frames[0]} to {frames[-1]})") from error
            with rosbag.Bag(str(scans)) as bag:
                messages = [message for _, message, _ in bag.read_messages(["/scan"])]
        found = dict.fromkeys(frames)
        for message in messages:
            found[self._frame_of(message, frames)] = message
        return found

    def _frame_of(self, scan, frames):
        """Returns the frame in whose middle the scan's middle beam is measured."""
        middle = scan.header.stamp.to_nsec() + round(
            0.5e9 * (len(scan.ranges) - 1) * scan.time_increment
        )
        return min(frames, key=lambda frame: abs(self._drive.scan_stamps[frame] - middle))
