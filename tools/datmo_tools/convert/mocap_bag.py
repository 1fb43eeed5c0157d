# SPDX-License-Identifier: BSD-3-Clause
"""Converts a bag of a 2D scanner and motion capture to a bag of the data contract."""

import math
import sys
from typing import NamedTuple, Optional

import numpy as np
from tf2_msgs.msg import TFMessage
from tqdm import tqdm

from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import MOUNTS_LEAD, whole_bag
from datmo_tools.convert import ground_truth, mocap_scan, truth_messages
from datmo_tools.convert.mocap_truth import CapturedBody, seen_path
from datmo_tools.convert.true_boxes import UNKNOWN_OCCLUSION, TrueBox, TrueObject
from datmo_tools.convert.wheel_odometry import has_topics, read_odometry
from datmo_tools.errors import InputError
from datmo_tools.pose_path import read_messages

# A beam is counted for an object if it ends within this distance of its box: noise, and the car's
# corners are round.
BOX_TOLERANCE = 0.05  # m

# By how much the scanner of the example bags measures short (m), at some ranges (m): this makes the
# walls of the room sharpest in both of them, and in each alone to 0.02 m.
SHORT_RANGES = (
    (1.0, 0.0),
    (2.0, 0.0),
    (3.0, 0.045),
    (4.0, 0.08),
    (4.5, 0.24),
    (5.0, 0.42),
    (6.0, 0.34),
    (7.5, 0.33),
)

# x, y (m), yaw (rad) of that scanner in base_link.
MOUNT = np.array([-0.152, 0.0, math.radians(0.3)])

LABEL = "Car"
NO_CENTER = np.zeros(3)


class Options(NamedTuple):
    """What to convert and how; mocap_to_bag --help explains the defaults."""

    scan_topic: str = "/scan"
    ego_topic: str = "/ego_pose"
    object_topics: tuple = ("/red_pose",)
    wheels_topic: str = "/wheel_speeds"
    imu_topic: str = "/imu/data"
    odometry: bool = True  # if both of these topics are recorded
    wheel_radius: float = 0.031  # m
    mount: np.ndarray = MOUNT
    clockwise: bool = True  # the last beam of a message is the first in time
    sweep_time: Optional[float] = None  # s from the first beam to the last; None: between scans
    scan_delay: float = -0.015  # s from a scan's stamp to its first beam, by motion capture's clock
    range_errors: tuple = SHORT_RANGES  # increasing (range, how short it is), m; linear between
    object_size: tuple = (0.455, 0.205, 0.2)  # m: length, width, height
    object_center: np.ndarray = np.array([0.07, 0.0, 0.0])  # x, y, yaw from the markers' origin
    moving_speed: float = 0.1  # m/s


def convert(recording, bag_path, options, stream=None):
    """Converts the bag `recording` (Path) to `bag_path` (Path); progress and notes go to `stream`.

    Raises InputError, without leaving a bag, if the file or an option cannot be used.
    """
    stream = stream if stream is not None else sys.stderr
    if bag_path.exists() and recording.exists() and bag_path.samefile(recording):
        raise InputError(f"{bag_path}: the bag must not be the recording")
    conversion = _Conversion(recording, options)
    with whole_bag(bag_path, "mocap_to_bag") as bag:
        conversion.write(bag, stream)
    for note in conversion.notes():
        print(f"mocap_to_bag: {note}", file=stream)


