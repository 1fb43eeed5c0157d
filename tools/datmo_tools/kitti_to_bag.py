"""Command line of kitti_to_bag."""

import argparse
import math
import sys
from pathlib import Path

from datmo_tools import kitti_bag
from datmo_tools.errors import InputError
from datmo_tools.odometry import OdometryErrors
from datmo_tools.scanner_emulation import ScannerOptions

DESCRIPTION = """\
Converts a KITTI raw drive, as it is downloaded (calib_*.txt in its parent), to a bag: /scan, /odometry, /tf,
/tf_static, the true pose and, where the drive is labelled, the true objects; /points and stereo images on
demand.

The scan is an EMULATION of a planar scanner at the bumper: the nearest Velodyne point of each beam in a
height band above the road. The Velodyne looks down from 1.73 m and so sees over low obstacles. Returns from
the recording car itself are left out. A beam covers the whole way to its neighbours unless --beam-width
makes it thinner; its range is reported at its own bearing. All beams carry the stamp at which the Velodyne
looks ahead; those at the side are up to 25 ms off. The same options and seed give the same bytes."""


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    parser = _parser()
    values = parser.parse_args(arguments)
    try:
        kitti_bag.convert(values.drive, values.bag, _options(values))
    except InputError as error:
        print(f"kitti_to_bag: {error}", file=sys.stderr)
        return 1
    return 0


def _parser():
    scanner, errors = ScannerOptions(), OdometryErrors()
    parser = argparse.ArgumentParser(prog="kitti_to_bag", description=DESCRIPTION,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("drive", type=Path, help="folder ..._drive_XXXX_sync")
    add("bag", type=Path, help="bag to write")
    add("--start", type=int, default=0, metavar="FRAME", help="first frame (default 0)")
    add("--end", type=int, metavar="FRAME", help="one past the last frame (default: all)")
    add("--scan-resolution", type=_number, default=scanner.resolution, metavar="DEG",
        help="angle between beams (default %(default)s)")
    add("--scan-fov", type=_number, default=scanner.field_of_view, metavar="DEG",
        help="field of view, first to last beam (default %(default)s)")
    add("--scan-range", type=_number, nargs=2, default=[scanner.range_min, scanner.range_max],
        metavar=("MIN", "MAX"), help="m (default %(default)s)")
    add("--scan-band", type=_number, nargs=2, default=[scanner.band_low, scanner.band_high],
        metavar=("LOW", "HIGH"), help="m above the road (default %(default)s)")
    add("--beam-width", type=_number, default=scanner.beam_width, metavar="DEG",
        help="width of a beam; 0: the whole resolution (default %(default)s)")
    add("--road", choices=("fit", "flat"), default="fit",
        help="the band is above the plane fitted to the road in each scan, or above the plane 1.73 m "
             "below the Velodyne, which pitches with the car (default %(default)s)")
    add("--true-position", choices=("velocity", "gps"), default="velocity",
        help="true position from the integrated velocity of the GPS/IMU, or from latitude and longitude, "
             "which may walk by metres within a drive (default %(default)s)")
    add("--points", action="store_true", help="write the Velodyne's points too")
    add("--images", action="store_true", help="write the gray stereo images too")
    add("--odometry-scale-error", type=_number, default=errors.scale_error, metavar="SHARE",
        help="0.03: speed 3 %% too high (default %(default)s)")
    add("--odometry-yaw-bias", type=_number, default=0.0, metavar="DEG_PER_S",
        help="added to the yaw rate (default %(default)s)")
    add("--odometry-speed-noise", type=_number, default=errors.speed_noise, metavar="M_PER_S",
        help="standard deviation (default %(default)s)")
    add("--odometry-yaw-noise", type=_number, default=0.0, metavar="DEG_PER_S",
        help="standard deviation, of the yaw rate (default %(default)s)")
    add("--seed", type=int, default=0, help="of the noise (default %(default)s)")
    add("--labels", type=Path, metavar="FILE",
        help="label_02 file of KITTI tracking for this drive: the truth instead of tracklet_labels.xml")
    add("--allow-missing-scans", action="store_true",
        help="go on where Velodyne files are missing, as in drive 0009")
    return parser


def _number(text):
    """A finite number; argparse names the option where it is none."""
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def _options(values):
    if values.odometry_speed_noise < 0.0 or values.odometry_yaw_noise < 0.0:
        raise InputError("--odometry-speed-noise and --odometry-yaw-noise: expected 0 or more")
    if values.seed < 0:
        raise InputError(f"--seed is {values.seed}, expected 0 or more")
    return kitti_bag.Options(
        scanner=ScannerOptions(values.scan_resolution, values.scan_fov, *values.scan_range,
                               *values.scan_band, values.beam_width),
        fit_road=values.road == "fit",
        gps_position=values.true_position == "gps",
        points=values.points,
        images=values.images,
        odometry_errors=OdometryErrors(values.odometry_scale_error,
                                       math.radians(values.odometry_yaw_bias),
                                       values.odometry_speed_noise,
                                       math.radians(values.odometry_yaw_noise)),
        seed=values.seed,
        labels=values.labels,
        start=values.start,
        end=values.end,
        allow_missing_scans=values.allow_missing_scans,
    )
