# SPDX-License-Identifier: BSD-3-Clause
"""Measures how much of a scanner's view a saved map covers, which bounds localization in it."""

import math

import cv2
import numpy as np

from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.pose_path import planar
from datmo_tools.stamps import to_ros_time
from datmo_tools.yaml_files import load_yaml

# m, from a surface of the map, within which an end point is on it.
NEAR = 0.3


class MapSurfaces:
    """The occupied pixels of a map as saved by map_server."""

    def __init__(self, description):
        """description: yaml file (Path). Raises InputError."""
        tree = load_yaml(description)
        image = cv2.imread(str(description.parent / tree["image"]), cv2.IMREAD_GRAYSCALE)
        if image is None:
            raise InputError(f"{description}: no image {tree['image']} beside it")
        self.pixel = float(tree["resolution"])
        self.origin = np.asarray(tree["origin"][:2], dtype=float)
        # The rows of images go down.
        occupied = image[::-1] < 255.0 * (1.0 - tree["occupied_thresh"])
        distances = cv2.distanceTransform((~occupied).astype(np.uint8), cv2.DIST_L2, 5)
        self.is_near = distances * self.pixel <= NEAR

    def known(self, points):
        """Returns for each of the points (n x 2, m, in the map) whether it is near a surface
        (bool)."""
        cells = np.floor((np.asarray(points) - self.origin) / self.pixel).astype(int)
        rows, columns = self.is_near.shape
        inside = ((cells >= 0) & (cells < (columns, rows))).all(axis=1)
        near = np.zeros(len(cells), dtype=bool)
        near[inside] = self.is_near[cells[inside, 1], cells[inside, 0]]
        return near


def known_shares(computed, begin, surfaces):
    """Returns stamps (ns) and the share of each scan's end points that a map covers (two arrays).

    computed: bag (Path) with /labeled_scan, with poses in the map's frame, read from `begin` (ns) on.
    """
    stamps, shares = [], []
    with opened(computed) as bag:
        for _, message, _ in bag.read_messages(["/labeled_scan"], to_ros_time(begin)):
            if message.points:
                points = np.array([(point.x, point.y) for point in message.points])
                stamps.append(message.header.stamp.to_nsec())
                shares.append(surfaces.known(_in_map(points, planar(message.pose.pose))).mean())
    return np.array(stamps, dtype=np.int64), np.array(shares)


def _in_map(points, pose):
    x, y, heading = pose
    turn = np.array([[math.cos(heading), -math.sin(heading)],
                     [math.sin(heading), math.cos(heading)]])  # fmt: skip
    return points @ turn.T + (x, y)
