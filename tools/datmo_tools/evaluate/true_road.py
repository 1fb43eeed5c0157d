# SPDX-License-Identifier: BSD-3-Clause
"""The true road around the path that a vehicle drove: where it ends to the left and to the right."""

import math
from typing import NamedTuple

import numpy as np
from shapely.geometry import LineString

from datmo_tools import transforms
from datmo_tools.evaluate.border_lists import read_true_borders
from datmo_tools.evaluate.parked_rows import depths_of_vehicles, parked_boxes, row_of
from datmo_tools.evaluate.segments import BATCH, Segments, ray_crossings, segments_of
from datmo_tools.evaluate.truth import TRUE_POSE
from datmo_tools.pose_path import read_path

SPACING = 0.5  # m, of the stations

# m, by which the path is extended straight before the first pose and after the last one.
BEYOND = 50.0

# m, to either side of the path: as far as in the thesis, 25 windows of 0.9 m.
REACH = 22.5

# rad: a curb is parallel to the road; one that deviates by more is of another road.
MAX_SLANT = math.radians(45.0)

# The road's curvature is the change of its curb's heading over twice this, m: longer than the
# straight segments that bends consist of.
CURVATURE_BASE = 15.0

# m: a junction begins this far before the first scan in it, at 16 m/s.
JUNCTION_MARGIN = 1.0

# m: positions of two consecutive scans in the same junction are nearer to each other.
MAX_STEP = 5.0

TURN = {"left": 0.5 * math.pi, "right": -0.5 * math.pi}


class Stations(NamedTuple):
    """n stations along the path, in the map of the truth."""

    arc_length: np.ndarray  # n, m from the first pose
    positions: np.ndarray  # n x 2, m
    headings: np.ndarray  # n, rad
    at_intersection: np.ndarray  # n, bool

    def between(self, first, last):
        """Returns the slice of those from one arc length (m) to another."""
        return slice(*np.searchsorted(self.arc_length, [first, last]).tolist())


class TrueSide(NamedTuple):
    """One side of the road; distances in m across the path, NaN without a curb."""

    curb: np.ndarray  # n, to the curb
    row: np.ndarray  # n, to the line of parked vehicles; NaN: none
    open: np.ndarray  # n, bool: in a gap of the row, both curb and row are right
    curved: np.ndarray  # n, bool
    cosine: np.ndarray  # n, from distances across the path to those across the border

    def errors(self, seen):
        """Returns errors (n, m across the border) of borders `seen`; positive: too far out."""
        to_curb, to_row = seen - self.curb, seen - self.row
        with np.errstate(invalid="ignore"):
            curb = np.isnan(self.row) | (self.open & (np.abs(to_curb) < np.abs(to_row)))
        return np.where(curb, to_curb, to_row) * self.cosine

    def curb_errors(self, seen):
        """Returns the same relative to the curb, with or without parked vehicles."""
        return (seen - self.curb) * self.cosine

    def innermost(self):
        """Returns the nearest end of the road, n, m across the path."""
        return np.fmin(self.curb, self.row)

    def part(self, part):
        """Returns the TrueSide of some of the stations (slice)."""
        return TrueSide(*(values[part] for values in self))


class TrueRoad:
    """The road of one drive.

    poses: PosePath of the vehicle; stations: Stations; sides: dictionary left, right -> TrueSide;
    lines: LineStrings of everything that ends a road.
    """

    def __init__(self, path, rows, curve_radius):
        """path: bag (Path); rows: RowOptions; curve_radius: m, a road is a curve below it.

        Raises InputError if the truth is missing.
        """
        borders = read_true_borders(path)
        self.poses = poses = read_path(path, TRUE_POSE)
        boxes = parked_boxes(path)
        curbs = segments_of(borders.curbs)
        self._start = int(poses.stamps[0])
        self._seconds = _seconds(poses.stamps, self._start)
        steps = np.hypot(*np.diff(poses.poses[:, :2], axis=0).T)
        self._arc_length = np.concatenate([[0.0], np.cumsum(steps)])
        crossed = np.interp(
            _seconds(borders.stamps[borders.at_intersection], self._start), self._seconds, self._arc_length
        )
        self.stations = _stations(self._arc_length, poses.poses, curbs, crossed)
        self.sides = {
            name: _side(self.stations, turn, curbs, boxes, rows, curve_radius)
            for name, turn in TURN.items()
        }
        self.lines = _lines(self.stations, self.sides, borders.curbs, boxes)

    def arc_length_at(self, stamp):
        """Returns the vehicle's arc length along the path at `stamp` (ns), m."""
        return float(np.interp(_seconds(stamp, self._start), self._seconds, self._arc_length))


def _seconds(stamps, start):
    return (np.asarray(stamps) - start) * 1e-9


def _stations(arc_length, poses, curbs, crossed):
    """crossed: m along the path, of stamps at which the vehicle is at an intersection."""
    moved = np.concatenate([[True], np.diff(arc_length) > 0.0])
    arc_length, poses = arc_length[moved], poses[moved]
    before = _free_distance(poses[0, :2], poses[0, 2] + math.pi, curbs)
    after = _free_distance(poses[-1, :2], poses[-1, 2], curbs)
    at = SPACING * np.arange(-int(before / SPACING), int((arc_length[-1] + after) / SPACING) + 1)
    inside = np.clip(at, arc_length[0], arc_length[-1])
    headings = np.interp(inside, arc_length, np.unwrap(poses[:, 2]))
    over = (at - inside)[:, np.newaxis] * np.stack([np.cos(headings), np.sin(headings)], axis=-1)
    positions = np.stack([np.interp(inside, arc_length, poses[:, i]) for i in range(2)], axis=-1) + over
    return Stations(at, positions, headings, _marked(at, crossed))


