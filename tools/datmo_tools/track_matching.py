"""Which track is of which true object: as score_run decides it, frame by frame."""

import enum

import numpy as np
from scipy.optimize import linear_sum_assignment


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

    In each frame first come the pairs that were last matched to each other; of the others, as many
    as can be within the gate, with the least sum of distances. Objects that have to be found come
    before those that need not. A test holds it against score_run's matching.cpp.
    """

    def __init__(self, gate):
        """gate: the largest distance of a match, m."""
        self._gate = gate
        self._track_of, self._object_of = {}, {}

    def match(self, track_ids, object_ids, required, distances):
        """For each track the index of its object (None: none), and its Verdict.

        required: m, of bool; distances: n x m, m.
        """
        partners = [None] * len(track_ids)
        for duty in (True, False):
            allowed = (distances <= self._gate) & (required == duty)
            self._keep_partners(track_ids, object_ids, allowed, partners)
            self._assign_rest(track_ids, object_ids, allowed, distances, partners)
        return partners, self._verdicts(partners, required, distances)

    def _keep_partners(self, track_ids, object_ids, allowed, partners):
        for j, i in np.argwhere(allowed.T).tolist():
            is_open = partners[i] is None and j not in partners
            if is_open and self._were_partners(track_ids[i], object_ids[j]):
                self._pair(track_ids, object_ids, partners, i, j)

    def _assign_rest(self, track_ids, object_ids, allowed, distances, partners):
        rows = [i for i, partner in enumerate(partners) if partner is None]
        columns = [j for j in range(len(object_ids)) if j not in partners]
        is_open = allowed[np.ix_(rows, columns)]
        # Worth more than any sum of distances: one more match always pays.
        match_gain = self._gate * (len(object_ids) + 1)
        gains = np.where(is_open, match_gain - distances[np.ix_(rows, columns)], 0.0)
        for a, b in zip(*linear_sum_assignment(gains, maximize=True)):
            if is_open[a, b]:
                self._pair(track_ids, object_ids, partners, rows[a], columns[b])

    def _pair(self, track_ids, object_ids, partners, i, j):
        partners[i] = j
        self._track_of[object_ids[j]] = track_ids[i]
        self._object_of[track_ids[i]] = object_ids[j]

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
