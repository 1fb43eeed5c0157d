# SPDX-License-Identifier: BSD-3-Clause
"""Reads road borders: those that run_bag publishes, and the true ones."""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import RoadBorder, RoadBorders, TrueRoadBorders
from datmo_tools.bag_input import check_type, opened
from datmo_tools.errors import InputError
from datmo_tools.stamps import NANOSECONDS

BORDERS, TRUE_BORDERS = "/road_borders", "/ground_truth/road_borders"

SIDES = {RoadBorder.LEFT: "left", RoadBorder.RIGHT: "right"}


class SeenBorder(NamedTuple):
    """One published segment, in the map of the run."""

    side: str  # left, right
    points: np.ndarray  # n x 2, m, at least two
    sigma: np.ndarray  # n, m
    probability: float
    unseen: float  # s
    side_street: bool = False  # whether it bounds a street that joins the vehicle's on that side


class BorderList(NamedTuple):
    """All borders of one message."""

    stamp: int  # ns
    borders: list  # of SeenBorder


class TrueBorders(NamedTuple):
    """All curbs of the scene, and when the vehicle is at an intersection."""

    curbs: list  # of arrays n x 2, m, in the map of the truth
    stamps: np.ndarray  # ns, rising
    at_intersection: np.ndarray  # bool, of each stamp


def read_borders(path):
    """Returns a list of BorderList on /road_borders by stamp; of equal stamps the first one counts.

    Raises InputError: no message, another type or version, a border with fewer than two points,
    with another number of sigmas, on an unknown side, or with values that are not finite.
    """
    lists = {}
    for message in _messages(path, BORDERS, RoadBorders, "a bag of run_bag --road-border"):
        stamp = message.header.stamp.to_nsec()
        if stamp not in lists:
            lists[stamp] = border_list(path, message)
    return [lists[stamp] for stamp in sorted(lists)]


def border_list(path, message):
    """Returns the BorderList of a message in the bag at `path` (Path). Raises InputError."""
    stamp = message.header.stamp.to_nsec()
    location = f"{path}: {BORDERS} at {stamp / NANOSECONDS:.6f} s"
    return BorderList(stamp, [_border(location, item) for item in message.borders])


def read_true_borders(path):
    """Returns the TrueBorders of a drive. Raises InputError for none or another type."""
    states, curbs = {}, []
    for message in _messages(path, TRUE_BORDERS, TrueRoadBorders, "a drive with true borders"):
        if not states:  # each message has all of them
            curbs = [_points(line.points) for line in message.borders if len(line.points) > 1]
        states.setdefault(message.header.stamp.to_nsec(), message.at_intersection)
    stamps = sorted(states)
    at_intersection = np.array([states[stamp] for stamp in stamps], dtype=bool)
    return TrueBorders(curbs, np.array(stamps), at_intersection)


def _messages(path, topic, kind, expected):
    messages = []
    with opened(path) as bag:
        for _, message, _ in bag.read_messages([topic]):
            check_type(path, topic, message, kind)
            messages.append(message)
    if not messages:
        raise InputError(f"{path}: nothing on {topic}, expected {expected}")
    return messages


def _border(location, item):
    points, sigma = _points(item.points), np.array(item.sigma, dtype=float)
    if len(points) < 2 or len(sigma) != len(points) or item.side not in SIDES:
        raise InputError(
            f"{location}: a border of side {item.side} with {len(points)} points and {len(sigma)} "
            "sigmas, expected a known side, two points or more, and one sigma for each"
        )
    if not (np.all(np.isfinite(points)) and np.all(np.isfinite(sigma)) and np.all(sigma >= 0.0)):
        raise InputError(f"{location}: a border is not finite, expected finite points and sigmas")
    return SeenBorder(SIDES[item.side], points, sigma, item.probability, item.unseen.to_sec(),
                      item.side_street)  # fmt: skip


def _points(points):
    return np.array([(point.x, point.y) for point in points], dtype=float).reshape(-1, 2)
