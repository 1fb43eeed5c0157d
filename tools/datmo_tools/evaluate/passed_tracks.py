# SPDX-License-Identifier: BSD-3-Clause
"""Checks fused tracks that passed the test of all sources: are they true (thesis 3.4.2), and are
their members of one object?"""

import numpy as np

from datmo_tools import transforms
from datmo_tools.evaluate.track_frames import Newest, follow, observations_of
from datmo_tools.stamps import NANOSECONDS


def has_passed(track, sources):
    """Whether a SeenTrack has members of all of the sources (names)."""
    return {source for source, _ in track.sources} >= set(sources)


def movers(moment):
    """Returns the true objects that move at some time."""
    return moment.movers


def road_users(moment):
    """Returns the road users, moving or not."""
    return moment.movers | moment.users


def score_passed(fused, members, gate):
    """Returns what happened to the fused tracks that passed, as a dictionary that JSON can hold.

    fused: TrackFrames of the fused list; members: dictionary source -> TrackFrames of its tracks;
    gate: m. A track counts in the frames in which all sources have it and it is published as
    moving, in the region; it is true if it follows one true object in most of them.
    """
    both = observations_of(fused, lambda frame, row: has_passed(frame.tracks[row], members))
    judged = observations_of(
        fused,
        lambda frame, row: frame.counts(row) and has_passed(frame.tracks[row], members),
    )
    false, on_user = [], 0
    for number, observations in judged.items():
        if follow(observations, gate, movers).is_true:
            continue
        on_road_user = follow(observations, gate, road_users).is_true
        on_user += on_road_user
        off = [
            (frame, row)
            for frame, row in observations
            if not len(frame.near(row, gate, movers(frame.moment)))
        ]
        false.append({**account(number, observations, off), "on_standing_road_user": on_road_user})
    true = len(judged) - len(false)
    return {
        "tracks": len(both), "judged": len(judged),
        "true_movers": true, "true_movers_share": _share(true, len(judged)),
        "true_road_users": true + on_user,
        "true_road_users_share": _share(true + on_user, len(judged)),
        "false": sorted(false, key=lambda item: item["from_s"]),
        "pairs": _score_pairs(judged, members, gate),
    }  # fmt: skip


def account(number, observations, off):
    """Describes where a false track is, and what is there in truth.

    number: its id; observations: of (TrackFrame, row), where it counts; off: those of them in which it
    is on nothing that moves, of which the middle one is reported; all of them, if there are none.
    """
    frame, row = (off or observations)[len(off or observations) // 2]
    track = frame.tracks[row]
    position = frame.positions[row]
    in_map = transforms.points_in_parent(frame.moment.base, position)
    return {
        "id": number,
        "from_s": observations[0][0].stamp / NANOSECONDS,
        "to_s": observations[-1][0].stamp / NANOSECONDS,
        "frames": len(observations),
        "frames_off": len(off),
        "stamp_s": frame.stamp / NANOSECONDS,
        "position_m": [round(float(value), 2) for value in in_map],
        "range_m": round(float(np.hypot(*position)), 2),
        "bearing_deg": round(float(np.degrees(np.arctan2(position[1], position[0]))), 1),
        "speed_mps": round(float(np.hypot(*track.velocity)), 2),
        "members": [list(member) for member in track.sources],
        "nearest": _nearest(frame, row),
    }


def _nearest(frame, row):
    """Returns the true object whose box is nearest; None: there is none around the vehicle."""
    if not frame.moment.items:
        return None
    column = int(np.argmin(frame.distances[row]))
    item = frame.moment.items[column]
    return {
        "id": item.id,
        "label": item.label,
        "moving": bool(item.moving),
        "distance_m": round(float(frame.distances[row, column]), 2),
    }


def _score_pairs(judged, members, gate):
    """Checks whether the members of the fused tracks follow the same road user, pair by pair."""
    newest = {source: Newest(frames) for source, frames in members.items()}
    counts, wrong = {"right": 0, "wrong": 0, "on_nothing": 0}, []
    for number, observations in judged.items():
        for pair, positions in _pairs(observations, newest).items():
            follows = [follow(seen, gate, road_users) for seen in positions]
            objects = [item.object if item.is_true else None for item in follows]
            if None in objects:
                counts["on_nothing"] += 1
            elif len(set(objects)) == 1:
                counts["right"] += 1
            else:
                counts["wrong"] += 1
                wrong.append({
                    "id": number, "members": [list(member) for member in pair],
                    "objects": objects, "frames": len(positions[0]),
                    "from_s": positions[0][0][0].stamp / NANOSECONDS,
                })  # fmt: skip
    known = counts["right"] + counts["wrong"]
    return {**counts, "right_share": _share(counts["right"], known), "wrong_pairs": wrong}


def _pairs(observations, newest):
    """Returns a dictionary members -> for each member its observations, of one fused track."""
    pairs = {}
    for frame, row in observations:
        members = tuple(sorted(item for item in frame.tracks[row].sources if item[0] in newest))
        seen = [_observation(newest[source].at(frame.stamp), number) for source, number in members]
        if None not in seen:
            for positions, item in zip(pairs.setdefault(members, [[] for _ in members]), seen):
                positions.append(item)
    return pairs


def _observation(frame, number):
    """Returns (TrackFrame, row) of a track by its id; None: it does not exist."""
    for row, track in enumerate(frame.tracks if frame is not None else ()):
        if track.id == number:
            return frame, row
    return None


def _share(count, total):
    return count / total if total else None
