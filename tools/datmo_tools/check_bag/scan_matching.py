# SPDX-License-Identifier: BSD-3-Clause
"""Estimates the motion between two scans by point-to-line registration, from the scans alone.

Source: Censi, "An ICP variant using a point-to-line metric", ICRA 2008.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

MAX_POINTS = 300  # of the later scan that are matched
STEPS = 20
MIN_PAIRS = 20
MAX_GAP = 6.0  # times the median distance between neighbors: farther ones form no line


class ScanMatch(NamedTuple):
    """The later scanner's pose in the frame of the earlier one."""

    motion: np.ndarray  # x, y (m), yaw (rad)
    residual: float  # m, median distance of matched points from their lines
    share: float  # 0 to 1, of the points that are matched
    weakest: float  # 0 to 0.5: share of the lines that constrains the least certain direction


class Outline:
    """A scan as points with normals, for matching other scans with it."""

    def __init__(self, scan):
        hits = np.flatnonzero(scan.hits)
        bearings, ranges = scan.bearings[hits], scan.ranges[hits]
        self.points = np.column_stack([ranges * np.cos(bearings), ranges * np.sin(bearings)])
        self.reach = float(np.percentile(ranges, 90)) if len(ranges) else 0.0
        self._line_points, self._normals = self._lines(scan.angle_increment, ranges)
        self._tree = cKDTree(self._line_points) if len(self._line_points) else None

    def _lines(self, spacing, ranges):
        """Returns points whose neighbors on both sides are near, and the normals there."""
        if len(self.points) < 3:
            return np.zeros((0, 2)), np.zeros((0, 2))
        before, middle, after = self.points[:-2], self.points[1:-1], self.points[2:]
        limit = np.maximum(MAX_GAP * abs(spacing) * ranges[1:-1], 0.05)
        near = np.linalg.norm(middle - before, axis=1) < limit
        near &= np.linalg.norm(after - middle, axis=1) < limit
        along = (after - before)[near]
        length = np.linalg.norm(along, axis=1)
        kept = length > 1e-6
        normals = np.column_stack([-along[:, 1], along[:, 0]])[kept] / length[kept, None]
        return middle[near][kept], normals

    def match(self, later, guesses):
        """Returns the best ScanMatch of a `later` Outline from guesses (x, y, yaw), or None."""
        if self._tree is None or len(later.points) < MIN_PAIRS:
            return None
        points = later.points[:: max(1, len(later.points) // MAX_POINTS)]
        found = [self._refined(points, np.array(guess, dtype=float)) for guess in guesses]
        found = [match for match in found if match is not None]
        return min(found, key=lambda match: match.residual / max(match.share, 0.1), default=None)

    def _refined(self, points, motion):
        gate = max(0.06 * self.reach, 0.2)
        minimum = max(0.006 * self.reach, 0.03)
        for _ in range(STEPS):
            pairs = self._pairs(points, motion, gate)
            if pairs is None:
                return None
            step = _step(*pairs)
            motion = _moved(motion, step)
            if np.abs(step).max() < 1e-4 and gate <= minimum:
                break
            gate = max(0.7 * gate, minimum)
        return self._result(points, motion, minimum)

    def _pairs(self, points, motion, gate):
        moved = _applied(points, motion)
        distances, nearest = self._tree.query(moved, distance_upper_bound=gate)
        matched = np.isfinite(distances)
        if matched.sum() < MIN_PAIRS:
            return None
        nearest = nearest[matched]
        normals = self._normals[nearest]
        gaps = np.sum((moved[matched] - self._line_points[nearest]) * normals, axis=1)
        return moved[matched], normals, gaps, motion[:2]

    def _result(self, points, motion, gate):
        pairs = self._pairs(points, motion, gate)
        if pairs is None:
            return None
        moved, normals, gaps, _ = pairs
        spread = np.linalg.eigvalsh(normals.T @ normals)[0] / len(normals)
        return ScanMatch(
            motion, float(np.median(np.abs(gaps))), len(moved) / len(points), float(spread)
        )


def _step(points, normals, gaps, center):
    """Returns the Gauss-Newton step (x, y, yaw about the scanner) on the distances to the lines."""
    arms = points - center
    jacobian = np.column_stack([normals, arms[:, 0] * normals[:, 1] - arms[:, 1] * normals[:, 0]])
    scale = max(1.5 * np.median(np.abs(gaps)), 1e-4)
    weights = 1.0 / (1.0 + (gaps / scale) ** 2)
    weighted = jacobian * weights[:, None]
    normal_matrix = weighted.T @ jacobian + 1e-6 * len(gaps) * np.eye(3)
    return -np.linalg.solve(normal_matrix, weighted.T @ gaps)


def _moved(motion, step):
    return np.array([motion[0] + step[0], motion[1] + step[1], motion[2] + step[2]])


def _applied(points, motion):
    cosine, sine = math.cos(motion[2]), math.sin(motion[2])
    x = motion[0] + cosine * points[:, 0] - sine * points[:, 1]
    y = motion[1] + sine * points[:, 0] + cosine * points[:, 1]
    return np.column_stack([x, y])
