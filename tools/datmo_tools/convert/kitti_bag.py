# SPDX-License-Identifier: BSD-3-Clause
"""Converts a KITTI raw drive to a bag of the stack's data contract: the order of the work."""

import sys
from pathlib import Path
from typing import NamedTuple, Optional

import numpy as np
from tqdm import tqdm

from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import MOUNTS_LEAD, whole_bag
from datmo_tools.convert import ground_truth, kitti_messages, kitti_scans, odometry, truth_messages
from datmo_tools.convert.ego_pose import EgoMotion, poses_from_gps, poses_from_velocity
from datmo_tools.convert.kitti_calibration import find_calibration, read_calibration
from datmo_tools.convert.kitti_images import ImagePairs
from datmo_tools.convert.kitti_labels import read_labels
from datmo_tools.convert.kitti_raw import Drive
from datmo_tools.convert.kitti_scans import DriveScans, ScannerOptions
from datmo_tools.convert.kitti_tracklets import read_tracklets
from datmo_tools.convert.odometry import OdometryErrors
from datmo_tools.errors import InputError


class Options(NamedTuple):
    """What to convert and how."""

    scanner: ScannerOptions = ScannerOptions()
    fit_road: bool = True  # otherwise the road is the plane given by the calibrated height
    gps_position: bool = False  # true position from GPS, not the velocity (see ego_pose)
    points: bool = False
    images: bool = False
    odometry_errors: OdometryErrors = OdometryErrors()
    seed: int = 0
    labels: Optional[Path] = None  # label_02 file; otherwise the drive's tracklet_labels.xml
    start: int = 0  # first frame
    end: Optional[int] = None  # one past the last frame
    allow_missing_scans: bool = False
    calibration: Optional[Path] = None  # folder; None: where it is published, see find_calibration


def convert(folder, bag_path, options, stream=None):
    """Converts the drive in `folder` (Path) to `bag_path` (Path); progress goes to `stream`.

    Raises InputError, without leaving a bag, if a file or an option cannot be used.
    """
    kitti_scans.check(options.scanner)
    conversion = _Conversion(folder, options)
    for notice in conversion.notices():
        print(f"kitti_to_bag: {notice}", file=stream or sys.stderr)
    events = sorted(
        conversion.events(), key=lambda event: event.stamp
    )  # stable: equal stamps keep order
    with whole_bag(bag_path, "kitti_to_bag") as bag:
        conversion.write_mounts(bag, events[0].stamp - MOUNTS_LEAD)
        for event in tqdm(events, "kitti_to_bag", file=stream, disable=None):
            event.write(bag, event.stamp, event.frame)
        conversion.check_scans()


class _Event(NamedTuple):
    """Something written at a stamp; its data are read only then, to save memory."""

    stamp: int  # ns
    frame: int
    write: object  # function of (bag, stamp, frame)


