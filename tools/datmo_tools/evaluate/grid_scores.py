# SPDX-License-Identifier: BSD-3-Clause
"""Scores occupancy grids with the truth: what fusion removes from the lidar's grid, and adds.

Counted are cells in which a beam of the scanner ended, and thin poles. White paint on the road
returns beams by mistake (thesis 1.3.3): its cells should not be occupied. The cells of bodies
should stay occupied (thesis 3.2.4).
"""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import TrueEchoes
from datmo_tools import transforms

UNDECIDED = 50  # percent: more is occupied

# A body hides what is this far behind the point where the line of sight hits it. Nearer points are
# on the body, or next to it because of the scanner's noise.
HIDDEN_BEHIND = 1.0  # m


class Grid(NamedTuple):
    """Cells around the vehicle in a grid of one stamp."""

    cell_size: float  # m
    origin: np.ndarray  # x, y of its lower left corner in base_link, m
    cells: np.ndarray  # rows along y, columns along x; percent, or -1: unknown

    def cells_of(self, points):
        """Returns the cells (n x 2: column, row) that contain points (n x 2, m), each cell once.

        Points outside of the grid are ignored.
        """
        found = np.floor((points - self.origin) / self.cell_size).astype(int)
        rows, columns = self.cells.shape
        inside = np.all((found >= 0) & (found < [columns, rows]), axis=1)
        return np.unique(found[inside], axis=0)

    def centers(self, cells):
        """Returns the centers (n x 2, m) of cells given by their indices."""
        return self.origin + (cells + 0.5) * self.cell_size

    def occupied(self, cells):
        """Returns whether each of the cells is occupied, n."""
        return self.cells[cells[:, 1], cells[:, 0]] > UNDECIDED

    def occupied_near(self, point, reach):
        """Returns the centers (n x 2, m) of the occupied cells around a point (2), those at most
        `reach` m away along x and y, and some beyond."""
        cells = np.floor((point - self.origin + [[-reach], [reach]]) / self.cell_size).astype(int)
        first, last = np.maximum(cells, 0)
        rows, columns = np.nonzero(
            self.cells[first[1] : last[1] + 1, first[0] : last[0] + 1] > UNDECIDED
        )
        return self.centers(np.column_stack([columns, rows]) + first)


class StereoView(NamedTuple):
    """What a stereo camera sees of the road plane, and how accurately."""

    camera_in_base: np.ndarray  # 4 x 4, of the optical frame
    tangents: tuple  # x / z of the image's left and right border
    reach: float  # m, effective range
    sigma_factor: float  # 1/m; the depth's standard deviation is this times its square

    def ranges(self, points):
        """Returns ground distances (n, m) of points (n x 2, base_link); infinite: not in view."""
        height = self.camera_in_base[2, 3]
        in_space = np.column_stack([points, np.full(len(points), height)])
        right, _, ahead = transforms.apply(transforms.inverse(self.camera_in_base), in_space).T
        seen = (ahead > 0.0) & (right >= self.tangents[0] * ahead)
        seen &= right <= self.tangents[1] * ahead
        ranges = np.hypot(right, ahead)
        return np.where(seen & (ranges <= self.reach), ranges, np.inf)

    def hidden(self, points, bodies):
        """Returns whether each point of the road (n x 2) is behind one of the Bodies."""
        camera = self.camera_in_base[:2, 3]
        meets = bodies.met_at(camera, points)
        height = self.camera_in_base[2, 3] * (1.0 - meets)
        behind = (1.0 - meets) * np.linalg.norm(points - camera, axis=1)[:, np.newaxis]
        return np.any((behind > HIDDEN_BEHIND) & (height < bodies.heights), axis=1)

    def depth_sigma(self, depth):
        """Returns the standard deviation of the depth at a depth, m."""
        return self.sigma_factor * depth**2


class Echoes(NamedTuple):
    """The nearest echoes of a scan."""

    points: np.ndarray  # n x 2, where they were measured, base_link, m
    surfaces: np.ndarray  # n, as in TrueEchoes


