# SPDX-License-Identifier: BSD-3-Clause
"""Finds rows of parked vehicles along a curb, whose road side ends the road.

All arrays are over equally spaced stations along a path, and to one side of it.
"""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools.evaluate.outlines import corners
from datmo_tools.evaluate.truth import read_true_objects
from datmo_tools.pose_path import planar

# A vehicle is parked along a curb if its far side is within this distance (m) of it, or beyond it.
MAX_FROM_CURB = 1.0


class RowOptions(NamedTuple):
    """What counts as a row."""

    bridged: float = 10.0  # m, longest gap in a row that the row's line bridges
    car_length: float = 5.0  # m; in a longer gap, and so far beyond its ends, the curb counts, too


class Row(NamedTuple):
    """The row along one side."""

    depth: np.ndarray  # n, m, from the curb to the row's line; NaN: no row
    open: np.ndarray  # n, bool: the curb is right as well


def parked_boxes(path):
    """Returns corners (n x 4 x 2, m, in the truth's map) of vehicles that never move in a drive."""
    moving, boxes = set(), {}
    for item in (item for items in read_true_objects(path).values() for item in items):
        if item.moving:
            moving.add(item.id)
        elif item.id not in boxes and item.classification == Object.CLASS_VEHICLE:
            boxes[item.id] = corners(planar(item.pose), (item.size.x, item.size.y))
    parked = [box for number, box in boxes.items() if number not in moving]
    return np.array(parked).reshape(-1, 4, 2)


def depths_of_vehicles(curb, near, far):
    """Returns n, m: how far parked vehicles extend from the curb into the road; NaN if none does.

    curb: n, m, from the path; NaN: none; near, far: n x k, m, sides of k boxes as seen from the path;
    NaN where a box is missed.
    """
    with np.errstate(invalid="ignore"):
        parked = (curb[:, np.newaxis] - far <= MAX_FROM_CURB) & (near < curb[:, np.newaxis])
    faces = np.where(parked, near, np.inf).min(axis=1, initial=np.inf)
    return np.where(np.isfinite(faces), curb - faces, np.nan)


def row_of(depths, bounded, spacing, options):
    """Returns the Row of depths_of_vehicles().

    bounded: n, bool: there is a curb, and no junction; a row ends where this is false; spacing: m,
    of the stations.
    """
    depths = np.where(bounded, depths, np.nan)
    row = Row(depths.copy(), np.zeros(len(depths), dtype=bool))
    breaks = np.cumsum(~bounded)
    occupied = np.flatnonzero(np.isfinite(depths))
    beyond = int(options.car_length / spacing)
    if len(occupied):
        _open_end(row, depths[occupied[0]], range(occupied[0] - 1, -1, -1)[:beyond], bounded)
        after = range(occupied[-1] + 1, len(depths))[:beyond]
        _open_end(row, depths[occupied[-1]], after, bounded)
    for left, right in zip(occupied[:-1], occupied[1:]):
        gap = (right - left - 1) * spacing
        if right == left + 1:
            continue
        if gap <= options.bridged and breaks[left] == breaks[right]:
            inside = np.arange(left + 1, right)
            row.depth[inside] = np.interp(inside, [left, right], [depths[left], depths[right]])
            row.open[inside] = gap > options.car_length
        else:
            _open_end(row, depths[left], range(left + 1, right)[:beyond], bounded)
            _open_end(row, depths[right], range(right - 1, left, -1)[:beyond], bounded)
    return row


def _open_end(row, depth, indices, bounded):
    for index in indices:
        if not bounded[index]:
            return
        if np.isnan(row.depth[index]):
            row.depth[index] = depth
            row.open[index] = True
