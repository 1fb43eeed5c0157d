"""GPS/IMU records -> planar poses of base_link in the map, and the pose at any time between."""

import math

import numpy as np

from datmo_tools import transforms

EARTH_RADIUS = 6378137.0  # m, WGS-84 equator, as the KITTI devkit has it


def poses_from_oxts(records):
    """Planar poses (n x 3: x, y in m, yaw in rad) of the records in the frame of the first one.

    Mercator projection scaled at the first latitude, as the KITTI devkit does; the heading only,
    because the map is flat.
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

    Between two records the pose is interpolated; before the first and after the last one it follows the
    arc of that record's speed and yaw rate. The sensors start within a few hundredths of a second.
    """

    def __init__(self, stamps, records):
        """stamps: ns, rising, one for each record (Oxts)."""
        self.stamps = stamps
        self.poses = poses_from_oxts(records)
        self._records = records

    def pose_at(self, stamp):
        """Planar pose (x, y, yaw) at `stamp` (ns)."""
        after = int(np.searchsorted(self.stamps, stamp, side="right"))
        if after == 0 or after == len(self.stamps):
            return self._extrapolated(0 if after == 0 else -1, stamp)
        begin, end = self.stamps[after - 1], self.stamps[after]
        share = (stamp - begin) / (end - begin)
        step = transforms.relative(self.poses[after - 1], self.poses[after])
        return transforms.compose(self.poses[after - 1], share * step)

    def _extrapolated(self, index, stamp):
        record = self._records[index]
        duration = (stamp - self.stamps[index]) * 1e-9
        step = transforms.arc(record.forward_speed, record.yaw_rate, duration)
        return transforms.compose(self.poses[index], step)
