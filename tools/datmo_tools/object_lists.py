"""Lists of objects as run_bag writes them, and the sides of their boxes."""

from typing import NamedTuple

import numpy as np

from datmo_tools.errors import InputError
from datmo_tools.grid_recordings import opened
from datmo_tools.pose_path import planar

OBJECT_ARRAY = "datmo_fusion/ObjectArray"

# Outward normals of the sides front, rear, left and right in the frame of their box.
NORMALS = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])

# By side, those at its ends.
END_SIDES = ((2, 3), (2, 3), (0, 1), (0, 1))


class Seen(NamedTuple):
    """One object that a sensor sees; poses in base_link at the stamp of its list."""

    pose: np.ndarray  # x, y (m), yaw (rad) of the box's centre
    size: np.ndarray  # m: length along the heading, width
    covariance: np.ndarray  # 2 x 2, m^2, of the position
    side_variance: np.ndarray  # 4, m^2: front, rear, left, right; infinite: not seen
    classification: int  # Object.CLASS_*
    delay: float  # s after the list's stamp

    @property
    def range(self):
        """Of the centre, m from base_link."""
        return float(np.hypot(*self.pose[:2]))


class SeenList(NamedTuple):
    """All objects of one message."""

    stamp: int  # ns
    objects: list  # of Seen
    viewpoints: dict  # sensor -> x, y (m) of those that the message tells the view of

    @property
    def viewpoint(self):
        """From where ranges are counted: of the first sensor, or base_link."""
        return next(iter(self.viewpoints.values()), (0.0, 0.0))


def read_lists(path, topics):
    """Dictionary topic -> list of SeenList in the order of the bag, of topics that have any.

    Raises InputError for another type.
    """
    lists = {}
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages(list(topics)):
            kind = message._type  # pylint: disable=protected-access
            if kind != OBJECT_ARRAY:
                raise InputError(f"{path}: {topic} is {kind}, expected {OBJECT_ARRAY}")
            lists.setdefault(topic, []).append(_seen_list(message))
    return lists


class NearSide(NamedTuple):
    """The side of a box that a sensor looks at: what its range and bearing are measured of.

    Its middle is what the thesis fuses ("middle point of the front line segment", 3.3.2): sensors
    see different parts of an object, but they all see its near side.
    """

    middle: np.ndarray  # x, y, m
    normal: np.ndarray  # x, y, outward
    length: float  # m
    covariance: np.ndarray  # 2 x 2, m^2, of the middle; infinite: the side or an end is hidden

    @property
    def is_seen(self):
        """With both its ends: else its middle is somewhere else."""
        return bool(np.all(np.isfinite(self.covariance)))


def near_side(seen, viewpoint, normal=None):
    """NearSide of a Seen: the one whose middle is nearest to the sensor.

    viewpoint: x, y (m) of the sensor; normal: of the side of another box that is compared with
    it, then it is the one that looks the same way.
    """
    yaw, (length, width) = seen.pose[2], seen.size
    normals = NORMALS @ np.array([(np.cos(yaw), np.sin(yaw)), (-np.sin(yaw), np.cos(yaw))])
    halves = 0.5 * np.array([length, length, width, width])
    middles = seen.pose[:2] + halves[:, np.newaxis] * normals
    if normal is None:
        side = int(np.argmin(np.hypot(*(middles - np.asarray(viewpoint)).T)))
    else:
        side = int(np.argmax(normals @ normal))
    return NearSide(
        middles[side],
        normals[side],
        float((width, width, length, length)[side]),
        _covariance(seen, side, normals),
    )


def _covariance(seen, side, normals):
    """Of the middle of a side: the box as a whole, the side by itself, and its two ends."""
    first, second = END_SIDES[side]
    across = seen.side_variance[side]
    along = 0.25 * (seen.side_variance[first] + seen.side_variance[second])
    if not (np.isfinite(across) and np.isfinite(along)):
        return np.full((2, 2), np.inf)
    return (
        seen.covariance
        + across * np.outer(normals[side], normals[side])
        + along * np.outer(normals[first], normals[first])
    )


def _seen_list(message):
    objects = [
        Seen(
            np.array(planar(item.pose)),
            np.array([item.size.x, item.size.y]),
            np.array(item.position_covariance).reshape(2, 2),
            np.array(item.side_variance),
            item.classification,
            item.delay,
        )
        for item in message.objects
    ]
    viewpoints = {item.sensor: (item.pose.x, item.pose.y) for item in message.views}
    return SeenList(message.header.stamp.to_nsec(), objects, viewpoints)
