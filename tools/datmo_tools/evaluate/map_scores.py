# SPDX-License-Identifier: BSD-3-Clause
"""Counts what is right in maps of stationary objects, by the true boxes on and next to the road."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.evaluate.grid_scores import UNDECIDED

REACH = 30.0  # m around the vehicle: within the map's border and the sensors' range

# m inward from the curb: the curb itself, an obstacle to some sensors, is not scored.
FROM_CURB = 0.6

# m from the side of a box: a cell of the side itself may be this far inside, whatever its size.
INSIDE = 0.3


class Boxes(NamedTuple):
    """Upright boxes, n."""

    poses: np.ndarray  # n x 3: x, y, yaw (m, rad) of their centers
    sizes: np.ndarray  # n x 2, m

    def depths(self, points):
        """Returns m x n: distances (m) of points (m x 2) outside of each box; negative: inside."""
        offsets = points[:, np.newaxis, :] - self.poses[np.newaxis, :, :2]
        cosine, sine = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        along = cosine * offsets[..., 0] + sine * offsets[..., 1]
        across = cosine * offsets[..., 1] - sine * offsets[..., 0]
        return np.maximum(
            np.abs(along) - 0.5 * self.sizes[:, 0], np.abs(across) - 0.5 * self.sizes[:, 1]
        )

    def nearest(self, points):
        """Returns the least of them for each point; infinite without a box."""
        return self.depths(points).min(axis=1, initial=np.inf)


class Moment(NamedTuple):
    """The truth at the stamp of a map, as seen from the vehicle (base_link, m)."""

    standing: Boxes  # what never moves
    resting: Boxes  # what moves at other times
    seen: np.ndarray  # bool, of `standing`: some sensor has seen it
    thin: np.ndarray  # bool, of `standing`: a pole
    is_road: object  # points (n x 2) -> bool: between the curbs


class Counts(NamedTuple):
    """Counts over some maps."""

    occupied: int  # cells of the road
    occupied_right: int  # of these, those within a cell of a stationary object
    free: int  # cells of the road
    free_right: int  # of these, those outside of stationary objects
    things: int  # stationary ones that have been seen, once in each map
    things_found: int  # of these, those within a cell of an occupied one
    poles: int  # thin ones of the objects
    poles_found: int

    def __add__(self, other):
        return Counts(*(mine + its for mine, its in zip(self, other)))


NOTHING = Counts(*(0 for _ in Counts._fields))


def count(grid, moment):
    """Returns the Counts of one map (Grid, base_link at its stamp) at a Moment."""
    occupied = _near(grid, grid.cells > UNDECIDED)
    free = _near(grid, (grid.cells >= 0) & (grid.cells < UNDECIDED))
    found = np.any(moment.standing.depths(occupied) <= grid.cell_size, axis=0)
    asked = moment.seen & (np.hypot(*moment.standing.poses[:, :2].T) <= REACH)
    on_road = occupied[moment.is_road(occupied)]
    # What stands now and moves later may be in the map already, still, or not yet.
    on_road = on_road[moment.resting.nearest(on_road) > grid.cell_size]
    free = free[moment.is_road(free)]
    return Counts(
        len(on_road), int(np.sum(moment.standing.nearest(on_road) <= grid.cell_size)),
        len(free), int(np.sum(moment.standing.nearest(free) > -INSIDE)),
        int(np.sum(asked)), int(np.sum(found & asked)),
        int(np.sum(asked & moment.thin)), int(np.sum(found & asked & moment.thin)),
    )  # fmt: skip


def _near(grid, chosen):
    """Returns the centers (n x 2) of the chosen cells within REACH."""
    rows, columns = np.nonzero(chosen)
    centers = grid.centers(np.column_stack([columns, rows]))
    return centers[np.hypot(centers[:, 0], centers[:, 1]) <= REACH]


def boxes_from(base, items):
    """Transforms boxes of (x, y, yaw, length, width), n x 5, from the map to the pose `base`."""
    items = np.asarray(items, dtype=float).reshape(-1, 5)
    return Boxes(transforms.relative(base, items[:, :3]), items[:, 3:])
