# SPDX-License-Identifier: BSD-3-Clause
"""evaluate calibrate_classes."""

from pathlib import Path

import numpy as np
import yaml

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_region, add_table, add_truths, drives_of, region_of
from datmo_tools.evaluate.class_tally import NOTHING, reports_of
from datmo_tools.evaluate.object_lists import read_lists
from datmo_tools.evaluate.object_scores import score_lists
from datmo_tools.evaluate.truth import NONE, Asked, Truth
from datmo_tools.whole_files import write_file

DESCRIPTION = """\
Measures how often the detections of an image detector are right at each score, on drives with
truth, and writes it as yaml for mono_classifier: its reliability curve, and the true classes
of its wrong detections.

The runs must have the detector's own scores: run_bag --mono with mono_classifier/calibrated: false
and min_alone: 0. Detections are sorted by score into bins of equal counts; the share that is right,
with one right and one wrong detection added, is made to increase with the score (pool adjacent
violators: Ayer et al. 1955). Calibrate on other drives than those you evaluate on."""

PRODUCT = "table"

TOPICS = ("/objects/classes", "/objects/mono")
REPORTED = ("pedestrian", "cyclist", "vehicle")
# In the order of ObjectClass.
ACTUAL = {"unknown": (NOTHING, "unknown"), "pedestrian": ("pedestrian",), "cyclist": ("cyclist",),
          "vehicle": ("vehicle",), "pole": ("pole",)}  # fmt: skip
DIGITS = 3  # after the decimal point, of scores and shares
BIN_SIZE = 40  # reports: a share is known to 0.08
RANGE = 50.0  # m


def rising(shares, weights):
    """Returns the non-decreasing shares nearest to those given (weighted least squares): decreasing
    neighbors are pooled."""
    pools = []  # of (mean, weight, number)
    for share, weight in zip(shares, weights):
        pools.append((share, weight, 1))
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            (a, of_a, count_a), (b, of_b, count_b) = pools[-2:]
            pools[-2:] = [((a * of_a + b * of_b) / (of_a + of_b), of_a + of_b, count_a + count_b)]
    return [mean for mean, _, count in pools for _ in range(count)]


def curve(reports, bin_size):
    """Returns (scores, shares) of the reliability curve; scores increase, also as they are written:
    bins that differ by less are one. Raises InputError."""
    if not reports:
        raise InputError("no object of a known class in the runs: expected those of a detector")
    ordered = sorted(reports, key=lambda report: report.probability)
    bins = np.array_split(np.arange(len(ordered)), max(1, len(ordered) // bin_size))
    counts = {}  # score -> number of reports, number of right ones
    for indices in bins:
        inside = [ordered[i] for i in indices]
        score = round(float(np.mean([report.probability for report in inside])), DIGITS)
        count, right = counts.get(score, (0, 0))
        counts[score] = count + len(inside), right + sum(report.is_right for report in inside)
    shares = [(right + 1) / (count + 2) for count, right in counts.values()]
    return list(counts), rising(shares, [count for count, _ in counts.values()])


def mistaken(reports):
    """Returns what wrongly reported objects are: 3 x 5 shares by reported and true class; each
    class counted once more than observed."""
    table = []
    for said in REPORTED:
        wrong = [report.true for report in reports if report.said == said and not report.is_right]
        for actual, names in ACTUAL.items():
            count = sum(name in names for name in wrong)
            table.append(0.0 if actual == said else (count + 1) / (len(wrong) + len(ACTUAL) - 1))
    return table


def as_yaml(detector, reports, bin_size):
    """Returns the section of mono_classifier."""
    scores, shares = curve(reports, bin_size)
    section = {"scores": scores,
               "right": [round(value, DIGITS) for value in shares],
               "mistaken": [round(value, DIGITS) for value in mistaken(reports)]}  # fmt: skip
    return yaml.safe_dump({"mono_classifier": {detector: {"reliability": section}}},
                          default_flow_style=None, sort_keys=False)  # fmt: skip


def _reports(run, drive, topics, region):
    truth = Truth(drive)
    lists = read_lists(run, topics)
    if not lists:
        raise InputError(f"{run}: nothing on {', '.join(topics)}, expected a bag of run_bag --mono")
    reports = []
    for of_topic in lists.values():
        judged = truth.beside(of_topic, Asked(region, NONE))
        for item, score in zip(judged, score_lists(judged)):
            reports += reports_of(item, score, region, truth.path)
    return reports


def execute(values):
    """Prints the table and writes it to a file. Raises InputError."""
    region = region_of(values)
    reports = [report for run, drive in zip(values.runs, drives_of(values))
               for report in _reports(run, drive, values.topic or TOPICS, region)]  # fmt: skip
    text = as_yaml(values.detector, reports, values.bin_size)
    right = sum(report.is_right for report in reports)
    print(f"{len(reports)} reports, {right} of them right")
    print(text, end="")
    write_file(values.out, text)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("runs", nargs="+", type=Path, metavar="RUN.bag", help="bags of run_bag --mono")
    add_truths(parser)
    add("--detector", choices=("hog", "dnn"), required=True, help="detector of the runs")
    add("--topic", action="append",
        help=f"of the objects; may be repeated (default: {', '.join(TOPICS)})")  # fmt: skip
    add("--bin-size", type=command_line.count, default=BIN_SIZE, metavar="N",
        help="reports per point of the curve (default %(default)s)")  # fmt: skip
    add_table(parser, "class_reliability.yaml")
    add_region(parser, RANGE)
