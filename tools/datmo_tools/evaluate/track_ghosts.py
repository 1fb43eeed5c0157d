# SPDX-License-Identifier: BSD-3-Clause
"""Counts two tracks on one object, and objects that change their track."""

import numpy as np


def score_ghosts(frames, gate):
    """Returns ghosts and id switches of a list of tracks (TrackFrames), as a dictionary for JSON.

    A ghost is a moving track within the gate (m) of an object that moves at some time, when all
    objects there have other tracks. An id switch is an object that has to be found and is matched
    to another track than last time.
    """
    ghost_frames, ghosts, switches, labels = 0, {}, {}, {}
    for frame in frames:
        of_frame = 0
        labels.update((item.id, item.label) for item in frame.moment.items)
        for row, track in enumerate(frame.tracks):
            near = frame.near(row, gate, frame.moment.movers)
            if not frame.counts(row) or track.id in frame.matches.objects or not len(near):
                continue
            item = frame.moment.items[near[np.argmin(frame.distances[row, near])]]
            ghosts[item.id] = ghosts.get(item.id, 0) + 1
            of_frame += 1
        ghost_frames += of_frame > 0
        for number in frame.matches.switches:
            switches[number] = switches.get(number, 0) + 1
    named = {
        number: {"id": number, "label": labels[number], "ghost_frames": ghosts.get(number, 0),
                 "id_switches": switches.get(number, 0)}
        for number in sorted({*ghosts, *switches})
    }  # fmt: skip
    return {
        "frames": len(frames),
        "ghost_frames": ghost_frames,
        "ghosts": sum(ghosts.values()),
        "id_switches": sum(switches.values()),
        "objects": list(named.values()),
    }
