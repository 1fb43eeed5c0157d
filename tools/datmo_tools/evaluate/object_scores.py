# SPDX-License-Identifier: BSD-3-Clause
"""Scores objects of one measurement against true ones: found, false, and their errors."""

from typing import NamedTuple

import numpy as np
from shapely.geometry import MultiPoint, Point

from datmo_tools.evaluate.object_lists import Seen
from datmo_tools.evaluate.outlines import Outline, corners, offset
from datmo_tools.evaluate.pair_choice import nearest_pairs

# An object is near a true one within this distance of its box: across the line of sight, and along
# it, where it grows with the range by thesis 3.3.3 (5 m at 36 m; see THESIS_GATE).
NEAR_ACROSS = 1.0  # m
NEAR_ALONG = 1.0  # m, at least

THESIS_GATE = 5.0 / 36.0  # m per meter of range: up to here a stereo object is the lidar's

CENTER_WEIGHT = 1e-6  # 1/m: decides only between equal distances

# 95 % of chi-square with two degrees of freedom.
GATE_95 = 5.991


class TrueState(NamedTuple):
    """A true object at a stamp, in base_link."""

    pose: np.ndarray  # x, y (m), yaw (rad)
    size: np.ndarray  # m: length, width
    velocity: np.ndarray  # m/s over ground: vx, vy
    classification: int  # Object.CLASS_*
    moving: bool
    asked: bool  # it has to be found: in the region, and visible to the sensor
    source: object = None  # the TrueObject that it comes from

    @property
    def range(self):
        """Returns the center's distance, m from base_link."""
        return float(np.hypot(*self.pose[:2]))

    def after(self, delay):
        """Returns the state predicted by this time (s)."""
        moved = np.append(self.pose[:2] + self.velocity * delay, self.pose[2])
        return self._replace(pose=moved)

    def box(self):
        """Returns it as an ideal sensor would see it."""
        exact = np.zeros((2, 2)), np.zeros(4)
        return Seen(self.pose, self.size, *exact, self.classification, 0.0)


class Errors(NamedTuple):
    """Error of an object's near side relative to the true object it is of; NaN: not seen."""

    along: float  # m, along the line of sight: positive is too far
    across: float  # m, to the left
    nees: float  # of both, by the object's own covariance


class ListScore(NamedTuple):
    """The matches of one list."""

    matches: list  # of (index of the object, index of the true one, Errors), each index once
    near: np.ndarray  # n objects: whether a true object is near


class ListWithTruth(NamedTuple):
    """A list of objects and the truth at its stamp."""

    objects: list  # of Seen
    truths: list  # of TrueState
    viewpoint: tuple = (0.0, 0.0)  # of the sensor, m
    stamp: int = 0  # ns


def score_lists(lists):
    """Returns the ListScore of each ListWithTruth. Matches: as many pairs as possible, one to one,
    with the least sum of distances; of equal ones, that with the nearer centers. Raises
    InputError."""
    distances = [_distances(item) for item in lists]
    chosen_pairs = nearest_pairs([_costs(*both) for both in zip(lists, distances)])
    return [
        ListScore([(i, j, _errors(item.objects[i], item.truths[j], item.viewpoint)) for i, j in chosen],
                  np.any(apart <= 1.0, axis=1))
        for item, apart, chosen in zip(lists, distances, chosen_pairs)
    ]  # fmt: skip


def _distances(given):
    """Returns scaled_distance of each object from each true one; infinite: surely not near."""
    objects, truths, viewpoint = given.objects, given.truths, given.viewpoint
    distances = np.full((len(objects), len(truths)), np.inf)
    positions = np.array([truth.pose[:2] for truth in truths]).reshape(-1, 2)
    velocities = np.array([truth.velocity for truth in truths]).reshape(-1, 2)
    halves = np.array([0.5 * np.hypot(*truth.size) for truth in truths])
    for i, item in enumerate(objects):
        point = Outline(item, viewpoint).near_point() + viewpoint
        apart = np.linalg.norm(positions + velocities * item.delay - point, axis=1)
        for j in np.flatnonzero(apart <= halves + _along_gate(point, viewpoint)):
            distances[i, j] = scaled_distance(point, truths[j].after(item.delay), viewpoint)
    return distances


def scaled_distance(point, truth, viewpoint):
    """Returns the distance of a point (x, y) from the box of a TrueState, 0 inside; scaled to 1 at
    the limit of near, along the line of sight and across it."""
    ray = np.asarray(point) - np.asarray(viewpoint)
    reach = float(np.hypot(*ray))
    along = ray / reach if reach > 0.0 else np.array([1.0, 0.0])
    gate = _along_gate(point, viewpoint)
    axes = np.array([along / gate, np.array([-along[1], along[0]]) / NEAR_ACROSS])
    box = (corners(truth.pose, truth.size) - point) @ axes.T
    return MultiPoint(box).convex_hull.distance(Point(0.0, 0.0))


def _along_gate(point, viewpoint):
    """Returns the limit of near along the line of sight, m; at least that across."""
    reach = float(np.hypot(*(np.asarray(point) - np.asarray(viewpoint))))
    return max(NEAR_ALONG, THESIS_GATE * reach)


def _costs(given, distances):
    """Returns the distances of what is near, ordered by centers if they are equal; else infinite."""
    objects, truths = given.objects, given.truths
    centers = [[np.hypot(*(item.pose[:2] - truth.pose[:2])) for truth in truths] for item in objects]
    costs = distances + CENTER_WEIGHT * np.reshape(centers, distances.shape)
    return np.where(distances <= 1.0, costs, np.inf)


def _errors(item, truth, viewpoint):
    """Returns the Errors of the part of its near side that the object saw."""
    there = truth.after(item.delay).box()
    apart = offset(Outline(item, viewpoint), Outline(there, viewpoint))
    nees = np.nan
    if not np.any(np.isnan(apart.value)):
        covariance = apart.jacobian @ item.covariance @ apart.jacobian.T
        covariance += np.diag(apart.sides_variance)
        nees = float(apart.value @ np.linalg.solve(covariance, apart.value))
    return Errors(float(apart.value[0]), float(apart.value[1]), nees)
