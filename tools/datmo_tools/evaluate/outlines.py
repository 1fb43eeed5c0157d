# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor sees of a box, and the distance of two boxes of one object.

Sensors see different parts of an object, but they all see its near side ("middle point of the
front line segment", thesis 3.3.2). Compared is what both saw: the range in the middle of the
bearings that both boxes share, and the bearings of the corners.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms

# Corners in order: front left, rear left, rear right, front right; and the side from each to the
# next one: left, rear, right, front.
CORNERS = 0.5 * np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])
SIDES = (2, 1, 3, 0)
NORMALS = np.array([(0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0)])

# More slanted sides are not used for range: an error across the line of sight changes it more
# (cosine of 60 degrees).
MIN_FACING = 0.5

# Corners whose directions differ by more than this are not the same (cosine of 30 degrees).
SAME_CORNER = np.cos(np.radians(30.0))

NEAREST = 0.1  # m: no line of sight to points nearer to the sensor
NEGLIGIBLE = 1e-9  # m^2


def corners(pose, size):
    """Returns 4 x 2, m: the corners of a box of length and width `size` with its center at a pose
    (x, y, yaw), in the frame of the pose; in order from the front left one."""
    return transforms.points_in_parent(pose, CORNERS * size)


class Hit(NamedTuple):
    """The point where a line of sight hits a box."""

    range: float  # m
    normal: np.ndarray  # x, y, outward, of the side
    facing: float  # cosine of the angle of incidence
    variance: float  # m^2, of the side by itself, along its normal; infinite: not seen


class Corner(NamedTuple):
    """The corner of two sides that were both seen."""

    bearing: float  # rad
    diagonal: np.ndarray  # x, y, outward, between both normals
    variance: float  # m^2, across the line of sight, of the sides by themselves


class Outline:
    """A box (Seen of object_lists) relative to a sensor."""

    def __init__(self, seen, viewpoint):
        """viewpoint: x, y (m) of the sensor."""
        self.covariance = seen.covariance
        self._corners = corners(seen.pose, seen.size) - np.asarray(viewpoint)
        yaw = seen.pose[2]
        turned = np.array([(np.cos(yaw), np.sin(yaw)), (-np.sin(yaw), np.cos(yaw))])
        self._normals = NORMALS @ turned
        self._variances = np.asarray(seen.side_variance)[list(SIDES)]
        center = np.asarray(seen.pose[:2]) - np.asarray(viewpoint)
        self.bearing = float(np.arctan2(center[1], center[0]))
        self._turns = transforms.normalize_angle(_bearings(self._corners) - self.bearing)
        # rad: of the right end, and of the left one.
        self.bearings = self.bearing + np.array([self._turns.min(), self._turns.max()])

    def corners(self):
        """Returns a list of Corner, in order; None for those that were not seen."""
        facing = np.sum(self._normals * self._corners, axis=1) < 0.0
        found = []
        for i, ray in enumerate(self._corners):
            meeting = [i, i - 1]
            if not (np.all(np.isfinite(self._variances[meeting])) and np.any(facing[meeting])):
                found.append(None)
                continue
            across = np.array([-ray[1], ray[0]]) / max(float(np.hypot(*ray)), NEAREST)
            variance = self._variances[meeting] @ (self._normals[meeting] @ across) ** 2
            diagonal = self._normals[meeting].sum(axis=0) / np.sqrt(2.0)
            found.append(Corner(self.bearing + self._turns[i], diagonal, float(variance)))
        return found

    def hit(self, bearing):
        """Returns the Hit of the line of sight at a bearing (rad); None: a miss, or from inside."""
        along = np.array([np.cos(bearing), np.sin(bearing)])
        facing = -self._normals @ along
        best = None
        for i in np.flatnonzero(facing > 0.0):
            reach = -float(self._normals[i] @ self._corners[i]) / float(facing[i])
            edge = self._corners[(i + 1) % 4] - self._corners[i]
            step, whole = float((reach * along - self._corners[i]) @ edge), float(edge @ edge)
            within = whole > NEGLIGIBLE and -NEGLIGIBLE <= step <= whole + NEGLIGIBLE
            if within and reach > NEAREST and (best is None or reach < best.range):
                normal, variance = self._normals[i], float(self._variances[i])
                best = Hit(reach, normal, float(facing[i]), variance)
        return best

    def near_point(self):
        """Returns where the line of sight in the middle of its bearings hits it (x, y, m, relative
        to the sensor); its center if none does."""
        bearing = float(np.mean(self.bearings))
        found = self.hit(bearing)
        if found is None:
            return self._corners.mean(axis=0)
        return found.range * np.array([np.cos(bearing), np.sin(bearing)])


class Offset(NamedTuple):
    """Distance of an object from another one that it is compared with.

    In arrays of two, the first is along the line of sight, the second across it.
    """

    range: float  # m, of the other one
    value: np.ndarray  # m; NaN: not seen by both. Positive: too far, too far to the left
    jacobian: np.ndarray  # 2 x 2, of the value by the position of the box
    sides_variance: np.ndarray  # 2, m^2, by the variances of the one's own sides
    other_covariance: np.ndarray  # 2 x 2, m^2, from all of the other one's own


def offset(outline, other):
    """Returns the Offset of an Outline from another one, relative to the same sensor."""
    common = 0.5 * (
        max(outline.bearings[0], _near(other.bearings[0], outline.bearing))
        + min(outline.bearings[1], _near(other.bearings[1], outline.bearing))
    )
    value = np.full(2, np.nan)
    sides, others = np.zeros(2), np.zeros(2)
    jacobians = np.zeros((2, 2, 2))
    hits = outline.hit(common), other.hit(common)
    reach = float(np.hypot(*other.near_point()))
    if all(hit is not None and hit.facing >= MIN_FACING for hit in hits):
        reach = hits[1].range
        if all(np.isfinite(hit.variance) for hit in hits):
            value[0] = hits[0].range - reach
            sides[0], others[0] = (hit.variance / hit.facing**2 for hit in hits)
            jacobians[:, 0] = [-hit.normal / hit.facing for hit in hits]
    pairs = _same_corners(outline, other)
    if pairs:
        turns = [_near(one.bearing - its.bearing, 0.0) for one, its in pairs]
        value[1] = reach * np.mean(turns)
        variances = np.array([(one.variance, its.variance) for one, its in pairs])
        sides[1], others[1] = variances.sum(axis=0) / len(pairs) ** 2
        jacobians[:, 1] = [-np.sin(common), np.cos(common)]
    covariance = jacobians[1] @ other.covariance @ jacobians[1].T + np.diag(others)
    return Offset(reach, value, jacobians[0], sides, covariance)


def _same_corners(outline, other):
    """Returns the pairs of Corner that both saw."""
    theirs = [corner for corner in other.corners() if corner is not None]
    return [
        (one, its)
        for one in outline.corners()
        if one is not None
        for its in theirs
        if one.diagonal @ its.diagonal >= SAME_CORNER
    ]


def _near(bearing, middle):
    """Returns the same bearing, within half a turn of another one."""
    return middle + float(transforms.normalize_angle(bearing - middle))


def _bearings(rays):
    return np.arctan2(rays[:, 1], rays[:, 0])
