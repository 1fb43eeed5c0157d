# SPDX-License-Identifier: BSD-3-Clause
"""Reads what evaluate draw_borders shows: a run's borders at some stamps, and their surroundings."""

import bisect
from typing import NamedTuple, Optional

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools import transforms
from datmo_tools.errors import InputError
from datmo_tools.evaluate.border_lists import BORDERS, TRUE_BORDERS, border_list
from datmo_tools.evaluate.nearest_messages import check_kinds, nearest_messages, stamps_of, topics_of
from datmo_tools.evaluate.outlines import corners
from datmo_tools.evaluate.truth import MAX_GAP, NONE, TRUE_OBJECTS, TRUE_POSE, Asked, Region, Truth
from datmo_tools.pose_path import planar, read_path
from datmo_tools.stamps import NANOSECONDS

LABELED_SCAN, POSE = "/labeled_scan", "/pose"
OBJECTS, DROPPED = "/objects", "/objects/dropped"

KINDS = {
    BORDERS: "datmo_fusion/RoadBorders",
    LABELED_SCAN: "datmo_fusion/LabeledScan",
    OBJECTS: "datmo_fusion/ObjectArray",
    DROPPED: "datmo_fusion/DroppedObjects",
    TRUE_BORDERS: "datmo_fusion/TrueRoadBorders",
    TRUE_OBJECTS: "datmo_fusion/TrueObjectArray",
}

TRUE_REGION = Region(80.0)  # of true objects to draw


class TrueRoad(NamedTuple):
    """The truth at a stamp, in base_link by its true pose: the map's drift does not count."""

    borders: list  # of n x 2 arrays, m
    boxes: list  # of 4 x 2 arrays, m: the corners of true objects
    at_intersection: Optional[bool]  # None: unknown


class Moment(NamedTuple):
    """A run at the stamp of one of its lists of borders."""

    stamp: int  # ns
    time: float  # s since the run's first borders
    base: np.ndarray  # estimated x, y (m), yaw (rad) of base_link in the map
    borders: list  # of SeenBorder
    at_intersection: bool
    intersection_probability: float
    points: np.ndarray  # n x 2, m, base_link: end points of the scan's beams
    states: np.ndarray  # n, ScanPoint.STATIC, MOVING, UNKNOWN
    earlier: np.ndarray  # n x 2, m, base_link: the same for earlier scans
    moving: list  # of 4 x 2 arrays, m, base_link: the corners of apparently moving objects
    others: list  # the same for the other objects
    dropped: list  # the same for those that the borders removed
    truth: Optional[TrueRoad]  # None: unknown


