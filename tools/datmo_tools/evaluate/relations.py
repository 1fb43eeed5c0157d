# SPDX-License-Identifier: BSD-3-Clause
"""Scores a path by relations between poses: the metric of the SLAM benchmark.

Source: Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 27(4),
2009, equations 4 to 6. A relation is the robot's pose at one time relative to that at another; the
error of a path is the difference of its own relation between these times. No frames have to be
aligned, and an error at one pose counts only where poses are compared across it.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.errors import InputError
from datmo_tools.stamps import parse_seconds

FIELDS = 8  # two times, x, y, z, roll, pitch, yaw


class Relation(NamedTuple):
    """The robot's pose at `end` relative to that at `begin`."""

    begin: int  # ns
    end: int  # ns
    motion: np.ndarray  # x, y (m), yaw (rad)


class Errors(NamedTuple):
    """A path's errors, one for each relation that it covers."""

    translation: np.ndarray  # m
    rotation: np.ndarray  # rad, 0 to pi
    not_covered: int  # relations at whose times the path has no pose


class Statistics(NamedTuple):
    """Statistics of some values."""

    mean: float
    std: float  # of the values themselves, as published: divided by n
    maximum: float


def read_relations(path):
    """Returns a list of Relation in the file at `path` (Path); z, roll and pitch are ignored.

    Raises InputError with file and line.
    """
    try:
        lines = path.read_text(encoding="ascii").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: expected a relations file ({error})") from error
    words = [line.partition("#")[0].split() for line in lines]  # without comments
    relations = [
        _relation(f"{path}:{number}", fields) for number, fields in enumerate(words, 1) if fields
    ]
    if not relations:
        raise InputError(f"{path}: no relation in it, expected lines of {FIELDS} numbers")
    return relations


def errors_of(path, relations, tolerance):
    """Returns the Errors of a PosePath.

    A time is covered if the path has a pose within `tolerance` (ns) of it; then the pose at that
    time is interpolated.
    """
    covered = [
        relation
        for relation in relations
        if max(path.distance_from(stamp) for stamp in relation[:2]) <= tolerance
    ]
    differences = np.array([_difference(path, relation) for relation in covered]).reshape(-1, 3)
    return Errors(
        np.hypot(differences[:, 0], differences[:, 1]),
        np.abs(differences[:, 2]),
        len(relations) - len(covered),
    )


def statistics(values):
    """Returns the Statistics of an array that is not empty."""
    return Statistics(float(np.mean(values)), float(np.std(values)), float(np.max(values)))


def _difference(path, relation):
    """Returns the path's motion relative to the relation's end: x, y, yaw."""
    motion = transforms.relative(path.at(relation.begin), path.at(relation.end))
    return transforms.relative(relation.motion, motion)


def _relation(where, words):
    if len(words) != FIELDS:
        raise InputError(f"{where}: {len(words)} fields, expected {FIELDS}")
    try:
        begin, end = (parse_seconds(word) for word in words[:2])
        motion = np.array([float(words[i]) for i in (2, 3, 7)])
    except ValueError as error:
        raise InputError(f"{where}: {error}, expected {FIELDS} numbers") from error
    if not np.all(np.isfinite(motion)):
        raise InputError(f"{where}: x, y or yaw is not finite, expected {FIELDS} numbers")
    return Relation(begin, end, motion)
