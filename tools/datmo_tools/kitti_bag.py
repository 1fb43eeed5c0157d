"""A KITTI raw drive -> a bag of the stack's data contract: the order of the work."""

from pathlib import Path
from typing import NamedTuple, Optional

from datmo_tools import (
    bag_messages,
    ground_truth,
    kitti_messages,
    odometry,
    road_plane,
    scanner_emulation,
    truth_messages,
)
from datmo_tools.bag_file import MOUNTS_LEAD, whole_bag
from datmo_tools.ego_pose import EgoMotion, poses_from_gps, poses_from_velocity
from datmo_tools.errors import InputError
from datmo_tools.kitti_calibration import read_calibration
from datmo_tools.kitti_labels import read_labels
from datmo_tools.kitti_raw import Drive
from datmo_tools.kitti_tracklets import read_tracklets
from datmo_tools.odometry import OdometryErrors
from datmo_tools.progress import Progress
from datmo_tools.scanner_emulation import ScannerOptions


class Options(NamedTuple):
    """What to convert and how."""

    scanner: ScannerOptions = ScannerOptions()
    fit_road: bool = True  # else the road is the plane that the calibrated height gives
    gps_position: bool = False  # truth of the position: else the integrated velocity (see ego_pose)
    points: bool = False
    images: bool = False
    odometry_errors: OdometryErrors = OdometryErrors()
    seed: int = 0
    labels: Optional[Path] = None  # label_02 file; else the drive's tracklet_labels.xml
    start: int = 0  # first frame
    end: Optional[int] = None  # one past the last frame
    allow_missing_scans: bool = False


def convert(folder, bag_path, options, stream=None):
    """Converts the drive in `folder` (Path) to `bag_path` (Path); progress goes to `stream`.

    Raises InputError, and leaves no bag behind, where a file or an option cannot be used.
    """
    scanner_emulation.check(options.scanner)
    conversion = _Conversion(folder, options)
    events = sorted(
        conversion.events(), key=lambda event: event.stamp
    )  # stable: equal stamps keep order
    with whole_bag(bag_path, "kitti_to_bag") as bag, Progress(
        len(events), "kitti_to_bag", stream
    ) as progress:
        conversion.write_mounts(bag, events[0].stamp - MOUNTS_LEAD)
        for done, event in enumerate(events, 1):
            event.write(bag, event.stamp, event.frame)
            progress.update(done)


class _Event(NamedTuple):
    """Something that is written at a stamp; the data are read then, so that memory stays small."""

    stamp: int  # ns
    frame: int
    write: object  # function of (bag, stamp, frame)