class Bodies(NamedTuple):
    """Upright boxes around the vehicle; base_link, m."""

    poses: np.ndarray  # n x 3: x, y, yaw (rad) of their centers
    sizes: np.ndarray  # n x 2: along their x and y
    heights: np.ndarray  # n, above the road

    def met_at(self, begin, ends):
        """Returns where lines on the ground from `begin` (2) to `ends` (m x 2) first hit the boxes.

        m x n, as share of the distance; infinite: the line misses the box, or begins in it.
        """
        cosine, sine = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        turn = np.stack([np.stack([cosine, sine]), np.stack([-sine, cosine])])
        start = np.einsum("ijn,nj->ni", turn, begin - self.poses[:, :2])
        ray = np.einsum("ijn,mj->mni", turn, ends - begin)
        with np.errstate(divide="ignore", invalid="ignore"):
            near, far = ((side * self.sizes - start) / ray for side in (-0.5, 0.5))
        borders = np.stack([near, far])
        enter = np.fmax.reduce(borders.min(axis=0), axis=2)
        leave = np.fmin.reduce(borders.max(axis=0), axis=2)
        return np.where((enter <= leave) & (enter > 0.0) & (enter <= 1.0), enter, np.inf)


class Tally:
    """Counts how many objects have a property: of all, of those in view, and by their range."""

    def __init__(self, edges):
        """edges: of the bands of range, increasing, m; the last one is where the view ends."""
        self._edges = np.asarray(edges)
        self.total = np.zeros(len(edges) + 1, dtype=int)  # all, in view, each band
        self.having = np.zeros_like(self.total)

    def add(self, ranges, having):
        """ranges: n, m, infinite if not in view; having: n, whether each has the property."""
        self.total += self._counts(ranges)
        self.having += self._counts(ranges[having])

    def percent(self):
        """Returns the share of those with the property in each column; nan if there is nothing."""
        with np.errstate(invalid="ignore"):
            return 100.0 * self.having / self.total

    def _counts(self, ranges):
        bands, _ = np.histogram(ranges[np.isfinite(ranges)], self._edges)
        return np.concatenate([[len(ranges), np.isfinite(ranges).sum()], bands])


class GridScores:
    """Counts over a run; `add` once for each stamp."""

    def __init__(self, view, edges):
        """view: StereoView; edges: see Tally."""
        self._view = view
        self.paint_gone = Tally(edges)
        self.bodies_lost = Tally(edges)
        self.poles_in_lidar = Tally(edges)
        self.poles_in_fused = Tally(edges)

    def add(self, lidar, fused, echoes, bodies, poles):
        """lidar, fused: Grid of one window; bodies: Bodies that may hide cells from the camera;
        poles: n x 2, base_link, those visible to it."""
        obstacles = lidar.cells_of(echoes.points[echoes.surfaces == TrueEchoes.BODY])
        paint = lidar.cells_of(echoes.points[echoes.surfaces == TrueEchoes.PAINT])
        paint = paint[~_among(paint, obstacles)]
        for tally, cells in ((self.paint_gone, paint), (self.bodies_lost, obstacles)):
            cells = cells[lidar.occupied(cells)]
            centers = lidar.centers(cells)
            hidden = self._view.hidden(centers, bodies)
            ranges = np.where(hidden, np.inf, self._view.ranges(centers))
            tally.add(ranges, ~fused.occupied(cells))
        ranges = self._view.ranges(poles)
        poles, ranges = poles[np.isfinite(ranges)], ranges[np.isfinite(ranges)]
        for tally, grid in ((self.poles_in_lidar, lidar), (self.poles_in_fused, fused)):
            tally.add(ranges, np.array([self._holds(grid, pole) for pole in poles], dtype=bool))

    def _holds(self, grid, pole):
        """Whether a cell is occupied where the camera may see a pole (2): across the line of sight
        at most one cell off, along it by the uncertainty of the depth, but at least one cell."""
        camera = self._view.camera_in_base[:2, 3]
        distance = np.linalg.norm(pole - camera)
        ahead = (pole - camera) / distance
        along = max(grid.cell_size, self._view.depth_sigma(distance))
        offsets = grid.occupied_near(pole, along) - pole
        beside = np.abs(offsets @ [-ahead[1], ahead[0]])
        return bool(np.any((np.abs(offsets @ ahead) <= along) & (beside <= grid.cell_size)))


def _among(cells, others):
    """Returns whether each of the cells (n x 2) is one of the others (m x 2)."""
    known = {tuple(cell) for cell in others}
    return np.array([tuple(cell) in known for cell in cells], dtype=bool)
