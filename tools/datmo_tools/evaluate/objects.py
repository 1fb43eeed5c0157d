# SPDX-License-Identifier: BSD-3-Clause
"""evaluate objects."""

from pathlib import Path
from typing import NamedTuple

from datmo_tools.errors import InputError
from datmo_tools.evaluate import class_mistakes
from datmo_tools.evaluate.arguments import add_region, add_truth, region_of
from datmo_tools.evaluate.class_mistakes import as_dictionaries, mistakes_section, worst
from datmo_tools.evaluate.class_tally import calibration, class_sections, confusion, reports_of
from datmo_tools.evaluate.object_lists import read_lists
from datmo_tools.evaluate.object_scores import score_lists
from datmo_tools.evaluate.object_tally import ALL, BANDS, CLASSES, MOVING, ObjectTally
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.truth import ANY, NONE, Asked, Region, Truth
from datmo_tools.pose_path import PosePath
from datmo_tools.text_table import NO_VALUE, percent, rounded

DESCRIPTION = """\
Scores the objects of single measurements (/objects, /objects/stereo, /objects/fused of a run),
before tracking, against the true objects of the drive that the run was made from:

  recall       share of the true objects visible to the sensor that are found, by class and range
  precision    share of the objects near a true one, moving or not; stationary things that are no
               true object (walls, fences, things that KITTI does not label) are false
  class right  of the objects that are found, by true class; the confusion of classes by range, and
               how often a class is right at which probability; the worst mistakes, with --images
               in the camera's images
  error        of the near side along the line of sight (positive: too far), and of its corners
               across it (to the left), as far as they are seen; mean and standard deviation
  NEES         of both by the object's own covariance: 2 in the mean and 1.39 in the median if it is
               consistent, and then 95 % of the objects are within the gate

An object is near if it lies, with the nearest point in the middle of its bearings, within 1 m of
the true box across the line of sight, and within 1 m, or 5 m x range / 36 m if that is more, along
it (thesis 3.3.3). A true object is found by one object only; others near it are doubles.

KITTI's labels cover only the camera's view, and do not state which sensor sees what:
--visible-to none --half-angle 0.7."""

# The sensor that must see a true object for it to count for a topic.
SENSORS = {"/objects": "scanner", "/objects/stereo": "stereo", "/objects/mono": ANY,
           "/objects/fused": ANY}  # fmt: skip

RANGE = 36.0  # m; thesis 3.3.3


class Reports(NamedTuple):
    """The classes of the scored objects."""

    by_topic: dict  # topic -> list of Report
    path: PosePath  # true, of base_link


def score(run, drive=None, topics=None, visible_to=None, region=Region(RANGE), moving_only=False):
    """Returns the score of the objects in the bag `run` (Path) as a dictionary that JSON can hold,
    and Reports: the classes reported on each topic.

    drive: bag with the truth (Path), by default `run`; topics: by default those of SENSORS in the
    bag; visible_to: sensor that must see a true object, by default that of SENSORS; moving_only:
    stationary true objects need not be found. Raises InputError, also if nothing can be scored.
    """
    drive = drive or run
    lists = read_lists(run, topics or SENSORS)
    for topic in topics or ():
        if topic not in lists:
            raise InputError(f"{run}: nothing on {topic}, expected lists of objects")
    if not lists:
        raise InputError(f"{run}: nothing on {', '.join(SENSORS)}, expected lists of objects")
    truth = Truth(drive)
    scored = {
        topic: _score_topic(
            lists[topic], truth, Asked(region, visible_to or SENSORS.get(topic, ANY), moving_only)
        )
        for topic in topics or SENSORS
        if topic in lists
    }
    scores = {topic: item for topic, (item, _) in scored.items()}
    if not any(item["lists"] for item in scores.values()):
        raise InputError(f"{run}: no list has a stamp near one of the truth in {drive}")
    result = {"run": str(run), "drive": str(drive), "range_m": region.range,
              "half_angle_rad": region.half_angle, "moving_only": moving_only,
              "topics": scores}  # fmt: skip
    return result, Reports({topic: reports for topic, (_, reports) in scored.items()}, truth.path)


