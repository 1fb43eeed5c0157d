# SPDX-License-Identifier: BSD-3-Clause
"""Checks whether moving objects in a camera's view keep their ids while another sensor is off."""

import collections

import numpy as np

from datmo_tools import transforms
from datmo_tools.errors import InputError
from datmo_tools.evaluate.pair_choice import nearest_pairs
from datmo_tools.evaluate.truth import TRUE_OBJECTS, TRUE_POSE, read_true_objects
from datmo_tools.pose_path import planar, read_messages, read_path
from datmo_tools.stamps import to_ros_time

NEAR = 2.0  # m, from an object's center to that of its track: half a car's length
BESIDE = 0.5  # s, before and after
SEEN = 0.5  # share of the time: others occlude them now and then


def kept_ids(computed, recorded, begin, end, sensor="stereo"):
    """Counts how many moving objects that a sensor sees most of the time from `begin` to `end` (s)
    are tracked before and after, and how many of them under one id (dict); also how many lists of
    tracks were published in between.

    computed, recorded: bags (Path) with tracks and pose, and with the truth. Raises InputError.
    """
    paths = read_path(computed, "/pose"), read_path(recorded, TRUE_POSE)
    lists = [message for message, _ in read_messages(computed, "/tracks")]
    objects = read_true_objects(recorded)
    if not objects:
        raise InputError(f"{recorded}: nothing on {TRUE_OBJECTS}, expected a drive with truth")
    truth = list(objects.values())
    stamps = np.array([to_ros_time(stamp).to_sec() for stamp in objects])
    within = [truth[i] for i in np.flatnonzero((stamps >= begin - BESIDE) & (stamps <= end + BESIDE))]
    lists_with = collections.Counter(each.id for items in within for each in items
                                     if each.moving and sensor in each.visible_to)  # fmt: skip
    seen = {each for each, count in lists_with.items() if count >= SEEN * len(within)}
    before = [message for message in lists if message.header.stamp.to_sec() < begin]
    after = [message for message in lists if message.header.stamp.to_sec() >= end + BESIDE]
    ids = [_ids_of(each, truth[int(np.argmin(np.abs(stamps - each.header.stamp.to_sec())))], seen, paths)
           for each in (before[-1:] + after[:1])]  # fmt: skip
    both = set(ids[0]) & set(ids[1]) if len(ids) == 2 else set()
    return {
        "seen": len(seen),
        "tracked": len(both),
        "kept": sum(ids[0][each] == ids[1][each] for each in both),
        "lists_meanwhile": sum(begin <= message.header.stamp.to_sec() < end for message in lists),
    }


def _ids_of(tracks, items, seen, paths):
    """Returns track id by object id, of those objects that have a track near them; items: list of
    TrueObject."""
    own, true = (path.at(tracks.header.stamp.to_nsec()) for path in paths)
    objects = [each for each in items if each.id in seen]
    at = [transforms.relative(true, planar(each.pose))[:2] for each in objects]
    positions = [transforms.relative(own, planar(track.pose))[:2] for track in tracks.tracks]
    apart = np.reshape([[np.hypot(*(mine - its)) for its in positions] for mine in at],
                       (len(at), len(positions)))  # fmt: skip
    (pairs,) = nearest_pairs([np.where(apart < NEAR, apart, np.inf)])
    return {objects[i].id: tracks.tracks[j].id for i, j in pairs}


def gap_effect(stamps, errors, clean, gap, distance_m):
    """Returns what a gap did to the pose (dict): the error that it added at the first pose after
    it, and the maximum from BESIDE later on; None: no pose.

    stamps (s) and errors (m), and the clean drive's: see pose_errors; gap: begin and end (s);
    distance_m: driven in it.
    """
    begin, end = gap
    added = np.abs(errors - np.interp(stamps, *clean))
    after, settled = added[stamps >= end], added[stamps >= end + BESIDE]
    return {
        "distance_m": distance_m,
        "poses_meanwhile": int(((stamps >= begin) & (stamps < end)).sum()),
        "first_m": float(after[0]) if len(after) else None,
        "settled_m": float(settled.max()) if len(settled) else None,
    }