class _Conversion:
    """One drive with everything that is read before the first message is written."""

    def __init__(self, folder, options):
        self._options = options
        self._drive = Drive(folder)
        self._frames = _chosen_frames(self._drive, options)
        self._calibration = read_calibration(folder.parent)
        stamps = [self._drive.oxts_stamps[frame] for frame in self._frames]
        self._records = dict(zip(self._frames, (self._drive.oxts(frame) for frame in self._frames)))
        records = list(self._records.values())
        poses = (
            poses_from_gps(records)
            if options.gps_position
            else poses_from_velocity(stamps, records)
        )
        self._ego = EgoMotion(stamps, records, poses)
        rates = odometry.degraded_rates(records, options.odometry_errors, options.seed)
        samples = odometry.integrate(stamps, *rates, options.odometry_errors)
        self._samples = dict(zip(self._frames, samples))
        self._poses = dict(zip(self._frames, poses))
        self._truth = self._read_truth(folder)

    def events(self):
        """All that is to be written, in any order of stamps."""
        for frame in self._frames:
            yield _Event(self._drive.oxts_stamps[frame], frame, self._write_motion)
            if self._drive.has_cloud(frame):
                yield _Event(self._drive.scan_stamps[frame], frame, self._write_scan)
        if self._options.images:
            yield from self._image_events(0, "left", self._calibration.left)
            yield from self._image_events(1, "right", self._calibration.right)

    def write_mounts(self, bag, stamp):
        """Writes /tf_static."""
        message = kitti_messages.static_transforms(
            stamp, self._calibration, self._options.scanner.height
        )
        bag.write_latched("/tf_static", stamp, message)

    def _read_truth(self, folder):
        """Dictionary frame -> list of MapObject; empty where the drive has no labels."""
        if self._options.labels is not None:
            objects = read_labels(self._options.labels, self._calibration.left_from_velodyne)
        elif (folder / "tracklet_labels.xml").is_file():
            objects = read_tracklets(folder / "tracklet_labels.xml")
        else:
            return None
        stamps = self._drive.scan_stamps
        chosen = [
            source._replace(
                boxes={frame: box for frame, box in source.boxes.items() if frame in self._poses}
            )
            for source in objects
        ]
        poses = [self._ego.pose_at(stamp) for stamp in stamps]
        return ground_truth.objects_by_frame(
            chosen, self._calibration.base_from_velodyne, stamps, poses
        )

    def _image_events(self, camera, side, parameters):
        stamps = self._drive.image_stamps(camera)
        topic = f"/stereo/{side}"

        def write(bag, stamp, frame):
            pixels = self._drive.image(camera, frame, parameters.width, parameters.height)
            bag.write(f"{topic}/image_rect", stamp, kitti_messages.gray_image(stamp, pixels))
            bag.write(f"{topic}/camera_info", stamp, kitti_messages.camera_info(stamp, parameters))

        return (_Event(stamps[frame], frame, write) for frame in self._frames)

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
        cloud = self._drive.cloud(frame)
        plane = road_plane.fit_road_plane(cloud) if self._options.fit_road else road_plane.FLAT
        scan = scanner_emulation.emulate_scan(cloud, plane.heights(cloud), self._options.scanner)
        self._write_beams(bag, stamp, scan)
        if self._options.points:
            bag.write("/points", stamp, kitti_messages.point_cloud(stamp, cloud))
        if self._truth is not None:
            hits = cloud[scan.sources[scan.sources >= 0]]
            objects = self._truth[frame]
            beams = [ground_truth.points_in_box(hits, item.source, item.box) for item in objects]
            bag.write(
                "/ground_truth/objects", stamp, truth_messages.true_objects(stamp, objects, beams)
            )

    def _write_beams(self, bag, stamp, scan):
        """Writes /scan: stamped with its first beam's time, recorded when its last one is there.

        The Velodyne looks ahead at `stamp`, in the middle of the field of view.
        """
        scanner, turn_duration = self._options.scanner, self._drive.turn_duration
        half_sweep = round(0.5 * turn_duration * scanner.turn_share)
        message = kitti_messages.laser_scan(stamp - half_sweep, scan, scanner, turn_duration)
        bag.write("/scan", stamp + half_sweep, message)


def _chosen_frames(drive, options):
    """Frame numbers from --start to --end, all with a scan unless missing ones are allowed."""
    end = drive.frames if options.end is None else options.end
    if not 0 <= options.start < end <= drive.frames:
        raise InputError(
            f"frames {options.start} to {end}, expected 0 <= START < END <= {drive.frames}"
        )
    if len(drive.oxts_stamps) != drive.frames:
        raise InputError(
            f"{drive.folder / 'oxts' / 'timestamps.txt'}: {len(drive.oxts_stamps)} stamps, "
            f"expected {drive.frames}, as the Velodyne has"
        )
    frames = range(options.start, end)
    missing = [frame for frame in frames if not drive.has_cloud(frame)]
    if missing and (not options.allow_missing_scans or len(missing) == len(frames)):
        raise InputError(
            f"{drive.folder / 'velodyne_points' / 'data'}: {missing[0]:010d}.bin is missing "
            f"({len(missing)} of {len(frames)}), expected one for each frame; "
            "--allow-missing-scans leaves a few out"
        )
    return frames
