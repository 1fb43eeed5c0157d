# SPDX-License-Identifier: BSD-3-Clause
"""Reads lists of objects as written by run_bag."""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import ObjectArray, TrackArray
from datmo_tools.bag_input import check_type, opened
from datmo_tools.errors import InputError
from datmo_tools.pose_path import planar, read_messages


class Seen(NamedTuple):
    """One object seen by a sensor; poses in base_link at the stamp of its list."""

    pose: np.ndarray  # x, y (m), yaw (rad) of the box's center
    size: np.ndarray  # m: length along the heading, width
    covariance: np.ndarray  # 2 x 2, m^2, of the position
    side_variance: np.ndarray  # 4, m^2: front, rear, left, right; infinite: not seen
    classification: int  # Object.CLASS_*
    delay: float  # s after the list's stamp
    class_probability: float = 0.0  # of the classification, 0 to 1
    height: float = 0.0  # m; 0: not measured

    @property
    def range(self):
        """Returns the center's distance, m from base_link."""
        return float(np.hypot(*self.pose[:2]))

    @property
    def is_finite(self):
        """Whether all values are finite, except sides, which are infinite if hidden."""
        parts = (self.pose, self.size, self.covariance.ravel(), [self.delay])
        return bool(np.all(np.isfinite(np.concatenate(parts)))) and not np.any(
            np.isnan(self.side_variance)
        )


class SeenList(NamedTuple):
    """All objects of one message."""

    stamp: int  # ns
    objects: list  # of Seen
    viewpoints: dict  # sensor -> x, y (m) of those whose view is in the message

    @property
    def viewpoint(self):
        """Returns the origin of ranges: the first sensor, or base_link."""
        return next(iter(self.viewpoints.values()), (0.0, 0.0))


class MovingBox(NamedTuple):
    """A track at the stamp of a scan, in the map."""

    pose: np.ndarray  # x, y (m), yaw (rad)
    size: np.ndarray  # m: length, width
    velocity: np.ndarray  # m/s: vx, vy


def read_lists(path, topics):
    """Returns a dictionary topic -> list of SeenList in the order of the bag, without empty ones.

    Objects with a position, size or covariance that is not finite are ignored, as in the stack.

    Raises InputError for another type or version.
    """
    lists = {}
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages(list(topics)):
            check_type(path, topic, message, ObjectArray)
            lists.setdefault(topic, []).append(_seen_list(message))
    return lists


def read_moving_boxes(path, topic):
    """Returns a dictionary stamp (ns) -> list of MovingBox: the moving tracks, in the map.

    Raises InputError for another type or version, and if there are none.
    """
    boxes = {}
    for message, _ in read_messages(path, topic):
        check_type(path, topic, message, TrackArray)
        boxes[message.header.stamp.to_nsec()] = [
            MovingBox(
                np.array(planar(track.pose)),
                np.array([track.size.x, track.size.y]),
                np.array([track.velocity.x, track.velocity.y]),
            )
            for track in message.tracks
            if track.moving
        ]
    if not any(boxes.values()):
        raise InputError(f"{path}: nothing that moves on {topic}, expected tracks")
    return boxes


def _seen_list(message):
    objects = [
        Seen(
            np.array(planar(item.pose)),
            np.array([item.size.x, item.size.y]),
            np.array(item.position_covariance).reshape(2, 2),
            np.array(item.side_variance),
            item.classification,
            item.delay,
            item.class_probability,
            item.size.z,
        )
        for item in message.objects
    ]
    objects = [item for item in objects if item.is_finite]
    viewpoints = {item.sensor: (item.pose.x, item.pose.y) for item in message.views}
    return SeenList(message.header.stamp.to_nsec(), objects, viewpoints)
