# SPDX-License-Identifier: BSD-3-Clause
"""Compares objects' reported classes with the true ones: confusion by range, and calibration."""

from typing import NamedTuple, Optional

import numpy as np

from datmo_tools import transforms
from datmo_tools.evaluate.box_crops import Box
from datmo_tools.evaluate.object_tally import CLASSES, NAMES
from datmo_tools.evaluate.report import Section
from datmo_tools.text_table import percent

UNKNOWN = "unknown"
NOTHING = "nothing"  # no true object is near
TRUE_CLASSES = (*CLASSES, NOTHING)
BINS = 5  # of the reported probability, equally wide


class Report(NamedTuple):
    """One object or track that is reported with a class, and the true class there."""

    said: str  # of CLASSES
    probability: float  # as reported, 0 to 1
    true: str  # of TRUE_CLASSES
    distance: float  # m
    stamp: int = 0  # ns
    box: Optional[Box] = None  # in the map of the run
    track: Optional[int] = None  # id; None: an object of one measurement
    true_id: Optional[int] = None  # None: there is no true object

    @property
    def is_right(self):
        """Whether the reported class is right."""
        return self.said == self.true


def reports_of(judged, score, region, path):
    """Returns a list of Report: objects in the region with a class, of one true object or none.

    judged: ListWithTruth; score: its ListScore; region: in which objects count; path: PosePath of
    base_link, in whose map the reports' boxes are.
    """
    true_of = {i: judged.truths[j] for i, j, _ in score.matches}
    base = path.at(judged.stamp)
    reports = []
    for i, (item, is_near) in enumerate(zip(judged.objects, score.near)):
        said = NAMES.get(item.classification, UNKNOWN)
        is_double = is_near and i not in true_of
        if said == UNKNOWN or is_double or not region.contains(item.pose):
            continue
        true, true_id = _true_class(true_of.get(i))
        box = Box(transforms.compose(base, item.pose), (*item.size, item.height), np.zeros(2))
        reports.append(Report(said, item.class_probability, true, item.range, judged.stamp, box,
                              true_id=true_id))  # fmt: skip
    return reports


def _true_class(truth):
    """Returns class and id of a TrueState; None: there is none."""
    if truth is None:
        return NOTHING, None
    return NAMES.get(truth.classification, UNKNOWN), truth.source and truth.source.id


def confusion(reports, edges):
    """Counts by band of range (edges: m, rising): dictionary true class -> reported -> count."""
    bands = []
    for near, far in zip(edges, edges[1:]):
        table = {true: dict.fromkeys(CLASSES, 0) for true in TRUE_CLASSES}
        for report in reports:
            if near <= report.distance < far:
                table[report.true][report.said] += 1
        bands.append(table)
    return bands


def calibration(reports):
    """Returns by bin of the reported probability: count, mean probability, and share that is right;
    empty bins are left out."""
    bins = []
    for k in range(BINS):
        inside = [
            item for item in reports if min(int(item.probability * BINS), BINS - 1) == k
        ]
        if inside:
            bins.append({
                "count": len(inside),
                "said": float(np.mean([item.probability for item in inside])),
                "right": float(np.mean([item.is_right for item in inside])),
            })  # fmt: skip
    return bins


def class_sections(result):
    """Returns the sections of `bands_m`, `confusion` and `calibration` in a dictionary, if any."""
    if not result["calibration"]:
        return []
    rows = [["true class, by reported class", *CLASSES]]
    bands = zip(result["bands_m"], result["confusion"])
    for (near, far), table in bands:
        for true, said in table.items():
            if any(said.values()):
                rows.append([f"{true}, {near:g}-{far:g} m", *(str(n) for n in said.values())])
    shares = [["reported probability, %", "right, %", "of"]]
    for item in result["calibration"]:
        shares.append([percent(item["said"]), percent(item["right"]), str(item["count"])])
    return [Section(rows=rows), Section(rows=shares)]