def _free_distance(position, heading, curbs):
    """Returns how far it is straight on without a curb across, at most BEYOND."""
    distances, _ = ray_crossings(position[np.newaxis], np.array([heading]), curbs)
    ahead = distances[(distances > 0.0) & (distances < BEYOND)]
    return float(ahead.min()) if len(ahead) else BEYOND


def _marked(at, crossed):
    """Returns which stations are at one of the stations `crossed`, or between two of a junction."""
    marks = np.sort(crossed)
    if not len(marks):
        return np.zeros(len(at), dtype=bool)
    after = np.clip(np.searchsorted(marks, at), 0, len(marks) - 1)
    before = np.maximum(after - 1, 0)
    near = np.minimum(np.abs(marks[after] - at), np.abs(marks[before] - at)) <= JUNCTION_MARGIN
    between = (marks[before] <= at) & (at <= marks[after])
    return near | (between & (marks[after] - marks[before] <= MAX_STEP))


def _side(stations, turn, curbs, boxes, rows, curve_radius):
    rays = stations.headings + turn
    curb, curb_headings = _curb(stations, rays, curbs)
    bounded = np.isfinite(curb) & ~stations.at_intersection
    near, far = _box_sides(stations.positions, rays, boxes)
    row = row_of(depths_of_vehicles(curb, near, far), bounded, SPACING, rows)
    slant = transforms.normalize_angle(curb_headings - stations.headings)
    return TrueSide(curb, curb - row.depth, row.open,
                    _curvatures(curb_headings, bounded) > 1.0 / curve_radius,
                    np.cos(np.nan_to_num(slant)))  # fmt: skip


def _curb(stations, rays, curbs):
    """Returns distance and heading (along the path) of the nearest curb; NaN: not along it."""
    curb, headings = np.full((2, len(rays)), np.nan)
    if not len(curbs.begin):
        return curb, headings
    of_curbs = curbs.headings()
    for first in range(0, len(rays), BATCH):
        part = slice(first, first + BATCH)
        distances, _ = ray_crossings(stations.positions[part], rays[part], curbs)
        with np.errstate(invalid="ignore"):
            distances = np.where((distances > 0.0) & (distances <= REACH), distances, np.inf)
        nearest = np.argmin(distances, axis=1)
        found = distances[np.arange(len(nearest)), nearest]
        slant = _as_line(of_curbs[nearest] - stations.headings[part])
        runs_along = np.isfinite(found) & (np.abs(slant) <= MAX_SLANT)
        curb[part] = np.where(runs_along, found, np.nan)
        headings[part] = np.where(runs_along, stations.headings[part] + slant, np.nan)
    return curb, headings


def _as_line(angle):
    """Returns the angle of an undirected line, rad, in [-pi/2, pi/2)."""
    return (angle + 0.5 * math.pi) % math.pi - 0.5 * math.pi


def _box_sides(positions, rays, boxes):
    """Returns distances (n x k, m) at which rays enter and leave k boxes; NaN if they miss one."""
    near, far = np.full((2, len(rays), len(boxes)), np.nan)
    if not len(boxes):
        return near, far
    edges = _edges(boxes)
    for first in range(0, len(rays), BATCH):
        part = slice(first, first + BATCH)
        distances, _ = ray_crossings(positions[part], rays[part], edges)
        distances = distances.reshape(-1, len(boxes), 4)
        # Along one side of a box, rounding decides which corners a ray hits: one alone is a miss.
        hit = np.count_nonzero(distances > 0.0, axis=2) > 1
        near[part] = np.where(hit, np.nanmin(distances, axis=2, initial=np.inf), np.nan)
        far[part] = np.where(hit, np.nanmax(distances, axis=2, initial=-np.inf), np.nan)
    return near, far


def _edges(boxes):
    return Segments(boxes.reshape(-1, 2), np.roll(boxes, -1, axis=1).reshape(-1, 2))


def _curvatures(headings, bounded):
    """Returns n, 1/m, not negative: the curvature of the curb at each station; 0 without one."""
    half = int(CURVATURE_BASE / SPACING)
    curvatures = np.zeros(len(headings))
    starts = np.flatnonzero(np.diff(np.concatenate([[0], bounded.astype(int)])) == 1)
    for start in starts:
        end = start + int(np.argmin(np.append(bounded[start:], False)))
        index = np.arange(start, end)
        first, last = np.maximum(index - half, start), np.minimum(index + half, end - 1)
        turned = np.abs(headings[last] - headings[first])
        curvatures[index] = turned / (SPACING * np.maximum(last - first, half))
    return curvatures


def _lines(stations, sides, curbs, boxes):
    """Returns LineStrings of all that ends a road: curbs, parked vehicles, lines of their rows."""
    lines = [*curbs, *(np.concatenate([corners, corners[:1]]) for corners in boxes)]
    for name, side in sides.items():
        rays = stations.headings + TURN[name]
        across = np.stack([np.cos(rays), np.sin(rays)], axis=-1)
        rows = stations.positions + side.row[:, np.newaxis] * across
        known = np.flatnonzero(np.isfinite(side.row))
        pieces = np.split(known, np.flatnonzero(np.diff(known) > 1) + 1)
        lines += [rows[piece] for piece in pieces if len(piece) > 1]
    return [LineString(np.asarray(line)[:, :2]) for line in lines if len(line) > 1]