class _Conversion:
    """One recording, with everything that is read before the first message is written."""

    def __init__(self, recording, options):
        self._options = options
        self._scans = _read_scans(recording, options)
        self._sweep = options.sweep_time
        if self._sweep is None:
            self._sweep = _scan_period(recording, self._scans)
        ego_path = seen_path(recording, options.ego_topic)
        origin = ego_path.at(max(self._scans[0][0], ego_path.stamps[0]))
        self._ego = CapturedBody(ego_path, origin, NO_CENTER)
        self._objects = [
            CapturedBody(seen_path(recording, topic), origin, options.object_center)
            for topic in options.object_topics
        ]
        self._sources = [
            TrueObject(number, LABEL, *options.object_size, boxes={})
            for number in range(len(self._objects))
        ]
        self._odometry = _read_odometry(recording, options)
        self._without_truth = 0

    def write(self, bag, stream):
        """Writes everything in order of time."""
        events = [(stamp, self._write_scan, message) for stamp, message in self._scans]
        events += [(stamp, self._write_pose, None) for stamp in self._ego.path.stamps.tolist()]
        events += [(sample.stamp, _write_odometry, sample) for sample in self._odometry]
        events.sort(key=lambda event: event[0])  # stable: equal stamps keep order
        self._write_mounts(bag, max(events[0][0] - MOUNTS_LEAD, 1))
        for stamp, write, message in tqdm(events, "mocap_to_bag", file=stream, disable=None):
            write(bag, stamp, message)

    def notes(self):
        """Yields sentences on what the user should know."""
        if not self._odometry:
            topics = f"{self._options.wheels_topic} and {self._options.imu_topic}"
            yield f"no odometry, which needs {topics}" if self._options.odometry else "no odometry"
        if self._without_truth:
            yield (
                f"{self._without_truth} of {len(self._scans)} scans without truth, because motion "
                "capture had lost a car"
            )

    def _write_mounts(self, bag, stamp):
        mount = bag_messages.planar_transform(
            stamp, bag_messages.BASE, bag_messages.SCANNER, self._options.mount
        )
        bag.write_latched("/tf_static", stamp, TFMessage([mount]))

    def _write_pose(self, bag, stamp, _):
        body = self._ego.at(stamp)
        pose = truth_messages.true_pose(stamp, body.pose, body.forward_speed, body.yaw_rate)
        bag.write("/ground_truth/pose", stamp, pose)

    def _write_scan(self, bag, stamp, message):
        """Writes /scan, recorded at its last beam's time, and the truth at its stamp."""
        scan = mocap_scan.converted(message, stamp, self._sweep, self._options)
        bag.write("/scan", stamp + round(self._sweep * 1e9), scan)
        ego, states = self._ego.at(stamp), [item.at(stamp) for item in self._objects]
        if ego is None or None in states:
            self._without_truth += 1
            return
        objects = [self._map_object(*pair) for pair in zip(self._sources, states)]
        scanner = transforms.compose(ego.pose, self._options.mount)
        beams = _beams_on(objects, mocap_scan.end_points(scan), scanner)
        bag.write(
            "/ground_truth/objects", stamp, truth_messages.true_objects(stamp, objects, beams)
        )

    def _map_object(self, source, state):
        z = 0.5 * source.height
        moving = float(np.hypot(*state.velocity)) > self._options.moving_speed
        return ground_truth.MapObject(
            source=source,
            box=TrueBox(*state.pose[:2], z, state.pose[2], UNKNOWN_OCCLUSION),
            pose=state.pose,
            z=z,
            velocity=state.velocity * moving,
            moving=moving,
        )


def _read_odometry(recording, options):
    """Returns a list of OdometrySample; empty if it is not wanted or the recording has none."""
    topics = (options.wheels_topic, options.imu_topic)
    if not options.odometry or not has_topics(recording, *topics):
        return []
    return read_odometry(recording, *topics, options.wheel_radius)


def _write_odometry(bag, stamp, sample):
    bag.write("/tf", stamp, bag_messages.odometry_transform(sample))
    bag.write("/odometry", stamp, bag_messages.odometry(sample))


def _read_scans(recording, options):
    """Returns a list of (stamp of the first beam in ns, recorded LaserScan), increasing."""
    delay = round(options.scan_delay * 1e9)
    scans = {}
    for message, kind in read_messages(recording, options.scan_topic):
        if kind != "sensor_msgs/LaserScan":
            raise InputError(
                f"{recording}: {options.scan_topic} is {kind}, expected sensor_msgs/LaserScan"
            )
        if mocap_scan.usable(message):
            scans.setdefault(message.header.stamp.to_nsec() + delay, message)
    if not scans:
        raise InputError(f"{recording}: no scan on {options.scan_topic}, expected one or more")
    return sorted(scans.items())


def _scan_period(recording, scans):
    """Returns the typical time (s) from one scan to the next: the scanner never pauses."""
    if len(scans) < 2:
        raise InputError(f"{recording}: 1 scan, expected two or more, or --sweep-time")
    return float(np.median(np.diff([stamp for stamp, _ in scans]))) * 1e-9


def _beams_on(objects, points, scanner):
    """Returns how many of the points (n x 2, m, scanner's frame) are on each of the MapObjects."""
    in_map = transforms.points_in_parent(scanner, points)
    return [
        ground_truth.points_in_box(in_map, item.source, item.box, BOX_TOLERANCE) for item in objects
    ]
