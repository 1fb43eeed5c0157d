# SPDX-License-Identifier: BSD-3-Clause
"""Converts GPS/IMU records to planar poses of base_link in the map, and interpolates between them.

The heading is that of the GPS/IMU. There are two sources for the position: its integrated velocity
is smooth and drifts slowly; its latitude and longitude are absolute, but wander by meters when few
satellites are visible. Full Velodyne clouds of drive 0005, aligned scan to map, show how much:
after 71 m the velocity is off by 0.4 m, latitude and longitude by 2.7 m. A map of one drive needs
the first.
"""

import math

import numpy as np

from datmo_tools import transforms

EARTH_RADIUS = 6378137.0  # m, WGS-84 equator, as in the KITTI devkit


def poses_from_velocity(stamps, records):
    """Integrates speed and heading to planar poses (n x 3: x, y in m, yaw in rad), first one 0.

    stamps: ns, increasing. Speed and heading between two records are the means of both.
    """
    yaw = np.unwrap([record.yaw for record in records])
    speed = np.array([record.forward_speed for record in records])
    duration = np.diff(np.array(stamps) - stamps[0]) * 1e-9
    traveled = 0.5 * (speed[1:] + speed[:-1]) * duration
    course = 0.5 * (yaw[1:] + yaw[:-1]) - yaw[0] + course_offset(records)
    x = np.concatenate([[0.0], np.cumsum(traveled * np.cos(course))])
    y = np.concatenate([[0.0], np.cumsum(traveled * np.sin(course))])
    return np.stack([x, y, transforms.normalize_angle(yaw - yaw[0])], axis=-1)


def course_offset(records):
    """Returns the constant angle (rad, to the left) from the GPS/IMU's x axis to the car's motion.

    A car does not drive sideways: the part of the leftward speed that is correlated with the
    forward speed is due to the unit's mount (0.8 degrees on drive 0005), and the rest is noise.
    """
    ahead = np.array([record.forward_speed for record in records])
    left = np.array([record.leftward_speed for record in records])
    power = ahead @ ahead
    return math.atan(ahead @ left / power) if power > 0.0 else 0.0


def poses_from_gps(records):
    """Returns the GPS's planar poses (n x 3: x, y in m, yaw in rad) in the first record's frame.

    Mercator projection scaled at the first latitude, like in the KITTI devkit.
    """
    latitude = np.radians([record.latitude for record in records])
    longitude = np.radians([record.longitude for record in records])
    scale = EARTH_RADIUS * math.cos(latitude[0])
    east = scale * longitude
    north = scale * np.log(np.tan(0.25 * math.pi + 0.5 * latitude))
    poses = np.stack([east, north, [record.yaw for record in records]], axis=-1)
    return transforms.relative(poses[0], poses)


class EgoMotion:
    """True pose of base_link in the map at any stamp near the drive.

    Between two records the pose is interpolated; before the first and after the last one it follows
    the arc of that record's speed and yaw rate. The sensors start within a few hundredths of a
    second.
    """

    def __init__(self, stamps, records, poses):
        """stamps: ns, increasing; records: Oxts; poses: n x 3, base_link in the map; by stamp."""
        self._stamps = stamps
        self._records = records
        self._poses = poses

    def pose_at(self, stamp):
        """Returns the planar pose (x, y, yaw) at `stamp` (ns)."""
        after = int(np.searchsorted(self._stamps, stamp, side="right"))
        if after in (0, len(self._stamps)):
            return self._extrapolated(0 if after == 0 else -1, stamp)
        begin, end = self._stamps[after - 1], self._stamps[after]
        share = (stamp - begin) / (end - begin)
        step = transforms.relative(self._poses[after - 1], self._poses[after])
        return transforms.compose(self._poses[after - 1], share * step)

    def _extrapolated(self, index, stamp):
        record = self._records[index]
        duration = (stamp - self._stamps[index]) * 1e-9
        step = transforms.arc(record.forward_speed, record.yaw_rate, duration)
        return transforms.compose(self._poses[index], step)
