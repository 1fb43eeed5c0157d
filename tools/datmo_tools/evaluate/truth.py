# SPDX-License-Identifier: BSD-3-Clause
"""The true objects of a drive as seen from the vehicle, at any stamp."""

import math
from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import TrueObjectArray
from datmo_tools import transforms
from datmo_tools.bag_input import check_type
from datmo_tools.errors import InputError
from datmo_tools.evaluate.object_scores import ListWithTruth, TrueState
from datmo_tools.pose_path import planar, read_messages, read_path
from datmo_tools.stamps import NANOSECONDS

TRUE_OBJECTS, TRUE_POSE = "/ground_truth/objects", "/ground_truth/pose"

ANY, NONE = "any", "none"  # sensors that must see an object: at least one; not required

# s, from the stamp of a list to that of a truth: like score_run's max_silence.
MAX_GAP = 0.2


class Region(NamedTuple):
    """The region in which true objects have to be found, and objects count as false."""

    range: float  # m around base_link
    half_angle: float = math.pi  # rad, to either side of straight ahead

    def contains(self, pose):
        """Whether a position (x, y, ..., base_link) is in it."""
        bearing = math.atan2(pose[1], pose[0])
        return math.hypot(pose[0], pose[1]) <= self.range and abs(bearing) <= self.half_angle


class Asked(NamedTuple):
    """Which true objects have to be found."""

    region: Region
    sensor: str = ANY  # that must see them, or ANY, or NONE
    moving_only: bool = False

    def includes(self, item, pose):
        """Whether a TrueObject at a pose in base_link is one of them."""
        seen = self.sensor == NONE or self.sensor in item.visible_to
        seen = seen or (self.sensor == ANY and bool(item.visible_to))
        return seen and self.region.contains(pose) and (item.moving or not self.moving_only)


ANYTHING = Asked(Region(math.inf), NONE)


def read_true_objects(path):
    """Returns a dictionary stamp (ns) -> list of TrueObject of a bag (Path). Raises InputError."""
    objects = {}
    for message, _ in read_messages(path, TRUE_OBJECTS):
        check_type(path, TRUE_OBJECTS, message, TrueObjectArray)
        objects[message.header.stamp.to_nsec()] = message.objects
    return objects


class Truth:
    """True objects and poses of one drive."""

    def __init__(self, path):
        """path: of the bag (Path). Raises InputError without true objects or poses."""
        self._path = path
        self._objects = read_true_objects(path)
        if not self._objects:
            raise InputError(f"{path}: nothing on {TRUE_OBJECTS}, expected a drive with truth")
        self._stamps = np.array(sorted(self._objects))
        self._poses = read_path(path, TRUE_POSE)

    def check_seen_by(self, sensor):
        """Raises InputError if no true object of the drive is ever visible to the sensor."""
        sensors = {
            name for items in self._objects.values() for item in items for name in item.visible_to
        }
        if sensor not in (ANY, NONE, *sensors):
            known = ", ".join(sorted(sensors)) or "no sensor"
            raise InputError(
                f"{self._path}: no true object is visible to {sensor}, only to {known}; expected "
                f"one of these, {ANY} or {NONE}"
            )

    def at(self, stamp, asked):
        """Returns a list of TrueState at `stamp` (ns), with what is Asked; None without truth."""
        nearest = int(self._stamps[np.argmin(np.abs(self._stamps - stamp))])
        late = (stamp - nearest) / NANOSECONDS
        if abs(late) > MAX_GAP or self._poses.distance_from(stamp) > MAX_GAP * NANOSECONDS:
            return None
        return _states(self._objects[nearest], self.base_at(stamp), late, asked)

    def beside(self, lists, asked):
        """Returns a list of ListWithTruth, for each list (SeenList) with truth near in time."""
        states = [(item, self.at(item.stamp, asked)) for item in lists]
        return [ListWithTruth(item.objects, truths, item.viewpoint, item.stamp)
                for item, truths in states if truths is not None]  # fmt: skip

    def base_at(self, stamp):
        """Returns the true pose of base_link in the map (x, y, yaw) at `stamp` (ns)."""
        return self._poses.at(stamp)

    @property
    def path(self):
        """Returns the true PosePath of base_link in the map."""
        return self._poses

    def movers(self):
        """Returns the ids of the objects that move at some time."""
        return {item.id for items in self._objects.values() for item in items if item.moving}


def _states(items, base, late, asked):
    """late: s, from the items' stamp to that of `base`, the vehicle's pose in the map."""
    velocities = np.array([(item.velocity.x, item.velocity.y) for item in items]).reshape(-1, 2)
    in_map = np.array([planar(item.pose) for item in items]).reshape(-1, 3)
    in_map[:, :2] += velocities * late
    cosine, sine = math.cos(base[2]), math.sin(base[2])
    turned = velocities @ np.array([[cosine, -sine], [sine, cosine]])
    return [
        TrueState(
            pose,
            np.array([item.size.x, item.size.y]),
            velocity,
            item.classification,
            item.moving,
            asked.includes(item, pose),
            item,
        )
        for item, pose, velocity in zip(items, transforms.relative(base, in_map), turned)
    ]
