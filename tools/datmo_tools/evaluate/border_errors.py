# SPDX-License-Identifier: BSD-3-Clause
"""Compares published borders with the true road, station by station along the path ahead."""

import math
from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.evaluate.segments import ray_crossings, segments_of
from datmo_tools.evaluate.track_frames import POSE
from datmo_tools.evaluate.true_road import MAX_SLANT, REACH, TURN
from datmo_tools.evaluate.truth import MAX_GAP
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS

# m of arc length, from the vehicle (base_link): the evaluated part.
BEHIND, AHEAD = 10.0, 40.0

# rad, between the headings of vehicle and path: stations beyond, around a corner, are not visible.
MAX_TURN = math.radians(60.0)


class Frame(NamedTuple):
    """One list of borders, aligned with the map of the truth at the vehicle's pose."""

    stamp: int  # ns
    arc_length: float  # m along the path, of the vehicle
    lines: list  # of (SeenBorder, its points in the map of the truth)


class Samples(NamedTuple):
    """n stations of many frames; equal indices in both sides' arrays are one station."""

    ahead: np.ndarray  # n, m along the path from the vehicle
    left: np.ndarray  # n, bool: of the left border
    curved: np.ndarray  # n, bool
    error: np.ndarray  # n, m, positive: too far out; NaN: no border was published
    curb_error: np.ndarray  # n, the same from the plain curb
    sigma: np.ndarray  # n, m, as published there

    def where(self, chosen):
        """Returns the Samples that are chosen (n, bool)."""
        return Samples(*(values[chosen] for values in self))


def frames_of(run, lists, road):
    """Returns a list of Frame of the BorderLists with a pose near in time, in the bag `run` (Path)
    and in the truth (TrueRoad): the vehicle's estimated pose is aligned with its true one, so that
    the map's drift does not count. Raises InputError."""
    poses = read_path(run, POSE)
    nearest = MAX_GAP * NANOSECONDS
    frames = []
    for item in lists:
        if max(poses.distance_from(item.stamp), road.poses.distance_from(item.stamp)) > nearest:
            continue
        base, true_base = poses.at(item.stamp), road.poses.at(item.stamp)
        lines = [(border, _moved(border.points, base, true_base)) for border in item.borders]
        frames.append(Frame(item.stamp, road.arc_length_at(item.stamp), lines))
    return frames


def samples_of(frames, road):
    """Returns the Samples of all stations outside of junctions that have a true border, from BEHIND
    to AHEAD of the vehicle and not around a corner."""
    parts = []
    for frame in frames:
        part = road.stations.between(frame.arc_length - BEHIND, frame.arc_length + AHEAD)
        turned = road.stations.headings[part] - road.poses.at(frame.stamp)[2]
        visible = np.abs(transforms.normalize_angle(turned)) <= MAX_TURN
        asked = visible & ~road.stations.at_intersection[part]
        for name, side in road.sides.items():
            seen, sigma = _seen(frame, road.stations, part, name)
            here = side.part(part)
            found = Samples(
                road.stations.arc_length[part] - frame.arc_length, np.full(len(seen), name == "left"),
                here.curved, here.errors(seen), here.curb_errors(seen), sigma)  # fmt: skip
            parts.append(found.where(asked & np.isfinite(here.curb)))
    return Samples(*(np.concatenate([np.empty(0), *values]) for values in zip(*parts)))


def _moved(points, base, true_base):
    seen = transforms.points_seen_from(base, points)
    return transforms.points_in_parent(true_base, seen)


def _seen(frame, stations, part, name):
    """Returns distance (m) across the path, and sigma (m), of the nearest border of that side at
    each station of the part (slice); NaN if there is none. A border that slants across the path is
    not the one along it; those of a side street, which are both on one side of the vehicle, are
    left and right borders where the path leads into it."""
    borders = [
        (border, line)
        for border, line in frame.lines
        if border.side_street or border.side == name
    ]
    segments = segments_of([line for _, line in borders])
    positions, headings = stations.positions[part], stations.headings[part]
    if not borders:
        return np.full((2, len(positions)), np.nan)
    distances, share = ray_crossings(positions, headings + TURN[name], segments)
    slant = transforms.normalize_angle(segments.headings() - headings[:, np.newaxis])
    along = np.abs(np.sin(slant)) <= np.sin(MAX_SLANT)
    of_street = _of_segments(borders, lambda item: np.full(len(item.sigma), item.side_street))
    with np.errstate(invalid="ignore"):
        along &= (np.abs(distances) <= REACH) & ((distances > 0.0) | ~of_street[0])
    far = np.where(along, np.abs(distances), np.inf)
    nearest = np.argmin(far, axis=1)
    rows = np.arange(len(positions))
    begin, end = (sigma[nearest] for sigma in _of_segments(borders, lambda item: item.sigma))
    there = np.isfinite(far[rows, nearest])
    share = share[rows, nearest]
    return (np.where(there, distances[rows, nearest], np.nan),
            np.where(there, begin + share * (end - begin), np.nan))  # fmt: skip


def _of_segments(borders, of_points):
    """Returns a SeenBorder function's values at begin and end of all its segments."""
    values = [of_points(border) for border, _ in borders]
    return (np.concatenate([item[:-1] for item in values]),
            np.concatenate([item[1:] for item in values]))  # fmt: skip
