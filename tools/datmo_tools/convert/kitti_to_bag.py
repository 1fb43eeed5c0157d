# SPDX-License-Identifier: BSD-3-Clause
"""Command line of kitti_to_bag."""

import math
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.command_line import add_number
from datmo_tools.convert import kitti_bag
from datmo_tools.convert.kitti_scans import ScannerOptions
from datmo_tools.convert.odometry import OdometryErrors

DESCRIPTION = """\
Converts a KITTI raw drive, as it is downloaded and unpacked (calib_*.txt in its parent), to a bag:
/scan, /odometry, /tf, /tf_static, the true pose and, if the drive is labeled, the true objects;
/points and stereo images on request. Both published forms are supported: synced+rectified
(..._sync) and unsynced+unrectified (..._extract), whose sensors keep their own rates and whose
images are rectified here; it has no true objects, as labels count the frames of the other form.

The scan is an EMULATION of a planar scanner at the bumper: the nearest Velodyne point of each beam
in a height band above the road, as computed by clouds_to_scans. The Velodyne looks down from 1.73 m
and therefore sees over low obstacles. Returns from the recording car itself are removed. A beam
extends to its neighbors unless --beam-width makes it narrower; its range is reported at its own
bearing. The Velodyne turns to the right, and so does the scan: its first beam is the leftmost, each
beam has its own time, and the middle one has the drive's stamp, which is also that of points
and true objects. The scan is recorded at the time of its last beam. The same options and seed give
the same bytes."""


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run(
        "kitti_to_bag", lambda: kitti_bag.convert(values.drive, values.bag, _options(values))
    )


def _parser():
    parser = command_line.new_parser("kitti_to_bag", DESCRIPTION)
    parser.add_argument("drive", type=Path, help="folder ..._drive_NUMBER_sync or _extract")
    parser.add_argument("bag", type=Path, help="bag to write")
    _add_contents(parser.add_argument_group("contents"))
    _add_scanner(parser.add_argument_group("emulated scanner"), ScannerOptions())
    _add_odometry(parser.add_argument_group("odometry"))
    _add_truth(parser.add_argument_group("ground truth"))
    return parser


def _add_contents(group):
    add = group.add_argument
    add("--start", type=int, default=0, metavar="FRAME", help="first frame (default 0)")
    add("--end", type=int, metavar="FRAME", help="one past the last frame (default: all)")
    add("--points", action="store_true", help="write the Velodyne's points too")
    add("--images", action="store_true", help="write the gray stereo images too")
    calibration = "folder of calib_*.txt (default: above the drive, in it, or its day's next to it)"
    add("--calibration", type=Path, metavar="FOLDER", help=calibration)
    missing = "continue if Velodyne files are missing, as in drive 0009"
    add("--allow-missing-scans", action="store_true", help=missing)


def _add_scanner(group, scanner):
    limits = [scanner.range_min, scanner.range_max]
    band = [scanner.band_low, scanner.band_high]
    add_number(group, "--scan-resolution", scanner.resolution, "DEG", "angle between beams")
    add_number(group, "--scan-fov", scanner.field_of_view, "DEG", "first to last beam")
    add_number(group, "--scan-range", limits, ("MIN", "MAX"), "m")
    add_number(group, "--scan-band", band, ("LOW", "HIGH"), "m above the road")
    width = "width of a beam; 0: the whole resolution"
    add_number(group, "--beam-width", scanner.beam_width, "DEG", width)
    group.add_argument(
        "--road",
        choices=("fit", "flat"),
        default="fit",
        help="the band is above the plane fitted to the road in each scan, or above z = 0 of "
        "base_link, which pitches with the car (default %(default)s)",
    )


def _add_odometry(group):
    add_number(group, "--odometry-scale-error", 0.0, "SHARE", "0.03: speed 3 %% too high")
    add_number(group, "--odometry-yaw-bias", 0.0, "DEG_PER_S", "bias added to the yaw rate")
    noise = "standard deviation of the noise of"
    add_number(group, "--odometry-speed-noise", 0.0, "M_PER_S", f"{noise} the speed")
    add_number(group, "--odometry-yaw-noise", 0.0, "DEG_PER_S", f"{noise} the yaw rate")
    group.add_argument("--seed", type=int, default=0, help="of the noise (default %(default)s)")


def _add_truth(group):
    group.add_argument(
        "--labels",
        type=Path,
        metavar="FILE",
        help="label_02 file of KITTI tracking to use instead of tracklet_labels.xml",
    )
    group.add_argument(
        "--true-position",
        choices=("velocity", "gps"),
        default="velocity",
        help="from the GPS/IMU's integrated velocity, or from latitude and longitude, "
        "which may wander by meters within a drive (default %(default)s)",
    )


def _options(values):
    command_line.check_not_negative(values, "odometry_speed_noise", "odometry_yaw_noise", "seed")
    return kitti_bag.Options(
        scanner=ScannerOptions(
            values.scan_resolution,
            values.scan_fov,
            *values.scan_range,
            *values.scan_band,
            values.beam_width,
        ),
        fit_road=values.road == "fit",
        gps_position=values.true_position == "gps",
        points=values.points,
        images=values.images,
        odometry_errors=OdometryErrors(
            values.odometry_scale_error,
            math.radians(values.odometry_yaw_bias),
            values.odometry_speed_noise,
            math.radians(values.odometry_yaw_noise),
        ),
        seed=values.seed,
        labels=values.labels,
        start=values.start,
        end=values.end,
        allow_missing_scans=values.allow_missing_scans,
        calibration=values.calibration,
    )