class _Conversion:
    """One drive, with everything that is read before the first message is written."""

    def __init__(self, folder, options):
        self._options = options
        self._drive = Drive(folder)
        self._frames = _chosen_frames(self._drive, options)
        calibration_folder = options.calibration or find_calibration(folder)
        self._calibration = read_calibration(calibration_folder)
        self._images = (
            ImagePairs(self._drive, calibration_folder, self._calibration)
            if options.images
            else None
        )
        self._motion = self._drive.motion_records(self._frames)
        stamps = [self._drive.oxts_stamps[index] for index in self._motion]
        records = [self._drive.oxts(index) for index in self._motion]
        poses = (
            poses_from_gps(records)
            if options.gps_position
            else poses_from_velocity(stamps, records)
        )
        self._ego = EgoMotion(stamps, records, poses)
        rates = odometry.degraded_rates(records, options.odometry_errors, options.seed)
        samples = odometry.integrate(stamps, *rates, options.odometry_errors)
        self._records = dict(zip(self._motion, records))
        self._samples = dict(zip(self._motion, samples))
        self._poses = dict(zip(self._motion, poses))
        self._truth = self._read_truth(folder)
        self._scans = self._make_scans()
        self._written_scans = 0

    def notices(self):
        """Yields sentences on what differs from a complete synchronized drive."""
        lost_scans = [frame for frame in self._frames if not self._drive.has_cloud(frame)]
        if lost_scans:
            yield f"{len(lost_scans)} of {len(self._frames)} scans are missing and skipped"
        if self._drive.synced and len(self._motion) < len(self._frames):
            lost = len(self._frames) - len(self._motion)
            yield f"{lost} of {len(self._frames)} GPS/IMU records are missing and interpolated"
        if not self._drive.synced:
            yield "an unsynchronized drive: every sensor at its own rate, without true objects"

    def events(self):
        """Yields all events to be written, in any order of stamps."""
        for index in self._motion:
            yield _Event(self._drive.oxts_stamps[index], index, self._write_motion)
        for frame in self._frames:
            if self._drive.has_cloud(frame):
                yield _Event(self._drive.scan_stamps[frame], frame, self._write_scan)
        if self._images is not None:
            for stamp, index, write in self._images.events(self._frames):
                yield _Event(stamp, index, write)

    def write_mounts(self, bag, stamp):
        """Writes /tf_static."""
        bag.write_latched("/tf_static", stamp, self._mounts(stamp))

    def check_scans(self):
        """Raises InputError if no scan was written."""
        if not self._written_scans:
            raise InputError(
                "no cloud of the drive gives a scan, expected points in the scanner's band; "
                "see --scan-band and --road"
            )

    def _mounts(self, stamp):
        """Returns the TFMessage of all mounts."""
        height = self._options.scanner.height
        return kitti_messages.static_transforms(stamp, self._calibration, height)

    def _make_scans(self):
        options, drive = self._options, self._drive
        sections = kitti_scans.configuration(
            options.scanner, options.fit_road, self._calibration, drive.turn_duration
        )
        return DriveScans(drive, self._frames, sections, self._mounts(drive.scan_stamps[0]))

    def _read_truth(self, folder):
        """Returns a dictionary frame -> list of MapObject; None if the drive has no labels.

        Labels count the frames of the synchronized drive.
        """
        if not self._drive.synced:
            if self._options.labels is not None:
                raise InputError("--labels: expected a synchronized drive, whose frames they count")
            return None
        if self._options.labels is not None:
            objects = read_labels(self._options.labels, self._calibration.left_from_velodyne)
        elif (folder / "tracklet_labels.xml").is_file():
            objects = read_tracklets(folder / "tracklet_labels.xml")
        else:
            return None
        stamps = self._drive.scan_stamps
        chosen = [
            source._replace(
                boxes={frame: box for frame, box in source.boxes.items() if frame in self._frames}
            )
            for source in objects
        ]
        poses = [self._ego.pose_at(stamp) for stamp in stamps]
        return ground_truth.objects_by_frame(
            chosen, self._calibration.base_from_velodyne, stamps, poses
        )

    def _write_motion(self, bag, stamp, frame):
        sample = self._samples[frame]
        bag.write("/tf", stamp, bag_messages.odometry_transform(sample))
        bag.write("/odometry", stamp, bag_messages.odometry(sample))
        record = self._records[frame]
        pose = truth_messages.true_pose(
            stamp, self._poses[frame], record.forward_speed, record.yaw_rate
        )
        bag.write("/ground_truth/pose", stamp, pose)

    def _write_scan(self, bag, stamp, frame):
        scan = self._scans.scan_of(frame)
        if scan is not None:
            self._write_beams(bag, stamp, scan)
        if self._options.points:
            bag.write("/points", stamp, kitti_messages.point_cloud(stamp, self._drive.cloud(frame)))
        if self._truth is not None:
            hits = self._hits(scan)
            objects = self._truth[frame]
            beams = [ground_truth.points_in_box(hits, item.source, item.box) for item in objects]
            bag.write(
                "/ground_truth/objects", stamp, truth_messages.true_objects(stamp, objects, beams)
            )

    def _write_beams(self, bag, stamp, scan):
        """Writes /scan: stamped with its first beam's time, recorded at its last beam's.

        The Velodyne faces forward at `stamp`, in the middle of the field of view.
        """
        turn_duration = self._drive.turn_duration
        scan.scan_time = turn_duration * 1e-9
        half_sweep = round(0.5 * turn_duration * self._options.scanner.turn_share)
        bag.write("/scan", stamp + half_sweep, scan)
        self._written_scans += 1

    def _hits(self, scan):
        """Returns the end points (n x 2, m, the Velodyne's frame) of a scan, or of None."""
        if scan is None:
            return np.zeros((0, 2))
        ranges = np.array(scan.ranges)
        bearings = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        ends = np.column_stack([ranges * np.cos(bearings), ranges * np.sin(bearings)])
        yaw = transforms.yaw_of(self._calibration.base_from_velodyne)
        rotation = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
        return ends[np.isfinite(ranges)] @ rotation


def _chosen_frames(drive, options):
    """Returns the frames from --start to --end, all with a scan unless some may be missing."""
    end = drive.frames if options.end is None else options.end
    if not 0 <= options.start < end <= drive.frames:
        raise InputError(
            f"frames {options.start} to {end}, expected 0 <= START < END <= {drive.frames}"
        )
    frames = range(options.start, end)
    missing = [frame for frame in frames if not drive.has_cloud(frame)]
    if missing and (not options.allow_missing_scans or len(missing) == len(frames)):
        raise InputError(
            f"{drive.cloud_file(missing[0])} is missing, or its stamp "
            f"({len(missing)} of {len(frames)}), expected one for each frame; "
            "--allow-missing-scans skips a few"
        )
    return frames
