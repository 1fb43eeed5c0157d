# SPDX-License-Identifier: BSD-3-Clause
"""Fits the road's plane in a Velodyne scan, for scoring stereo grids.

By other means than those by which the stack finds the road.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools.convert.kitti_calibration import VELODYNE_HEIGHT

# Where the road is searched, in the Velodyne's frame.
NEAR, FAR, HALF_WIDTH = 3.0, 40.0, 8.0  # m ahead, m ahead, m to either side
CELL = 1.0  # m: one height for each cell, so that near points do not outweigh far ones
LOW_SHARE = 0.25  # this quantile of a cell's heights is taken as its floor

# Cells farther than this (m) from the plane are removed, step by step: objects on the road.
TOLERANCES = (0.6, 0.4, 0.25, 0.15, 0.15, 0.15)
MIN_CELLS = 30

# A plane outside of these bounds is not the road under this car.
MAX_SLOPE = 0.1
MAX_HEIGHT_ERROR = 0.4  # m


class RoadPlane(NamedTuple):
    """Height of the road: z = offset + slope_x x + slope_y y, in the Velodyne's frame (m)."""

    offset: float
    slope_x: float
    slope_y: float

    def heights(self, points):
        """Returns the heights (n, m) of `points` (n x 3 or more columns) above the road."""
        return points[:, 2] - (
            self.offset + self.slope_x * points[:, 0] + self.slope_y * points[:, 1]
        )


FLAT = RoadPlane(-VELODYNE_HEIGHT, 0.0, 0.0)


def fit_road_plane(points):
    """Fits a plane to the floor of `points` (n x 3 or more columns); FLAT if none is credible.

    Trimmed least squares starting with the flat plane: no random samples, so the same scan gives
    the same plane.
    """
    floor = _floor(points)
    plane = np.array(FLAT)
    design = np.column_stack([np.ones(len(floor)), floor[:, 0], floor[:, 1]])
    for tolerance in TOLERANCES:
        near = np.abs(floor[:, 2] - design @ plane) < tolerance
        if np.count_nonzero(near) < MIN_CELLS:
            return FLAT
        plane = np.linalg.lstsq(design[near], floor[near, 2], rcond=None)[0]
    return RoadPlane(*plane.tolist()) if _is_credible(plane) else FLAT


def _is_credible(plane):
    return abs(plane[0] - FLAT.offset) < MAX_HEIGHT_ERROR and np.max(np.abs(plane[1:])) < MAX_SLOPE


def _floor(points):
    """Returns one low point (3) for each cell of the road ahead."""
    x, y, z = points[:, 0], points[:, 1], points[:, 2]
    ahead = (
        (x > NEAR)
        & (x < FAR)
        & (np.abs(y) < HALF_WIDTH)
        & (np.abs(z + VELODYNE_HEIGHT) < TOLERANCES[0] + 0.5)
    )
    candidates = points[ahead, :3].astype(float)
    column = np.floor(candidates[:, 0] / CELL).astype(int)
    row = np.floor((candidates[:, 1] + HALF_WIDTH) / CELL).astype(int)
    cell = column * int(2 * HALF_WIDTH / CELL + 1) + row
    order = np.lexsort((candidates[:, 2], cell))
    _, first, count = np.unique(cell[order], return_index=True, return_counts=True)
    return candidates[order][first + (LOW_SHARE * count).astype(int)]
