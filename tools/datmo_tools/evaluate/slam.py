# SPDX-License-Identifier: BSD-3-Clause
"""evaluate slam."""

import math
import sys
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.convert.carmen_bag import LOG_STAMPS_TOPIC
from datmo_tools.errors import InputError
from datmo_tools.evaluate.relations import errors_of, read_relations, statistics
from datmo_tools.evaluate.report import Section
from datmo_tools.pose_path import PosePath, read_messages, read_path
from datmo_tools.stamps import NANOSECONDS

DESCRIPTION = """\
Scores the poses in a bag with the relations of the SLAM benchmark (Kuemmerle et al., "On measuring
the accuracy of SLAM algorithms", 2009): mean, standard deviation and greatest value of the
translational and the rotational error, and of their squares."""

# At a robot's pace, poses farther away in time carry no information.
TOLERANCE = 0.5  # s


def score(poses, relations_file, topic="/pose", recording=None, tolerance=TOLERANCE):
    """Returns the score of the poses on `topic` in a bag, as a dictionary that JSON can hold.

    poses, relations_file: Path; recording: bag (Path) with the log's stamps, if they were
    moved (see carmen_to_bag; None: `poses` itself may have them). tolerance: s between a
    relation's time and the nearest pose. Raises InputError, also if no relation is covered.
    """
    relations = read_relations(relations_file)
    path = _by_log_stamps(read_path(poses, topic), recording or poses)
    errors = errors_of(path, relations, round(tolerance * NANOSECONDS))
    used = len(errors.translation)
    if used == 0:
        first, last = (stamp / NANOSECONDS for stamp in (path.stamps[0], path.stamps[-1]))
        raise InputError(
            f"{relations_file}: none of {len(relations)} relations lies in the time of {topic} in "
            f"{poses}, {first:.3f} to {last:.3f} s"
        )
    degrees = [math.degrees(angle) for angle in errors.rotation]
    return {
        "poses": str(poses),
        "topic": topic,
        "relations": str(relations_file),
        "used": used,
        "not_covered": errors.not_covered,
        "translation_m": _figures(errors.translation),
        "rotation_deg": _figures(degrees),
        "squared_translation_m2": _figures(errors.translation**2),
        "squared_rotation_deg2": _figures([angle**2 for angle in degrees]),
    }


def sections(result):
    """Returns a list of Section for a score."""
    rows = [[f"error of {result['topic']}", "mean", "std", "max"]]
    for name, key in (
        ("translation, m", "translation_m"),
        ("rotation, deg", "rotation_deg"),
        ("translation squared, m^2", "squared_translation_m2"),
        ("rotation squared, deg^2", "squared_rotation_deg2"),
    ):
        rows.append([name, *(f"{result[key][figure]:.4f}" for figure in ("mean", "std", "max"))])
    counts = f"{result['used']} relations used, {result['not_covered']} not covered"
    return [Section(rows=rows, lines=[counts])]


def _by_log_stamps(path, bag):
    """Returns the path at the log's stamps, if `bag` has them: poses at scans, newly ordered."""
    references = read_messages(bag, LOG_STAMPS_TOPIC)
    if not references:
        return path
    pose_at = dict(zip(path.stamps.tolist(), path.poses))
    moved = {
        message.time_ref.to_nsec(): pose_at[message.header.stamp.to_nsec()]
        for message, _ in references
        if message.header.stamp.to_nsec() in pose_at
    }
    if len(moved) < 2:
        raise InputError(
            f"{bag}: {LOG_STAMPS_TOPIC} has {len(moved)} of the poses' stamps, expected the "
            "recording that the poses come from"
        )
    stamps = sorted(moved)
    return PosePath(stamps, [moved[stamp] for stamp in stamps])


def _figures(values):
    mean, std, maximum = statistics(values)
    return {"mean": mean, "std": std, "max": maximum}


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    command_line.check_not_negative(values, "tolerance")
    result = score(values.poses, values.relations, values.topic, values.recording, values.tolerance)
    if result["not_covered"]:
        print(
            f"evaluate: {result['not_covered']} of "
            f"{result['used'] + result['not_covered']} relations are not covered: no pose within "
            f"{values.tolerance:g} s of their times",
            file=sys.stderr,
        )
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("poses", type=Path, metavar="POSES.bag", help="bag of run_bag, or a recording")
    add("relations", type=Path, metavar="RELATIONS", help="lines of: t1 t2 x y z roll pitch yaw")
    topics = "Odometry, PoseStamped, PoseWithCovarianceStamped or Path (default %(default)s)"
    add("--topic", default="/pose", help=topics)
    recording = f"bag with {LOG_STAMPS_TOPIC}, if the poses' stamps are not the log's"
    add("--recording", type=Path, metavar="BAG", help=recording)
    near = "largest time (s) between a relation's time and the nearest pose"
    command_line.add_number(parser, "--tolerance", TOLERANCE, "S", near)
