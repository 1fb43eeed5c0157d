# SPDX-License-Identifier: BSD-3-Clause
"""Finds published borders where nothing ends the road."""

from typing import NamedTuple

import numpy as np
from shapely.geometry import MultiLineString, Point

from datmo_tools.evaluate.border_errors import AHEAD
from datmo_tools.stamps import NANOSECONDS

STEP = 0.5  # m, between the sampled points of a border

# m, from which a false segment is listed
MIN_LENGTH = 3.0

# m and s: false segments of two messages that are not farther apart are one.
MAX_APART, MAX_PAUSE = 10.0, 1.0

# Where a false stretch is: on the carriageway, in a junction, beyond the true border, or where the
# truth knows no border.
ROAD, JUNCTION, BEYOND, OPEN = WHERE = ("road", "junction", "beyond", "open")

# m before and behind the vehicle: the part of the path that a false segment may be next to.
BESIDE = 60.0


class Stretch(NamedTuple):
    """A false segment of one border in one message."""

    stamp: int  # ns
    side: str
    where: str  # of WHERE
    length: float  # m
    middle: np.ndarray  # x, y in the map of the truth


def score_false(frames, road, gate):
    """Returns the score of the false borders in some Frames, which JSON can hold.

    gate: m, a border is false farther than this from any curb, parked vehicle and its row. Only
    what is within AHEAD of the vehicle is evaluated.
    """
    published = 0.0
    lengths = dict.fromkeys(WHERE, 0.0)
    stretches, affected = [], 0
    for frame in frames:
        total, found = _false_stretches(frame, road, gate)
        published += total
        for item in found:
            lengths[item.where] += item.length
        long = [item for item in found if item.length >= MIN_LENGTH]
        affected += bool(long)
        stretches += long
    wrong = sum(lengths.values())
    return {
        "published_m": published,
        "false_m": wrong,
        "false_share": wrong / published if published else None,
        "by_where_m": lengths,
        "lists": len(frames),
        "lists_with_false": affected,
        "episodes": [_account(item) for item in _episodes(stretches)],
    }


def _false_stretches(frame, road, gate):
    """Returns the length of what is published (m), and its false Stretches."""
    base = road.poses.at(frame.stamp)[:2]
    near = [line for line in road.lines if line.distance(Point(base)) <= AHEAD + gate]
    lines = MultiLineString(near)
    total, found = 0.0, []
    for border, line in frame.lines:
        positions = _resampled(line)
        positions = positions[np.hypot(*(positions - base).T) <= AHEAD]
        total += STEP * len(positions)
        false = np.array([i for i, position in enumerate(positions)
                          if not near or lines.distance(Point(position)) > gate], dtype=int)
        for run in np.split(false, np.flatnonzero(np.diff(false) > 1) + 1):
            if len(run):
                middle = positions[run[len(run) // 2]]
                where = _where(middle, frame.arc_length, road, gate)
                found.append(Stretch(frame.stamp, border.side, where, STEP * len(run), middle))
    return total, found


def _resampled(line):
    arc_length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.arange(0.5 * STEP, arc_length[-1], STEP)
    return np.stack([np.interp(at, arc_length, line[:, i]) for i in range(2)], axis=-1)


def _where(position, arc_length, road, gate):
    part = road.stations.between(arc_length - BESIDE, arc_length + BESIDE)
    apart = position - road.stations.positions[part]
    nearest = part.start + int(np.argmin(np.hypot(*apart.T)))
    if road.stations.at_intersection[nearest]:
        return JUNCTION
    heading = road.stations.headings[nearest]
    left = np.array([-np.sin(heading), np.cos(heading)])
    offset = float((position - road.stations.positions[nearest]) @ left)
    side = road.sides["left" if offset > 0.0 else "right"]
    end = side.innermost()[nearest]
    if np.isnan(end):
        return OPEN
    return ROAD if abs(offset) < end - gate else BEYOND


def _episodes(stretches):
    """Returns lists of consecutive Stretches of the same side and sort."""
    episodes = []
    for item in stretches:
        last = next((one for one in reversed(episodes) if _continues(one[-1], item)), None)
        if last is None:
            episodes.append([item])
        else:
            last.append(item)
    return episodes


def _continues(last, item):
    pause = (item.stamp - last.stamp) / NANOSECONDS
    apart = np.hypot(*(item.middle - last.middle))
    same = (last.side, last.where) == (item.side, item.where)
    return same and pause <= MAX_PAUSE and apart <= MAX_APART


def _account(episode):
    longest = max(episode, key=lambda item: item.length)
    return {
        "from_s": episode[0].stamp / NANOSECONDS,
        "to_s": episode[-1].stamp / NANOSECONDS,
        "lists": len({item.stamp for item in episode}),
        "side": longest.side,
        "where": longest.where,
        "longest_m": longest.length,
        "position_m": [round(float(value), 2) for value in longest.middle],
    }