class Run:
    """A bag of run_bag --road-border."""

    def __init__(self, path):
        """path: of the bag (Path). Raises InputError without borders or poses."""
        self._path = path
        topics = topics_of(path)
        check_kinds(path, topics, KINDS)
        if BORDERS not in topics:
            raise InputError(f"{path}: nothing on {BORDERS}, expected a bag with road borders")
        self.poses = read_path(path, POSE)
        self.stamps = stamps_of(path, BORDERS)
        self._has_truth = TRUE_OBJECTS in topics and TRUE_POSE in topics

    @property
    def duration(self):
        """Returns the time (s) from the first to the last list of borders."""
        return (self.stamps[-1] - self.stamps[0]) / NANOSECONDS

    def nearest_stamps(self, times):
        """Returns the increasing stamps (ns) of the lists of borders nearest to times (s since the
        first one), each once. Raises InputError for a time outside of the run."""
        for time in times:
            if not 0.0 <= time <= self.duration:
                raise InputError(
                    f"{self._path}: no borders at {time:g} s, expected 0 to {self.duration:.2f} s"
                )
        stamps = np.array(self.stamps) - self.stamps[0]
        rows = {int(np.argmin(np.abs(stamps - time * NANOSECONDS))) for time in times}
        return [self.stamps[row] for row in sorted(rows)]

    def moments(self, stamps, history):
        """Returns a list of Moment of some of `self.stamps`; history: s, of earlier scans."""
        found = nearest_messages(self._path, (BORDERS, OBJECTS, DROPPED), stamps)
        found.update(self._scans(stamps, history))
        truths = self._truths(stamps) if self._has_truth else {}
        return [self._moment(stamp, found, history, truths.get(stamp)) for stamp in stamps]

    def _scans(self, stamps, history):
        """Like nearest_messages, for all scans that are shown."""
        shown = {
            self.stamps[row]
            for stamp in stamps
            for row in range(*self._rows(stamp - round(history * NANOSECONDS), stamp))
        }
        return nearest_messages(self._path, [LABELED_SCAN], sorted(shown))

    def _rows(self, begin, end):
        """Returns the first of `self.stamps` from `begin` on, and the one after `end` (ns)."""
        return bisect.bisect_left(self.stamps, begin), bisect.bisect_right(self.stamps, end)

    def _moment(self, stamp, found, history, truth):
        road, scans, base = found[BORDERS][stamp], found[LABELED_SCAN], self.poses.at(stamp)
        points = scans[stamp].points if stamp in scans else []
        objects, dropped = (found[topic].get(stamp) for topic in (OBJECTS, DROPPED))
        kept = objects.objects if objects else []
        rows = self._rows(stamp - round(history * NANOSECONDS), stamp - 1)
        earlier = [
            transforms.points_seen_from(base, _in_map(scans[other]))
            for other in self.stamps[slice(*rows)]
            if other in scans
        ]
        return Moment(
            stamp,
            (stamp - self.stamps[0]) / NANOSECONDS,
            base,
            border_list(self._path, road).borders,
            road.at_intersection,
            road.intersection_probability,
            _positions(points),
            np.array([point.state for point in points], dtype=int),
            np.concatenate([np.empty((0, 2)), *earlier]),
            [_box(item) for item in kept if item.dynamic_state == Object.STATE_MOVING],
            [_box(item) for item in kept if item.dynamic_state != Object.STATE_MOVING],
            [_box(item.object) for item in dropped.objects] if dropped else [],
            truth,
        )

    def _truths(self, stamps):
        """Returns a dictionary stamp -> TrueRoad."""
        truth = Truth(self._path)
        tolerance = round(MAX_GAP * NANOSECONDS)
        roads = nearest_messages(self._path, [TRUE_BORDERS], stamps, tolerance)[TRUE_BORDERS]
        truths = {}
        for stamp in stamps:
            states = truth.at(stamp, Asked(TRUE_REGION, NONE))
            if states is not None:
                road, base = roads.get(stamp), truth.base_at(stamp)
                borders = road.borders if road else []
                truths[stamp] = TrueRoad(
                    [transforms.points_seen_from(base, _positions(border.points)) for border in borders],
                    [corners(state.pose, state.size) for state in states if state.asked],
                    road.at_intersection if road else None,
                )
        return truths


def edge(border, sigmas):
    """Returns points (n x 2, m, map) this many standard deviations to the left of a SeenBorder."""
    along = np.gradient(border.points, axis=0)
    lengths = np.maximum(np.hypot(along[:, 0], along[:, 1]), np.finfo(float).tiny)
    normals = np.column_stack([-along[:, 1], along[:, 0]]) / lengths[:, np.newaxis]
    return border.points + (sigmas * border.sigma)[:, np.newaxis] * normals


def _in_map(scan):
    """Returns the end points (n x 2, m) of a LabeledScan, in the map by its own pose."""
    return transforms.points_in_parent(planar(scan.pose.pose), _positions(scan.points))


def _box(message):
    return corners(np.array(planar(message.pose)), np.array([message.size.x, message.size.y]))


def _positions(points):
    return np.array([(point.x, point.y) for point in points], dtype=float).reshape(-1, 2)
