"""Tracks of a run and what is true at their stamps, side by side."""

import bisect
from typing import NamedTuple, Optional

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools import transforms
from datmo_tools.object_truth import MAX_GAP, Truth
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.track_matching import TrackMatcher, distances_to_boxes

POSE = "/pose"  # estimated, of the run

# What takes part in traffic; poles and trees are true objects as well.
ROAD_USERS = (Object.CLASS_PEDESTRIAN, Object.CLASS_CYCLIST, Object.CLASS_VEHICLE)

# A list is of the present for so long, s: as the fusion of tracks takes them.
MAX_LIST_AGE = 0.6


class Moment(NamedTuple):
    """What is true at one stamp, in base_link; arrays in the order of the objects."""

    base: np.ndarray  # true x, y (m), yaw (rad) of base_link in the map of the truth
    items: list  # of TrueObject, in the map of the truth
    ids: np.ndarray
    poses: np.ndarray  # n x 3: x, y (m), yaw (rad)
    sizes: np.ndarray  # n x 2, m: length, width
    movers: np.ndarray  # bool: it moves at some time of the drive
    users: np.ndarray  # bool: a road user, moving or not
    required: np.ndarray  # bool: it has to be found


class TrackFrame(NamedTuple):
    """One list of tracks; all of the tracks' lists in their order."""

    stamp: int  # ns
    tracks: list  # of SeenTrack
    positions: np.ndarray  # n x 2, m, base_link
    moment: Moment
    distances: np.ndarray  # n x m, m, from the tracks to the boxes of the true objects
    partners: list  # index of the true object that it is matched to, of those that move; or None
    verdicts: list  # Verdict; None: it does not count, since it stands or is out of the region

    def near(self, row, gate, among):
        """Indices of the true objects (those of the bool array `among`) within the gate (m)."""
        return np.flatnonzero((self.distances[row] <= gate) & among)


class Scene:
    """True objects about the vehicle, as the run takes itself to see them: tracks are laid on the
    truth by the estimated pose of the vehicle on its true one, so that the drift of the map does
    not count (as score_run does)."""

    def __init__(self, run, drive, asked, gate):
        """run, drive: bags (Path); asked: of the objects that have to be found (Asked); gate: m,
        within which a track may be of an object. Raises InputError."""
        self.gate = gate
        self._asked = asked
        self._truth = Truth(drive)
        self._truth.check_seen_by(asked.sensor)
        self._movers = self._truth.movers()
        self._poses = read_path(run, POSE)
        self._moments = {}

    def frames(self, lists):
        """List of TrackFrame of those lists (TrackList, by rising stamp) whose truth is known."""
        matcher = TrackMatcher(self.gate)
        frames = []
        for item in lists:
            moment = self._moment(item.stamp)
            if moment is not None:
                frames.append(self._frame(item, moment, matcher))
        return frames

    def _moment(self, stamp):
        if stamp not in self._moments:
            known = self._poses.distance_from(stamp) <= MAX_GAP * NANOSECONDS
            states = self._truth.at(stamp, self._asked) if known else None
            self._moments[stamp] = None if states is None else self._as_moment(stamp, states)
        return self._moments[stamp]

    def _as_moment(self, stamp, states):
        ids = [state.source.id for state in states]
        return Moment(
            self._truth.base_at(stamp),
            [state.source for state in states],
            np.array(ids, dtype=int),
            np.array([state.pose for state in states]).reshape(-1, 3),
            np.array([state.size for state in states]).reshape(-1, 2),
            np.array([number in self._movers for number in ids], dtype=bool),
            np.array([state.classification in ROAD_USERS for state in states], dtype=bool),
            np.array([state.asked for state in states], dtype=bool),
        )

    def _frame(self, item, moment, matcher):
        base = self._poses.at(item.stamp)
        poses = np.array([track.pose for track in item.tracks]).reshape(-1, 3)
        positions = transforms.relative(base, poses)[:, :2]
        distances = distances_to_boxes(positions, moment.poses, moment.sizes)
        frame = TrackFrame(item.stamp, item.tracks, positions, moment, distances,
                           [None] * len(positions), [None] * len(positions))  # fmt: skip
        rows = [row for row, track in enumerate(item.tracks) if self._counts(frame, row, track)]
        columns = np.flatnonzero(moment.movers)
        partners, verdicts = matcher.match(
            [item.tracks[row].id for row in rows], moment.ids[columns].tolist(),
            moment.required[columns], distances[np.ix_(rows, columns)])  # fmt: skip
        for row, partner, verdict in zip(rows, partners, verdicts):
            frame.partners[row] = None if partner is None else int(columns[partner])
            frame.verdicts[row] = verdict
        return frame

    def _counts(self, frame, row, track):
        if not track.moving:
            return False
        in_region = self._asked.region.contains(frame.positions[row])
        return in_region or len(frame.near(row, self.gate, frame.moment.required)) > 0


class Newest:
    """The newest of some items with a stamp (ns), at any time."""

    def __init__(self, items):
        """items: by rising stamp."""
        self._items = items
        self._stamps = [item.stamp for item in items]

    def at(self, stamp):
        """The newest one that is not after `stamp` (ns) and of the present; None: there is none."""
        after = bisect.bisect_right(self._stamps, stamp)
        if after == 0 or stamp - self._stamps[after - 1] > MAX_LIST_AGE * NANOSECONDS:
            return None
        return self._items[after - 1]


class Follow(NamedTuple):
    """What a track follows in some frames."""

    object: Optional[int]  # id of the true object that it is nearest to, by all of them
    frames: int
    near: int  # of them, those in which it is within the gate of it

    @property
    def is_true(self):
        """Whether it follows it in most of the frames."""
        return 2 * self.near > self.frames


def follow(observations, gate, among):
    """Follow of one track.

    observations: of (TrackFrame, row); among: function of a Moment, which true objects count (bool
    array). The object is that with the least sum of distances, none of which counts as more than
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


def sightings_of(frames, wanted=lambda frame, row: True):
    """Dictionary track id -> list of (TrackFrame, row), of the rows that are wanted."""
    observations = {}
    for frame in frames:
        for row, track in enumerate(frame.tracks):
            if wanted(frame, row):
                observations.setdefault(track.id, []).append((frame, row))
    return observations
