# SPDX-License-Identifier: BSD-3-Clause
"""Converts a CARMEN log to a bag of the stack's data contract: the order of the work."""

import math
import sys
from typing import NamedTuple, Optional

import numpy as np
from sensor_msgs.msg import LaserScan, TimeReference
from tf2_msgs.msg import TFMessage
from tqdm import tqdm

from datmo_tools import bag_messages
from datmo_tools.bag_file import MOUNTS_LEAD, whole_bag
from datmo_tools.convert import carmen_clock, carmen_odometry
from datmo_tools.convert.carmen_log import out_of_order, read_log, scans_of
from datmo_tools.convert.carmen_mount import scanner_mount
from datmo_tools.errors import InputError
from datmo_tools.stamps import to_ros_time

# The log's stamp for each scan; only if stamps were moved.
LOG_STAMPS_TOPIC = "/log_stamps"

# No obstacle is this close to a scanner's mirror: a reading of 0 is a fault.
RANGE_MIN = 0.02  # m


class Options(NamedTuple):
    """What to convert and how."""

    laser: Optional[str] = None  # kind of line; None: the first one in the log
    clock: Optional[str] = None  # see carmen_clock; None: "log" if stamps increase, else "order"
    field_of_view: Optional[float] = None  # rad, first to last beam; None: see _bearings
    range_max: float = 80.0  # m; SICK scanners log codes above it for no return
    mount: Optional[np.ndarray] = None  # x, y, yaw in base_link; None: from the log
    sweep_time: float = 0.0  # s from the first beam to the last
    skip_malformed: bool = False


def convert(log_path, bag_path, options, stream=None):
    """Converts the log `log_path` (Path) to `bag_path` (Path); progress and notes go to `stream`.

    Raises InputError, without leaving a bag, if the file or an option cannot be used.
    """
    stream = stream if stream is not None else sys.stderr
    if bag_path.exists() and log_path.exists() and bag_path.samefile(log_path):
        raise InputError(f"{bag_path}: the bag must not be the log")
    log = read_log(log_path, options.laser, options.skip_malformed)
    scans = scans_of(log)
    if options.clock is None:
        options = options._replace(clock="order" if out_of_order(scans) else "log")
    mount, note = options.mount, None
    if mount is None:
        mount, note = scanner_mount(log_path, log, [record.line for record in scans])
    timed = carmen_clock.timeline(log.records, options.clock)
    with whole_bag(bag_path, "carmen_to_bag") as bag:
        _write(bag, timed, mount, options, stream)
    for text in _notes(log_path, log, scans, timed, options) + ([note] if note else []):
        print(f"carmen_to_bag: {text}", file=stream)


def _write(bag, timed, mount, options, stream):
    first = timed[0].stamp
    mounts = bag_messages.planar_transform(first, bag_messages.BASE, bag_messages.SCANNER, mount)
    bag.write_latched("/tf_static", max(first - MOUNTS_LEAD, 1), TFMessage([mounts]))
    stamps = [item.stamp for item in timed]
    samples = carmen_odometry.samples(stamps, [_robot_pose(item.record.line) for item in timed])
    steps = zip(timed, samples)
    for item, sample in tqdm(steps, "carmen_to_bag", len(timed), file=stream, disable=None):
        bag.write("/tf", item.stamp, bag_messages.odometry_transform(sample))
        bag.write("/odometry", item.stamp, bag_messages.odometry(sample))
        if item.is_scan:
            _write_scan(bag, item, options)


def _write_scan(bag, item, options):
    line = item.record.line
    bag.write("/scan", item.stamp, laser_scan(item.stamp, line, options))
    if options.clock != "log":
        logged = TimeReference(
            header=bag_messages.header(item.stamp, bag_messages.SCANNER),
            time_ref=to_ros_time(line.stamp),
            source="CARMEN log",
        )
        bag.write(LOG_STAMPS_TOPIC, item.stamp, logged)


def laser_scan(stamp, line, options):
    """Returns the LaserScan of a LaserLine at `stamp` (ns); readings from range_max on: +inf."""
    range_max = min(line.range_max, options.range_max)
    first, step = _bearings(line, options.field_of_view)
    last = len(line.ranges) - 1
    ranges = np.where(line.ranges < range_max, line.ranges, math.inf)
    return LaserScan(
        header=bag_messages.header(stamp, bag_messages.SCANNER),
        angle_min=first,
        angle_max=first + last * step,
        angle_increment=step,
        time_increment=options.sweep_time / last,
        range_min=RANGE_MIN,
        range_max=range_max,
        ranges=ranges.astype(np.float32).tolist(),
    )


def _bearings(line, field_of_view):
    """Returns the bearing of the first beam and the step to the next one (rad).

    A line without it is from a SICK that covers half a turn from -90 degrees: an odd number of
    readings (181, 361) ends at +90 degrees, an even one (180, 360) one step before.
    """
    count = len(line.ranges)
    if field_of_view is not None:
        return -0.5 * field_of_view, field_of_view / (count - 1)
    if math.isnan(line.step):
        return -0.5 * math.pi, math.pi / (count - count % 2)
    return line.first_bearing, line.step


def _robot_pose(line):
    """Returns the robot's pose (x, y, yaw) of a LaserLine or an OdometryLine."""
    return line.pose if hasattr(line, "pose") else line.robot_pose


def _notes(path, log, scans, timed, options):
    """Returns sentences on what the user should know about the log."""
    used = sum(item.is_scan for item in timed)
    notes = [f"{used} scans of {log.laser}, {len(timed) - used} lines of odometry between them"]
    late = out_of_order(scans)
    if late:
        done = {
            "log": f"sorted by stamp, {len(scans) - used} with a repeated stamp skipped",
            "order": f"their stamps were moved; {LOG_STAMPS_TOPIC} has the log's",
        }
        notes.append(
            f"{path}: {len(late)} of {len(scans)} scans, the first in line {late[0].number}, are "
            f"stamped no later than the scan before: {done[options.clock]}"
        )
    if log.skipped:
        kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(log.skipped.items()))
        notes.append(f"{path}: lines of other kinds, not used: {kinds}")
    if log.malformed:
        notes.append(
            f"{len(log.malformed)} malformed lines skipped, the first: {log.malformed[0]}"
        )
    return notes
