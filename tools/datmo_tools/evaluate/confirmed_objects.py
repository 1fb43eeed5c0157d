# SPDX-License-Identifier: BSD-3-Clause
"""Checks whether true moving objects that several sensors' trackers follow pass the test of all."""

import bisect

import numpy as np

from datmo_tools.evaluate.passed_tracks import has_passed, movers
from datmo_tools.evaluate.track_frames import Newest, follow, observations_of
from datmo_tools.stamps import NANOSECONDS

# No time counts between two lists farther apart than this, s: like score_run's max_gap.
MAX_STEP = 0.5

# No tracker can confirm in time what is visible for less, s: like score_run's truth/min_time_seen.
MIN_SEEN = 1.0

# Half of the time over which it is decided which object a track follows, ns: the noise of a few
# lists averages out, and a track that switches to another object is soon on that.
FOLLOW_HALF_WINDOW = NANOSECONDS // 2


class Followers:
    """The tracks of one list, and the true moving object that each of them is on at any time.

    A track is on the object that it follows around this time, or, if that is outside of the gate,
    on the nearest one: of two objects side by side, the nearer one may change from frame to frame.
    """

    def __init__(self, frames, gate):
        """frames: TrackFrames; gate: m."""
        self._gate = gate
        self._followed = {}  # (track id, stamp) -> object id, or None
        for number, observations in observations_of(frames).items():
            stamps = [frame.stamp for frame, _ in observations]
            for stamp in stamps:
                begin = bisect.bisect_left(stamps, stamp - FOLLOW_HALF_WINDOW)
                end = bisect.bisect_right(stamps, stamp + FOLLOW_HALF_WINDOW)
                about = follow(observations[begin:end], gate, movers)
                self._followed[number, stamp] = about.object

    def on(self, frame):
        """Returns a dictionary object id -> its tracks (SeenTrack) in a TrackFrame of these."""
        objects = {}
        for row, track in enumerate(frame.tracks):
            near = frame.near(row, self._gate, frame.moment.movers)
            if len(near):
                ids = frame.moment.ids[near].tolist()
                nearest = ids[int(np.argmin(frame.distances[row, near]))]
                followed = self._followed[track.id, frame.stamp]
                objects.setdefault(followed if followed in ids else nearest, []).append(track)
        return objects


class Together:
    """What happened to one object while it met a condition: followed by all, or visible to all."""

    def __init__(self, label):
        self.label = label
        self.frames, self.passed_frames = 0, 0
        self.first, self.last, self._duration = None, None, 0  # ns
        self.delay = None  # s of this time until it first passed; None: it never did
        self.followed_frames = {}  # source -> number of frames with a track of the source
        self.distances, self.ranges = [], []  # m: between the tracks; from the vehicle
        self.tracks = set()  # (source, id)

    def add(self, stamp, has_passed_now, reach, followed_by):
        """reach: of the object, m from the vehicle; followed_by: sources that have a track of it.
        """
        if self.last is not None and stamp - self.last <= MAX_STEP * NANOSECONDS:
            self._duration += stamp - self.last
        self.first = stamp if self.first is None else self.first
        self.last = stamp
        self.frames += 1
        self.passed_frames += has_passed_now
        self.ranges.append(reach)
        for source in followed_by:
            self.followed_frames[source] = self.followed_frames.get(source, 0) + 1
        if has_passed_now and self.delay is None:
            self.delay = self.seconds

    @property
    def seconds(self):
        """Returns the total time (s), without gaps."""
        return self._duration / NANOSECONDS


