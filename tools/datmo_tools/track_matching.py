"""Which track is of which true object: as score_run decides it, frame by frame."""

import enum

import numpy as np


class Verdict(enum.Enum):
    """What a track is at one stamp."""

    HIT = "hit"  # matched to an object that has to be found
    NEUTRAL = "neutral"  # near one that need not be found, and no hit
    FALSE = "false"  # neither


def distances_to_boxes(positions, poses, sizes):
    """Distances (n x m, m) of positions (n x 2) from boxes, 0 inside.

    poses: m x 3, x, y (m), yaw (rad) of their centers; sizes: m x 2, length, width (m).
    """
    apart = positions[:, np.newaxis] - poses[np.newaxis, :, :2]
    cosine, sine = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    along = cosine * apart[..., 0] + sine * apart[..., 1]
    across = cosine * apart[..., 1] - sine * apart[..., 0]
    outside = [np.maximum(np.abs(along) - 0.5 * sizes[:, 0], 0.0),
               np.maximum(np.abs(across) - 0.5 * sizes[:, 1], 0.0)]  # fmt: skip
    return np.hypot(*outside)


class TrackMatcher:
    """Gives each true object at most one track and each track at most one true object, through the
    frames of one list of tracks (Bernardin and Stiefelhagen 2008, as score_run).

    In each frame first come the pairs that were last matched to each other, then the nearest ones;
    objects that have to be found before those that need not.
    """

    def __init__(self, gate):
        """gate: the largest distance of a match, m."""
        self._gate = gate
        self._track_of, self._object_of = {}, {}

    def match(self, track_ids, object_ids, required, distances):
        """For each track the index of its object (None: none), and its Verdict.

        required: m, of bool; distances: n x m, m.
        """
        partners, taken = [None] * len(track_ids), set()
        for duty in (True, False):
            rows, columns = np.nonzero((distances <= self._gate) & (required == duty))
            pairs = sorted(
                (not self._were_partners(track_ids[i], object_ids[j]), distances[i, j], i, j)
                for i, j in zip(rows.tolist(), columns.tolist())
            )
            for _, _, i, j in pairs:
                if partners[i] is None and j not in taken:
                    partners[i] = j
                    taken.add(j)
                    self._track_of[object_ids[j]] = track_ids[i]
                    self._object_of[track_ids[i]] = object_ids[j]
        return partners, self._verdicts(partners, required, distances)

    def _were_partners(self, track, item):
        return self._track_of.get(item) == track and self._object_of.get(track) == item

    def _verdicts(self, partners, required, distances):
        verdicts = []
        for i, partner in enumerate(partners):
            if partner is not None and required[partner]:
                verdicts.append(Verdict.HIT)
            elif np.any((distances[i] <= self._gate) & ~required):
                # A second track on what need not be found is as little wrong as the first.
                verdicts.append(Verdict.NEUTRAL)
            else:
                verdicts.append(Verdict.FALSE)
        return verdicts
