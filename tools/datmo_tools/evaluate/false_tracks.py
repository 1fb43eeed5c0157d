# SPDX-License-Identifier: BSD-3-Clause
"""Finds tracks that report motion where nothing moves, within the view of the camera."""

from typing import NamedTuple

import numpy as np

from datmo_tools.evaluate.passed_tracks import account
from datmo_tools.evaluate.track_frames import Newest, observations_of
from datmo_tools.evaluate.track_views import is_visible, is_in_view


class FalseTrack(NamedTuple):
    """A track that is false in most of its frames, as score_run counts them."""

    id: int
    observations: list  # of (TrackFrame, row) in which it counts
    false: list  # those of them in which it is false


def false_tracks(frames):
    """Returns a list of FalseTrack in the TrackFrames of one list."""
    found = []
    counted = observations_of(frames, lambda frame, row: frame.counts(row))
    for number, observations in counted.items():
        false = [(frame, row) for frame, row in observations if frame.is_false(row)]
        if 2 * len(false) > len(observations):
            found.append(FalseTrack(number, observations, false))
    return found


def score_false(frames_by_list, view_lists, gate):
    """Returns a dictionary list -> its false tracks, which JSON can hold.

    frames_by_list: dictionary name -> TrackFrames; view_lists: TrackLists with the views of the
    camera; gate: m. A track is in view if it is in the sector and range of one of the views in most
    of its frames, and visible if nothing occludes it, either.
    """
    views = Newest([item for item in view_lists if item.views])
    return {name: _score_list(frames, views, gate) for name, frames in frames_by_list.items()}


def reduction(before, after):
    """Returns the share (0 to 1) by which a count is less; None: there was nothing."""
    return 1.0 - after / before if before else None


def _score_list(frames, views, gate):
    found = false_tracks(frames)
    in_view = [item for item in found if _mostly(item.observations, views, is_in_view)]
    accounts = []
    for item in in_view:
        sort = _sort(item.false, gate)
        visible = _mostly(item.observations, views, is_visible)
        described = account(item.id, item.observations, item.false)
        accounts.append({**described, "what": sort, "visible": visible})
    in_frames = sum(
        frame.is_false(row) and _is(frame, row, views, is_in_view)
        for frame in frames
        for row in range(len(frame.tracks))
    )
    return {
        "all": len(found),
        "in_view": len(in_view),
        "visible": sum(item["visible"] for item in accounts),
        "in_view_frames": in_frames,
        "frames": len(frames),
        "by_what": {key: sum(item["what"] == key for item in accounts) for key in SORTS},
        "tracks": accounts,
    }


SORTS = ("double", "standing road user", "other object", "nothing")


def _sort(observations, gate):
    """Returns what a false track is on in most of its false frames: one of SORTS."""
    counts = dict.fromkeys(SORTS, 0)
    for frame, row in observations:
        near = frame.distances[row] <= gate
        moment = frame.moment
        groups = near & moment.movers, near & moment.users, near, np.array([True])
        counts[next(sort for sort, group in zip(SORTS, groups) if np.any(group))] += 1
    return max(SORTS, key=counts.get)


def _mostly(observations, views, test):
    return 2 * sum(_is(frame, row, views, test) for frame, row in observations) > len(observations)


def _is(frame, row, views, test):
    item = views.at(frame.stamp)
    return item is not None and test(item.views, frame.tracks[row].pose[:2])
