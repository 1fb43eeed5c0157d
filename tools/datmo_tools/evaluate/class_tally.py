# SPDX-License-Identifier: BSD-3-Clause
"""What objects are said to be against what they are: confusion by range, and calibration."""

from typing import NamedTuple

import numpy as np

from datmo_tools.evaluate.object_tally import CLASSES, NAMES
from datmo_tools.evaluate.report import Section
from datmo_tools.text_table import percent

NOTHING = "nothing"  # no true object is near
TRUE_CLASSES = (*CLASSES, NOTHING)
BINS = 5  # of the probability that is said, equally wide


class Report(NamedTuple):
    """One object that is said to be of a class, and what is there."""

    said: str  # of CLASSES
    probability: float  # that is said, 0 to 1
    true: str  # of TRUE_CLASSES
    distance: float  # m

    @property
    def is_right(self):
        """Whether it is what is said."""
        return self.said == self.true


def reports_of(objects, truths, score, region):
    """List of Report: the objects of a known class that are in the region and are one true object, or
    near none.

    objects, truths, score: as in score_lists; region: in which objects count.
    """
    true_of = {i: truths[j] for i, j, _ in score.matches}
    reports = []
    for i, (item, is_near) in enumerate(zip(objects, score.near)):
        said = NAMES.get(item.classification, "unknown")
        is_double = is_near and i not in true_of
        if said == "unknown" or is_double or not region.contains(item.pose):
            continue
        true = NAMES.get(true_of[i].classification, "unknown") if i in true_of else NOTHING
        reports.append(Report(said, item.class_probability, true, item.range))
    return reports


def confusion(reports, edges):
    """By band of range (edges: m, rising): dictionary true class -> said class -> count."""
    bands = []
    for near, far in zip(edges, edges[1:]):
        table = {true: dict.fromkeys(CLASSES, 0) for true in TRUE_CLASSES}
        for report in reports:
            if near <= report.distance < far:
                table[report.true][report.said] += 1
        bands.append(table)
    return bands


def calibration(reports):
    """By bin of the probability that is said: how many, its mean, and how many are right (share);
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
    """Sections of a dictionary with `bands_m`, `confusion` and `calibration`; none where no class is
    said."""
    if not result["calibration"]:
        return []
    rows = [["true class, by what is said", *CLASSES]]
    bands = zip(result["bands_m"], result["confusion"])
    for (near, far), table in bands:
        for true, said in table.items():
            if any(said.values()):
                rows.append([f"{true}, {near:g}-{far:g} m", *(str(n) for n in said.values())])
    shares = [["probability said, %", "right, %", "of"]]
    for item in result["calibration"]:
        shares.append([percent(item["said"]), percent(item["right"]), str(item["count"])])
    return [Section(rows=rows), Section(rows=shares)]
