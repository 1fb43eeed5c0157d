# SPDX-License-Identifier: BSD-3-Clause
"""Tracks of a run and the truth at their stamps, side by side."""

import bisect
from typing import NamedTuple, Optional

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools import transforms
from datmo_tools.evaluate.score_run import FrameMatches, matches
from datmo_tools.evaluate.truth import ANYTHING, Truth
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS

POSE = "/pose"  # estimated, of the run

# Road users; poles and trees are true objects, too.
ROAD_USERS = (Object.CLASS_PEDESTRIAN, Object.CLASS_CYCLIST, Object.CLASS_VEHICLE)

# s, for how long a list is up to date: like in the fusion of tracks.
MAX_LIST_AGE = 0.6


class Moment(NamedTuple):
    """The truth at one stamp, in base_link; arrays in the order of the objects."""

    base: np.ndarray  # true x, y (m), yaw (rad) of base_link in the map of the truth
    items: list  # of TrueObject, in the map of the truth
    ids: np.ndarray
    poses: np.ndarray  # n x 3: x, y (m), yaw (rad)
    sizes: np.ndarray  # n x 2, m: length, width
    movers: np.ndarray  # bool: whether it moves at some time of the drive
    users: np.ndarray  # bool: whether it is a road user, moving or not
    required: np.ndarray  # bool: whether it has to be found


class TrackFrame(NamedTuple):
    """One list of tracks; all lists about tracks are in their order."""

    stamp: int  # ns
    tracks: list  # of SeenTrack
    views: list  # of ViewFan, in the map of the run; none: unknown
    base: np.ndarray  # estimated x, y (m), yaw (rad) of base_link in the map of the run
    positions: np.ndarray  # n x 2, m, base_link
    moment: Moment
    distances: np.ndarray  # n x m, m, from the tracks to the boxes of the true objects
    matches: FrameMatches

    def counts(self, row):
        """Whether it is moving, and in the region or on an object that has to be found."""
        return self.tracks[row].id in self.matches.counted

    def is_false(self, row):
        """Whether it counts and is not on a true object that moves at some time."""
        return self.tracks[row].id in self.matches.false

    def near(self, row, gate, among):
        """Returns the true objects' indices (of those in the bool array `among`) within the gate
        (m)."""
        return np.flatnonzero((self.distances[row] <= gate) & among)


class Scene:
    """True objects around the vehicle, as seen from the run's pose: tracks are aligned to truth by
    the vehicle's estimated and true pose, so that the drift of the map does not count. score_run
    decides which track is of which object."""

    def __init__(self, run, drive, region, visible_to, gate):
        """run, drive: bags (Path); region: where objects have to be found; visible_to: sensor that
        must see them, ANY or NONE; gate: m, within which a track may be of an object. Raises
        InputError."""
        self._bags = run, drive
        self._options = {
            "region/range": region.range, "region/half_angle": region.half_angle,
            "truth/visible_to": visible_to, "truth/min_time_seen": 0.0, "matching/gate": gate,
        }  # fmt: skip
        self._truth = Truth(drive)
        self._truth.check_seen_by(visible_to)
        self._movers = self._truth.movers()
        self._poses = read_path(run, POSE)

    def frames(self, topic, lists):
        """Returns a list of TrackFrame for those lists of a topic (TrackList, by stamp) for which
        score_run has the truth."""
        found = matches(*self._bags, {**self._options, "topics/tracks": topic})
        frames = []
        for item in lists:
            states = self._truth.at(item.stamp, ANYTHING) if item.stamp in found else None
            if states is not None:
                moment = self._moment(item.stamp, states, found[item.stamp].required)
                frames.append(self._frame(item, moment, found[item.stamp]))
        return frames

    def _moment(self, stamp, states, required):
        ids = [state.source.id for state in states]
        return Moment(
            self._truth.base_at(stamp),
            [state.source for state in states],
            np.array(ids, dtype=int),
            np.array([state.pose for state in states]).reshape(-1, 3),
            np.array([state.size for state in states]).reshape(-1, 2),
            np.array([number in self._movers for number in ids], dtype=bool),
            np.array([state.classification in ROAD_USERS for state in states], dtype=bool),
            np.array([number in required for number in ids], dtype=bool),
        )

    def _frame(self, item, moment, matched):
        base = self._poses.at(item.stamp)
        poses = np.array([track.pose for track in item.tracks]).reshape(-1, 3)
        positions = transforms.relative(base, poses)[:, :2]
        distances = distances_to_boxes(positions, moment.poses, moment.sizes)
        return TrackFrame(
            item.stamp, item.tracks, item.views, base, positions, moment, distances, matched
        )


def distances_to_boxes(positions, poses, sizes):
    """Returns distances (n x m, m) of positions (n x 2) from boxes, 0 inside.

    poses: m x 3, x, y (m), yaw (rad) of their centers; sizes: m x 2, length, width (m).
    """
    outside = [
        np.maximum(np.abs(transforms.points_seen_from(pose, positions)) - 0.5 * size, 0.0)
        for pose, size in zip(poses, sizes)
    ]
    return np.linalg.norm(np.reshape(outside, (len(poses), len(positions), 2)), axis=2).T


class Newest:
    """Finds the newest of some items with a stamp (ns), at any time."""

    def __init__(self, items):
        """items: by increasing stamp."""
        self._items = items
        self._stamps = [item.stamp for item in items]

    def at(self, stamp):
        """Returns the newest one not after `stamp` (ns) and up to date; None: there is none."""
        after = bisect.bisect_right(self._stamps, stamp)
        if after == 0 or stamp - self._stamps[after - 1] > MAX_LIST_AGE * NANOSECONDS:
            return None
        return self._items[after - 1]


class Follow(NamedTuple):
    """What a track follows in some frames."""

    object: Optional[int]  # id of the true object that it is nearest to, over all of them
    frames: int
    near: int  # number of them in which it is within the gate of it

    @property
    def is_true(self):
        """Whether it follows the object in most of the frames."""
        return 2 * self.near > self.frames


def follow(observations, gate, among):
    """Returns the Follow of one track.

    observations: of (TrackFrame, row); among: function of a Moment, which true objects count (bool
    array). The object is the one with the least sum of distances, each of which counts as at most
    the gate (m).
    """
    gains, counts = {}, {}
    for frame, row in observations:
        for column in frame.near(row, gate, among(frame.moment)):
            number = int(frame.moment.ids[column])
            gains[number] = gains.get(number, 0.0) + gate - frame.distances[row, column]
            counts[number] = counts.get(number, 0) + 1
    if not gains:
        return Follow(None, len(observations), 0)
    best = max(gains, key=lambda number: (gains[number], counts[number], -number))
    return Follow(best, len(observations), counts[best])


def observations_of(frames, wanted=lambda frame, row: True):
    """Returns a dictionary track id -> list of (TrackFrame, row), of the selected rows."""
    observations = {}
    for frame in frames:
        for row, track in enumerate(frame.tracks):
            if wanted(frame, row):
                observations.setdefault(track.id, []).append((frame, row))
    return observations
