"""How good a run on a drive with truth was: end point, objects tracked, tracks of nothing."""

import math
from typing import NamedTuple

import numpy as np
from datmo_tools import transforms


class TrueBox(NamedTuple):
    """A true object at one stamp, in the map of the truth."""

    number: int
    label: str
    is_vehicle: bool
    moving: bool
    pose: np.ndarray  # x, y (m), yaw (rad) of the centre
    length: float  # m
    width: float  # m


class TrackState(NamedTuple):
    """A published track at one stamp, in the map of the truth."""

    number: int
    position: np.ndarray  # x, y (m) of the centre
    moving: bool


class PosePath:
    """Planar poses over time, interpolated between stamps and carried on beyond them."""

    def __init__(self, stamps, poses):
        """stamps: ns, rising, two or more; poses: n x 3 (x, y in m, yaw in rad)."""
        self.stamps = np.asarray(stamps)
        self.poses = np.asarray(poses, dtype=float)

    def at(self, stamp):
        """Pose at `stamp` (ns)."""
        after = int(np.clip(np.searchsorted(self.stamps, stamp), 1, len(self.stamps) - 1))
        begin, end = self.stamps[after - 1], self.stamps[after]
        step = transforms.relative(self.poses[after - 1], self.poses[after])
        return transforms.compose(self.poses[after - 1], step * ((stamp - begin) / (end - begin)))

    def length(self):
        """Distance driven, m."""
        return float(np.hypot(*np.diff(self.poses[:, :2], axis=0).T).sum())


def alignment(path, truth):
    """Planar pose of the path's frame in the truth's: both agree at the path's first stamp."""
    first = transforms.relative(path.poses[0], np.zeros(3))
    return transforms.compose(truth.at(path.stamps[0]), first)


def end_point_error(path, truth):
    """Distance (m) of an aligned path from the truth at the path's last stamp."""
    end = transforms.compose(alignment(path, truth), path.poses[-1])
    return float(np.hypot(*(end - truth.at(path.stamps[-1]))[:2]))


def distance_to_box(position, box):
    """Distance (m) of a position (x, y) from a box, 0 inside."""
    local = np.abs(transforms.relative(box.pose, [*position, 0.0])[:2])
    return float(np.hypot(*np.maximum(local - [0.5 * box.length, 0.5 * box.width], 0.0)))


def assign(boxes, tracks, gate):
    """One to one, the nearest pair first: list of (index of the box, index of the track).

    Near is the distance of the track's centre to the box, at most `gate` (m); of two tracks inside
    the same box the one nearer to its centre.
    """
    pairs = []
    for b, box in enumerate(boxes):
        for t, track in enumerate(tracks):
            distance = distance_to_box(track.position, box)
            if distance <= gate:
                pairs.append((distance, math.dist(track.position, box.pose[:2]), b, t))
    assigned, taken = {}, set()
    for _, _, b, t in sorted(pairs):
        if b not in assigned and t not in taken:
            assigned[b] = t
            taken.add(t)
    return sorted(assigned.items())


class ObjectScore:
    """One true object over the drive."""

    def __init__(self, box):
        self.number = box.number
        self.label = box.label
        self.is_vehicle = box.is_vehicle
        self.frames = 0  # in which it is labelled
        self.moving_frames = 0  # in which it truly moves
        self.tracked_frames = 0
        self.reported_moving_frames = 0  # in which its track says that it moves
        self.track_frames = {}  # track number -> frames in which it was on the object

    @property
    def tracked_share(self):
        """Share of its frames in which a track is on it."""
        return self.tracked_frames / self.frames

    @property
    def is_parked(self):
        """A vehicle that never moves."""
        return self.is_vehicle and self.moving_frames == 0

    @property
    def reported_moving_share(self):
        """Share of its frames in which a track on it says that it moves."""
        return self.reported_moving_frames / self.frames

    def add(self, box, track):
        """Counts one frame; track: the one assigned to the box, or None."""
        self.frames += 1
        self.moving_frames += box.moving
        if track is not None:
            self.tracked_frames += 1
            self.reported_moving_frames += track.moving
            self.track_frames[track.number] = self.track_frames.get(track.number, 0) + 1


class TrackingScore(NamedTuple):
    """All objects of a drive, and the tracks that are on none of them."""

    objects: list  # ObjectScore, by number
    frames: int  # with truth
    false_track_frames: dict  # track number -> frames in which it was in view and on no true object


def score_tracking(truth, tracks, in_view, gate):
    """TrackingScore.

    truth: stamp -> list of TrueBox; tracks: stamp -> list of TrackState (a stamp without tracks
    counts as none); in_view: function of (stamp, position), true where the truth would hold an
    object.
    """
    scores, false_frames = {}, {}
    for stamp, boxes in truth.items():
        states = tracks.get(stamp, [])
        pairs = dict(assign(boxes, states, gate))
        for b, box in enumerate(boxes):
            track = states[pairs[b]] if b in pairs else None
            scores.setdefault(box.number, ObjectScore(box)).add(box, track)
        for t, state in enumerate(states):
            near = any(distance_to_box(state.position, box) <= gate for box in boxes)
            if t not in pairs.values() and not near and in_view(stamp, state.position):
                false_frames[state.number] = false_frames.get(state.number, 0) + 1
    return TrackingScore([scores[number] for number in sorted(scores)], len(truth), false_frames)
