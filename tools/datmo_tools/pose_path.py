# SPDX-License-Identifier: BSD-3-Clause
"""Planar poses over time: reading them from a bag, and the pose at any stamp."""

import math

import numpy as np

from datmo_tools import transforms
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError

# Message types with a stamped pose, and how to get the geometry_msgs/Pose from each.
POSE_OF = {
    "nav_msgs/Odometry": lambda message: message.pose.pose,
    "geometry_msgs/PoseWithCovarianceStamped": lambda message: message.pose.pose,
    "geometry_msgs/PoseStamped": lambda message: message.pose,
}
PATH = "nav_msgs/Path"


class PosePath:
    """Planar poses over time, interpolated between stamps and extrapolated beyond them."""

    def __init__(self, stamps, poses):
        """stamps: ns, increasing, two or more; poses: n x 3 (x, y in m, yaw in rad)."""
        self.stamps = np.asarray(stamps)
        self.poses = np.asarray(poses, dtype=float)

    def at(self, stamp):
        """Returns the pose at `stamp` (ns)."""
        after = int(np.clip(np.searchsorted(self.stamps, stamp), 1, len(self.stamps) - 1))
        begin, end = self.stamps[after - 1], self.stamps[after]
        step = transforms.relative(self.poses[after - 1], self.poses[after])
        return transforms.compose(self.poses[after - 1], step * ((stamp - begin) / (end - begin)))

    def distance_from(self, stamp):
        """Returns the time (ns) from `stamp` to the nearest pose."""
        after = int(np.clip(np.searchsorted(self.stamps, stamp), 1, len(self.stamps) - 1))
        return int(np.abs(self.stamps[after - 1 : after + 1] - stamp).min())

    def length_between(self, begin, end):
        """Returns the distance driven (m) between two stamps (ns), along the poses between them."""
        inside = self.poses[(self.stamps >= begin) & (self.stamps <= end)]
        return float(np.hypot(*np.diff(inside[:, :2], axis=0).T).sum()) if len(inside) > 1 else 0.0

    def length(self):
        """Returns the distance driven, m."""
        return float(np.hypot(*np.diff(self.poses[:, :2], axis=0).T).sum())


def read_path(bag_path, topic):
    """Returns the PosePath of `topic` by header stamps; of equal stamps, the first counts.

    Of paths (nav_msgs/Path) the last one is used, as it covers the whole drive.

    Raises InputError: no such file, not a bag, fewer than two poses, a type without a stamped pose,
    a pose that is not finite.
    """
    by_stamp = {}
    for message, kind in _stamped(read_messages(bag_path, topic)):
        if kind not in POSE_OF:
            raise InputError(
                f"{bag_path}: {topic} is {kind}, expected one of {', '.join(sorted([*POSE_OF, PATH]))}"
            )
        stamp, pose = message.header.stamp, planar(POSE_OF[kind](message))
        if not np.all(np.isfinite(pose)):
            raise InputError(
                f"{bag_path}: {topic} at {stamp.to_sec():.6f} s: pose {pose} (x, y, "
                "yaw), expected finite numbers"
            )
        by_stamp.setdefault(stamp.to_nsec(), pose)
    if len(by_stamp) < 2:
        raise InputError(f"{bag_path}: {len(by_stamp)} poses on {topic}, expected two or more")
    stamps = sorted(by_stamp)
    return PosePath(stamps, [by_stamp[stamp] for stamp in stamps])


def _stamped(messages):
    """Returns the messages, or the poses of the last path."""
    if messages and messages[-1][1] == PATH:
        return [(pose, "geometry_msgs/PoseStamped") for pose in messages[-1][0].poses]
    return messages


def read_messages(bag_path, topic):
    """Returns a list of (message, type name) on `topic`. Raises InputError for a bad bag."""
    with opened(bag_path) as bag:
        return [
            (message, message._type)  # pylint: disable=protected-access
            for _, message, _ in bag.read_messages([topic])
        ]


def planar(pose):
    """Returns x, y (m) and yaw (rad) of a geometry_msgs/Pose."""
    q = pose.orientation
    yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    return [pose.position.x, pose.position.y, yaw]
