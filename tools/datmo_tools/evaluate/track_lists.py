# SPDX-License-Identifier: BSD-3-Clause
"""Reads lists of tracks as written by run_bag."""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import Object, TrackArray
from datmo_tools.bag_input import check_type, opened
from datmo_tools.errors import InputError
from datmo_tools.pose_path import planar
from datmo_tools.stamps import NANOSECONDS

TRACKS = "/tracks"  # the fused ones if there is track fusion; with /NAME after it those of a source


class SeenTrack(NamedTuple):
    """A track at the stamp of its list, in the map of the run."""

    id: int
    pose: np.ndarray  # x, y (m), yaw (rad)
    velocity: np.ndarray  # m/s: vx, vy
    moving: bool
    sources: tuple  # of (source, id): the tracks that it was fused from
    classes: tuple = ()  # probability by Object.CLASS_*; none: unknown
    classification: int = Object.CLASS_UNKNOWN
    class_probability: float = 0.0  # of the classification, 0 to 1
    size: tuple = (0.0, 0.0, 0.0)  # m: length, width, height; 0: not measured

    def position_at(self, seconds):
        """Returns x, y (m) predicted by this time (s) at its velocity."""
        return self.pose[:2] + self.velocity * seconds


class TrackList(NamedTuple):
    """All tracks of one message."""

    stamp: int  # ns
    tracks: list  # of SeenTrack
    views: list  # of ViewFan, in the map of the run; none: unknown


def read_track_lists(path, topics):
    """Returns a dictionary topic -> list of TrackList by increasing stamp.

    Tracks with a position or velocity that is not finite are ignored. Raises InputError for another
    type, for two messages of one stamp, and for a topic without messages.
    """
    lists = {topic: {} for topic in topics}
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages(list(topics)):
            check_type(path, topic, message, TrackArray)
            stamp = message.header.stamp.to_nsec()
            if stamp in lists[topic]:
                raise InputError(
                    f"{path}: {topic}: two messages at {stamp / NANOSECONDS:.6f} s, expected one"
                )
            lists[topic][stamp] = TrackList(stamp, _finite_tracks(message), message.views)
    for topic in topics:
        if not lists[topic]:
            option = "" if topic == TRACKS else " --track-fusion"
            raise InputError(f"{path}: nothing on {topic}, expected a bag of run_bag{option}")
    return {topic: [items[stamp] for stamp in sorted(items)] for topic, items in lists.items()}


def _finite_tracks(message):
    tracks = [
        SeenTrack(
            track.id,
            np.array(planar(track.pose)),
            np.array([track.velocity.x, track.velocity.y]),
            track.moving,
            tuple((member.source, member.id) for member in track.sources),
            tuple(track.class_probabilities),
            track.classification,
            track.class_probability,
            (track.size.x, track.size.y, track.size.z),
        )
        for track in message.tracks
    ]
    return [item for item in tracks if np.all(np.isfinite([*item.pose, *item.velocity]))]
