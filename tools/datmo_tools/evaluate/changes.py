# SPDX-License-Identifier: BSD-3-Clause
"""evaluate changes."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from datmo_tools.errors import InputError
from datmo_tools.evaluate.grid_recordings import base_grids
from datmo_tools.evaluate.map_scores import boxes_from
from datmo_tools.evaluate.maps import share
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.truth import TRUE_POSE, read_true_objects
from datmo_tools.pose_path import planar, read_path
from datmo_tools.text_table import rounded

BEHIND = (5.0, 25.0)  # m: the vehicle has just passed what lies so far behind it
BESIDE = 15.0  # m, to each side
SAME = 1.0  # m, between the centers of one stationary object in both drives
NEAR = 0.6  # m, from a side: two cells of 0.3 m, for the map's own error

# Values of the cells, as map_fusion writes them.
NEW, VANISHED = 100, 0

DESCRIPTION = f"""\
Scores the changes that a run of map_fusion reports against a prior map, on simulated drives:
RUN.bag was made from DRIVE.bag in the map of a run of BEFORE.bag, a drive through the same scene.
Objects that stand in only one of the two drives, and that some sensor has seen, have vanished or
are new.

  cells   reported, and how many of these are within {NEAR:g} m of an actual change
  things  that have changed and that the vehicle has passed (they lie {BEHIND[0]:g} to {BEHIND[1]:g}
          m behind it, at most {BESIDE:g} m to a side), and how many of these are reported by then
  wrong   cells in a map (median) without an actual change"""


class _Standing(NamedTuple):
    """What never moves in a drive: x, y, yaw, length, width (n x 5; m, rad), and what was seen."""

    items: np.ndarray
    seen: np.ndarray


def _standing(path):
    objects = read_true_objects(path)
    if not objects:
        raise InputError(f"{path}: no true objects, expected a drive of simulate")
    everything = [item for items in objects.values() for item in items]
    movers = {item.id for item in everything if item.moving}
    boxes = {item.id: (*planar(item.pose), item.size.x, item.size.y) for item in everything}
    seen = {item.id for item in everything if item.visible_to}
    ids = sorted(set(boxes) - movers)
    return _Standing(
        np.array([boxes[name] for name in ids]).reshape(-1, 5),
        np.array([name in seen for name in ids], dtype=bool),
    )


def _alone(here, there):
    """Returns what was observed here and is not there, n x 5."""
    if not len(there.items):
        return here.items[here.seen]
    distances, _ = cKDTree(there.items[:, :2]).query(here.items[:, :2])
    return here.items[here.seen & (distances > SAME)]


class _Score:
    """Scores one kind of change."""

    def __init__(self, items):
        self.items = items
        self.cells = self.right = 0
        self.wrong = []
        self.passed = np.zeros(len(items), dtype=bool)
        self.reported = np.zeros(len(items), dtype=bool)

    def add(self, points, base):
        """Adds the cells (n x 2, base_link, m) of a map as seen from the true pose `base`."""
        boxes = boxes_from(base, self.items)
        near = boxes.depths(points) <= NEAR
        right = int(np.sum(near.any(axis=1)))
        self.cells += len(points)
        self.right += right
        self.wrong.append(len(points) - right)
        behind = -boxes.poses[:, 0]
        passed = (behind > BEHIND[0]) & (behind < BEHIND[1])
        passed &= np.abs(boxes.poses[:, 1]) < BESIDE
        self.passed |= passed
        self.reported |= passed & near.any(axis=0)

    def result(self):
        return {
            "cells": self.cells,
            "cells_right": self.right,
            "things": int(np.sum(self.passed)),
            "things_reported": int(np.sum(self.reported)),
            "wrong_cells": float(np.median(self.wrong)),
        }


def score(run, drive, before, topic="/map/changes"):
    """Returns the score of the changes on `topic` in the bag `run` (Path), which was made from the
    bag `drive` in the map of `before`, as a dictionary that JSON can hold. Raises InputError."""
    old, new = _standing(before), _standing(drive)
    scores = {"vanished": _Score(_alone(old, new)), "new": _Score(_alone(new, old))}
    path = read_path(drive, TRUE_POSE)
    maps = 0
    for stamp, grid in base_grids(run, topic):
        base = path.at(stamp)
        for kind, value in (("vanished", VANISHED), ("new", NEW)):
            rows, columns = np.nonzero(grid.cells == value)
            scores[kind].add(grid.centers(np.column_stack([columns, rows])), base)
        maps += 1
    if maps == 0:
        raise InputError(f"{run}: no grid on {topic}, expected a run of map_fusion with a prior map")
    return {
        "run": str(run),
        "drive": str(drive),
        "before": str(before),
        "maps": maps,
        **{kind: one.result() for kind, one in scores.items()},
    }


def sections(result):
    """Returns a list of Section for a score."""
    rows = [["", "cells", "right", "things passed", "reported", "wrong"]]
    for kind in ("vanished", "new"):
        one = result[kind]
        right = share(one, "cells_right", "cells")
        rows.append([kind, str(one["cells"]), rounded(right, 3), str(one["things"]),
                     str(one["things_reported"]), rounded(one["wrong_cells"], 1)])  # fmt: skip
    return [Section(rows=rows, lines=[f"{result['maps']} maps"])]


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    result = score(values.run, values.drive, values.before, values.topic)
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag --map-fusion --map FILE")
    add("drive", type=Path, metavar="DRIVE.bag", help="bag of simulate that RUN.bag was made from")
    add("before", type=Path, metavar="BEFORE.bag", help="bag of simulate that the map was made from")
    add("--topic", default="/map/changes", metavar="TOPIC", help="of the changes (default %(default)s)")
