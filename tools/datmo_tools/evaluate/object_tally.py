# SPDX-License-Identifier: BSD-3-Clause
"""Tallies lists of objects: shares by class and by range, and statistics of the errors."""

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools.evaluate.object_scores import GATE_95

CLASSES = {
    "vehicle": Object.CLASS_VEHICLE,
    "cyclist": Object.CLASS_CYCLIST,
    "pedestrian": Object.CLASS_PEDESTRIAN,
    "pole": Object.CLASS_POLE,
    "unknown": Object.CLASS_UNKNOWN,
}
NAMES = {number: name for name, number in CLASSES.items()}
MOVING, ALL = "moving", "all"
BANDS = (0.0, 10.0, 20.0, 30.0, 40.0)  # m, as far as they are within the range that counts
TRUE_GROUPS = (*CLASSES, MOVING, ALL)
SEEN_GROUPS = (*CLASSES, ALL)


class ObjectTally:
    """Counts and errors of the lists of one topic."""

    def __init__(self, edges):
        """edges: of the bands of range, m, increasing."""
        self.edges = list(edges)
        bands = len(self.edges) - 1
        self.lists = 0
        self._asked, self._found = _zeros(TRUE_GROUPS, bands), _zeros(TRUE_GROUPS, bands)
        self._seen, self._near = _zeros(SEEN_GROUPS, bands), _zeros(SEEN_GROUPS, bands)
        self._doubles = np.zeros(bands, int)
        # By true and by reported class, of the objects that match one that has to be found.
        self._said = {name: dict.fromkeys(CLASSES, 0) for name in CLASSES}
        self._errors = [[] for _ in range(bands)]

    def add(self, objects, truths, score, region):
        """Adds a list. objects, truths, score: as in score_lists; region: where objects count."""
        self.lists += 1
        found = {j: i for i, j, _ in score.matches}
        matched = {i for i, _, _ in score.matches}
        for j, truth in enumerate(truths):
            band = self._band(truth.range)
            if not truth.asked or band is None:
                continue
            groups = [_name(truth), ALL] + [MOVING] * truth.moving
            for group in groups:
                self._asked[group][band] += 1
                self._found[group][band] += j in found
            if j in found:
                said = _name(objects[found[j]])
                self._said[_name(truth)][said] += 1
        for i, (item, is_near) in enumerate(zip(objects, score.near)):
            band = self._band(item.range)
            if band is None or not region.contains(item.pose):
                continue
            for group in (_name(item), ALL):
                self._seen[group][band] += 1
                self._near[group][band] += bool(is_near)
            self._doubles[band] += bool(is_near) and i not in matched
        for i, j, errors in score.matches:
            band = self._band(truths[j].range)
            if truths[j].asked and band is not None:
                self._errors[band].append(errors)

    def result(self):
        """Returns a dictionary that JSON can hold."""
        lists = max(self.lists, 1)
        return {
            "lists": self.lists,
            "bands_m": [[near, far] for near, far in zip(self.edges, self.edges[1:])],
            "objects_per_list": float(self._seen[ALL].sum() / lists),
            "false_per_list": float((self._seen[ALL] - self._near[ALL]).sum() / lists),
            "doubles_per_list": float(self._doubles.sum() / lists),
            "recall": {
                group: _shares(self._found[group], self._asked[group]) for group in TRUE_GROUPS
            },
            "precision": {
                group: _shares(self._near[group], self._seen[group]) for group in SEEN_GROUPS
            },
            "class_right": {name: _class_right(name, self._said[name]) for name in CLASSES},
            "said": self._said,
            "errors": [_statistics(errors) for errors in [*self._errors, sum(self._errors, [])]],
        }

    def _band(self, distance):
        """Returns the index of the distance's band; None if it is outside of all bands."""
        band = int(np.searchsorted(self.edges, distance, side="right")) - 1
        return band if 0 <= band < len(self.edges) - 1 else None


def _name(item):
    """Returns the class name of an object or a true one; "unknown" for an invalid number."""
    return NAMES.get(item.classification, "unknown")


def _zeros(groups, bands):
    return {group: np.zeros(bands, dtype=int) for group in groups}


def _shares(counts, of):
    """Returns counts and shares by band, the last one of all bands together."""
    counts = [*map(int, counts), int(np.sum(counts))]
    of = [*map(int, of), int(np.sum(of))]
    shares = [count / total if total else None for count, total in zip(counts, of)]
    return {"count": counts, "of": of, "share": shares}


def _class_right(name, said):
    total = sum(said.values())
    return {"count": said[name], "of": total, "share": said[name] / total if total else None}


def _statistics(errors):
    """Returns statistics of one band's errors, each from the errors that have the quantity."""
    columns = np.array(errors).reshape(-1, 3).T
    along, across, nees = (column[np.isfinite(column)] for column in columns)
    return {
        **_mean_and_sd("along", along),
        **_mean_and_sd("across", across),
        "nees_count": len(nees),
        "mean_nees": _or_none(np.mean, nees),
        "median_nees": _or_none(np.median, nees),
        "in_gate": _or_none(np.mean, nees <= GATE_95),
    }


def _mean_and_sd(name, values):
    return {
        f"{name}_count": len(values),
        f"{name}_mean_m": _or_none(np.mean, values),
        f"{name}_sd_m": _or_none(np.std, values),
    }


def _or_none(function, values):
    return float(function(values)) if len(values) else None