def _score_topic(lists, truth, asked):
    truth.check_seen_by(asked.sensor)
    region = asked.region
    tally = ObjectTally([*(edge for edge in BANDS if edge < region.range), region.range])
    reports = []
    judged = truth.beside(lists, asked)
    for item, result in zip(judged, score_lists(judged)):
        tally.add(item.objects, item.truths, result, region)
        reports += reports_of(item, result, region, truth.path)
    without = len(lists) - tally.lists
    result = {"visible_to": asked.sensor, "lists_without_truth": without, **tally.result(),
              "confusion": confusion(reports, tally.edges),
              "calibration": calibration(reports)}  # fmt: skip
    return result, reports


def sections(result):
    """Returns a list of Section for a score."""
    return [section for topic in result["topics"].items() for section in _of_topic(*topic)]


def _of_topic(topic, item):
    bands = [f"{near:g}-{far:g} m" for near, far in item["bands_m"]] + ["all"]
    recall = [["recall, %", *bands, "class right, %"]]
    for group in (*CLASSES, MOVING, ALL):
        right = item["class_right"].get(group)
        shares = _shares(item["recall"][group])
        if item["recall"][group]["of"][-1]:
            recall.append([group, *shares, percent(right["share"]) if right else ""])
    precision = [["precision, %", *bands]]
    for group in (*CLASSES, ALL):
        if item["precision"][group]["of"][-1]:
            precision.append([group, *_shares(item["precision"][group])])
    errors = [["error", *bands], *_error_rows(item["errors"])]
    counts = (
        f"{item['lists']} lists ({item['lists_without_truth']} more without truth), in each "
        f"{item['objects_per_list']:.2f} objects, {item['false_per_list']:.2f} false, "
        f"{item['doubles_per_list']:.2f} doubles"
    )
    heading = f"{topic}, true objects visible to {item['visible_to']}"
    tables = (recall, precision, errors)
    return [Section(heading, lines=[counts]), *(Section(rows=rows) for rows in tables),
            *class_sections(item)]  # fmt: skip


def _shares(item):
    return [
        NO_VALUE if share is None else f"{percent(share)} of {of}"
        for share, of in zip(item["share"], item["of"])
    ]


def _error_rows(errors):
    for key in ("along", "across"):
        yield [f"{key}, m", *(_mean_and_sd(item, key) for item in errors)]
        yield [f"of {key}", *(str(item[f"{key}_count"]) for item in errors)]
    yield ["NEES, mean", *(rounded(item["mean_nees"], 2) for item in errors)]
    yield ["NEES, median", *(rounded(item["median_nees"], 2) for item in errors)]
    yield ["in 95 % gate, %", *(percent(item["in_gate"]) for item in errors)]
    yield ["of both", *(str(item["nees_count"]) for item in errors)]


def _mean_and_sd(item, key):
    if not item[f"{key}_count"]:
        return NO_VALUE
    return f"{item[key + '_mean_m']:+.2f} ± {item[key + '_sd_m']:.2f}"


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    result, reports = score(values.run, values.truth, values.topic, values.visible_to,
                            region_of(values), values.moving_only)  # fmt: skip
    mistakes = {topic: worst(items, values.mistakes) for topic, items in reports.by_topic.items()}
    for topic, items in mistakes.items():
        result["topics"][topic]["mistakes"] = as_dictionaries(items)
    shown = [section for topic, items in mistakes.items()
             for section in mistakes_section(items, reports.path, values, f"Worst mistakes of {topic}")]  # fmt: skip
    return result, [*sections(result), *shown]


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag")
    add_truth(parser)
    add("--topic", action="append",
        help=f"of objects; may be repeated (default: {', '.join(SENSORS)}, if there)")  # fmt: skip
    add("--visible-to", metavar="SENSOR",
        help=f"that must see a true object, {ANY}, or {NONE}: not required (default: scanner for "
        f"/objects, stereo for /objects/stereo, else {ANY})")  # fmt: skip
    add("--moving-only", action="store_true", help="stationary true objects need not be found")
    add_region(parser, RANGE)
    class_mistakes.add_arguments(parser)