def score_confirmed(fused, members, gate, soon, sensors):
    """Returns what happened to the true moving objects, as a dictionary that JSON can hold.

    fused: TrackFrames of the fused list; members: dictionary source -> those of its tracks; gate:
    m; soon: s with tracks of all sources, within which an object has to pass; sensors: names of
    the sources' sensors in the truth.

    At the stamp of a fused list an object has passed if a fused track with members of all sources
    is on it. Objects count if they move and have to be found (Moment.required).
    """
    lists = {source: Newest(frames) for source, frames in members.items()}
    of_source = {source: Followers(frames, gate) for source, frames in members.items()}
    of_fused = Followers(fused, gate)
    confirmed, visible = {}, {}
    for frame in fused:
        passed = {
            number
            for number, tracks in of_fused.on(frame).items()
            if any(has_passed(track, members) for track in tracks)
        }
        present = {source: item.at(frame.stamp) for source, item in lists.items()}
        on = {
            source: (at.stamp, of_source[source].on(at))
            for source, at in present.items()
            if at is not None
        }
        for column in np.flatnonzero(frame.moment.required):
            item = frame.moment.items[column]
            reach = float(np.hypot(*frame.moment.poses[column, :2]))
            followed_by = [source for source, (_, tracks) in on.items() if item.id in tracks]
            news = frame.stamp, item.id in passed, reach, followed_by
            if len(followed_by) == len(members):
                entry = confirmed.setdefault(item.id, Together(item.label))
                entry.add(*news)
                _add_tracks(entry, frame.stamp, item.id, on)
            if set(item.visible_to) >= set(sensors):
                visible.setdefault(item.id, Together(item.label)).add(*news)
    return {
        "soon_s": soon,
        "followed_by_all": _summary(confirmed, soon),
        "visible_to_all": _visible_summary(visible, confirmed, soon),
    }


def _add_tracks(entry, stamp, number, on):
    """Adds the object's tracks, and the least distance between two of different sources."""
    positions = []
    for source, (then, tracks) in on.items():
        entry.tracks.update((source, track.id) for track in tracks[number])
        seconds = (stamp - then) / NANOSECONDS
        positions.append([track.position_at(seconds) for track in tracks[number]])
    entry.distances.append(
        min(
            float(np.hypot(*(one - other)))
            for i, ones in enumerate(positions)
            for others in positions[i + 1 :]
            for one in ones
            for other in others
        )
    )


def _summary(objects, soon):
    in_time = {number for number, item in objects.items() if _in_time(item, soon)}
    long = {number: item for number, item in objects.items() if item.seconds >= soon}
    return {
        **_counts(objects, in_time),
        "for_that_long": _counts(long, in_time),
        "frames": sum(item.frames for item in objects.values()),
        "passed_frames": sum(item.passed_frames for item in objects.values()),
        "late_or_never": [
            _account(number, item)
            for number, item in sorted(objects.items())
            if number not in in_time
        ],
    }


def _visible_summary(visible, confirmed, soon):
    """Returns None if the truth knows no object that all sensors see."""
    if not visible:
        return None
    # In time is after all follow it: what none passed while it was visible is not.
    in_time = {
        number
        for number, item in visible.items()
        if item.delay is not None and number in confirmed and _in_time(confirmed[number], soon)
    }
    long = {number: item for number, item in visible.items() if item.seconds >= MIN_SEEN}
    return {
        **_counts(visible, in_time),
        "min_seen_s": MIN_SEEN,
        "for_that_long": _counts(long, in_time),
        "frames": sum(item.frames for item in visible.values()),
        "passed_frames": sum(item.passed_frames for item in visible.values()),
        "never": [
            {**_account(number, item), "followed_by_all": number in confirmed}
            for number, item in sorted(visible.items())
            if item.delay is None
        ],
    }


def _counts(objects, in_time):
    """in_time: ids of those that passed in time, and maybe of others."""
    passed = sum(item.delay is not None for item in objects.values())
    in_time = len(in_time & set(objects))
    total = len(objects)
    return {
        "objects": total,
        "passed": passed,
        "passed_share": passed / total if total else None,
        "in_time": in_time,
        "in_time_share": in_time / total if total else None,
    }


def _in_time(item, soon):
    return item.delay is not None and item.delay <= soon


def _account(number, item):
    result = {
        "id": number,
        "label": item.label,
        "from_s": item.first / NANOSECONDS,
        "to_s": item.last / NANOSECONDS,
        "seconds": round(item.seconds, 3),
        "frames": item.frames,
        "passed_frames": item.passed_frames,
        "delay_s": item.delay,
        "followed_frames": item.followed_frames,
        "range_m": [round(min(item.ranges), 1), round(max(item.ranges), 1)],
    }
    if item.distances:
        result["tracks"] = [list(track) for track in sorted(item.tracks)]
        result["median_distance_m"] = round(float(np.median(item.distances)), 2)
        result["largest_distance_m"] = round(max(item.distances), 2)
    return result
