# SPDX-License-Identifier: BSD-3-Clause
"""Scores a stereo camera's occupancy grids with a Velodyne's points: precision and recall by range.

A cell is right if the other side has an obstacle within one cell, or within the standard
deviation of the camera's depth there, whichever is more.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.convert import kitti_scans
from datmo_tools.evaluate import road_plane
from datmo_tools.evaluate.grid_scores import UNDECIDED

# m above the road, what counts as an obstacle: over curbs, and what a car could hit.
OBSTACLE_LOW, OBSTACLE_HIGH = 0.3, 2.0

BAND_EDGES = (0.0, 5.0, 10.0, 15.0, 20.0, 25.0)  # m from the camera over ground
REACH = BAND_EDGES[-1]

# m: cells beyond the last band may match one within it, by depth errors.
MARGIN = 5.0


class CommonView(NamedTuple):
    """What both cameras see: only there is a disparity."""

    left: object  # StereoView of the left camera
    baseline: float  # m
    right_begin: float  # x / z of the right image's left border

    def ranges(self, points):
        """Returns distances (n, m) of points (n x 2, base_link) from the left camera; infinite: not
        seen by both cameras, or farther than its reach."""
        ahead, right = self._along(points)
        seen_by_right = right - self.baseline >= self.right_begin * ahead
        return np.where(seen_by_right, self.left.ranges(points), np.inf)

    def depth_sigmas(self, points):
        """Returns standard deviations (n, m) of the depth at points (n x 2, base_link)."""
        return self.left.depth_sigma(self._along(points)[0])

    def _along(self, points):
        """Returns distances ahead of the camera and to its right (n each, m)."""
        camera = self.left.camera_in_base
        in_space = np.column_stack([points, np.full(len(points), camera[2, 3])])
        in_camera = transforms.apply(transforms.inverse(camera), in_space)
        return in_camera[:, 2], in_camera[:, 0]


def obstacle_points(cloud, base_from_velodyne):
    """Returns obstacles (m x 2, m, base_link) in a Velodyne cloud (n x 3 or more columns)."""
    heights = road_plane.fit_road_plane(cloud).heights(cloud)
    chosen = (heights >= OBSTACLE_LOW) & (heights <= OBSTACLE_HIGH)
    chosen &= ~kitti_scans.on_own_car(cloud[:, 0], cloud[:, 1])
    return transforms.apply(base_from_velodyne, cloud[chosen, :3].astype(float))[:, :2]


def moved(points, pose_then, pose_now):
    """Transforms `points` (n x 2, m) from the vehicle at one planar pose to that at another."""
    return transforms.points_seen_from(pose_now, transforms.points_in_parent(pose_then, points))


class Counts(NamedTuple):
    """Numbers of cells by range band, n each."""

    occupied: np.ndarray  # of the stereo grid
    right: np.ndarray  # of these, those with an obstacle of the Velodyne
    true: np.ndarray  # with an obstacle of the Velodyne
    found: np.ndarray  # of these, those occupied in the stereo grid
    called_free: np.ndarray  # of those not found, those free in the stereo grid

    def __add__(self, other):
        return Counts(*(mine + its for mine, its in zip(self, other)))


NOTHING = Counts(*(np.zeros(len(BAND_EDGES) - 1, dtype=int) for _ in Counts._fields))


def count(grid, obstacles, view):
    """Returns the Counts of one grid.

    grid: Grid; obstacles: n x 2, base_link at its stamp, m; view: CommonView.
    """
    occupied = _within(grid, _cells_where(grid.cells > UNDECIDED), view, REACH + MARGIN)
    true = _within(grid, grid.cells_of(obstacles), view, REACH + MARGIN)
    judged, asked = (_within(grid, cells, view, REACH) for cells in (occupied, true))
    right = _has_partner(grid, judged, true, view)
    found = _has_partner(grid, asked, occupied, view)
    missed = asked[~found]
    values = grid.cells[missed[:, 1], missed[:, 0]]
    free = missed[(values >= 0) & (values < UNDECIDED)]
    counted = (judged, judged[right], asked, asked[found], free)
    return Counts(*(_by_band(grid, cells, view) for cells in counted))


def _cells_where(chosen):
    """Returns indices (n x 2: column, row) of the chosen cells."""
    rows, columns = np.nonzero(chosen)
    return np.column_stack([columns, rows])


def _within(grid, cells, view, reach):
    """Returns the cells in view, and those up to the reach, which may exceed the view's."""
    wide = view._replace(left=view.left._replace(reach=reach))
    return cells[np.isfinite(wide.ranges(grid.centers(cells)))]


def _has_partner(grid, cells, others, view):
    """Returns whether each of the cells (n x 2) has one of the others (m x 2) near enough."""
    if len(others) == 0:
        return np.zeros(len(cells), dtype=bool)
    offsets = np.abs(cells[:, np.newaxis, :] - others[np.newaxis, :, :])
    beside = offsets.max(axis=2) <= 1
    sigmas = view.depth_sigmas(grid.centers(cells))
    near = np.hypot(offsets[..., 0], offsets[..., 1]) * grid.cell_size <= sigmas[:, np.newaxis]
    return np.any(beside | near, axis=1)


def _by_band(grid, cells, view):
    return np.histogram(view.ranges(grid.centers(cells)), BAND_EDGES)[0]
