# SPDX-License-Identifier: BSD-3-Clause
"""evaluate maps."""

from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from datmo_tools import transforms
from datmo_tools.errors import InputError
from datmo_tools.evaluate.grid_recordings import POLE, base_grids, grid_messages
from datmo_tools.evaluate.map_scores import (
    FROM_CURB,
    NOTHING,
    REACH,
    Moment,
    boxes_from,
    count,
)
from datmo_tools.evaluate.parked_rows import RowOptions
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.true_road import SPACING, TrueRoad
from datmo_tools.evaluate.truth import read_true_objects
from datmo_tools.pose_path import planar
from datmo_tools.text_table import rounded

DESCRIPTION = f"""\
Scores the maps of a run (of grid_slam, or of map_fusion) against the truth of the simulated drive
that it was made from, within {REACH:g} m of the vehicle, aligned by the run's own pose: drift of the
pose does not count here.

  occupied  share of the occupied road cells within a cell of a stationary object
  free      share of the free road cells that are outside of stationary objects
  things    share of the stationary objects seen by some sensor that are within a cell of an
            occupied one; and the same for thin poles
  conflicts cells per map in which sources contradict each other (at least 25 percent)

The road is the area between its curbs along the vehicle's path, {FROM_CURB:g} m from them, except at
intersections; buildings are not in the truth. Objects that stand now and move at another time are
not scored."""

CONFLICT = 25  # percent, from which map_fusion counts a cell (conflict_from)
NEAR_STAMP = 50_000_000  # ns, from a map to the truth


class _Truth:
    """The stationary objects around the vehicle, at any stamp of a drive."""

    def __init__(self, path):
        objects = read_true_objects(path)
        if not objects:
            raise InputError(f"{path}: no true objects, expected a drive of simulate")
        self._stamps = np.array(sorted(objects))
        self._objects = objects
        self._movers = {item.id for items in objects.values() for item in items if item.moving}
        self._first_seen = {}
        for stamp in self._stamps.tolist():
            for item in objects[stamp]:
                if item.visible_to:
                    self._first_seen.setdefault(item.id, stamp)
        self._road = TrueRoad(path, RowOptions(), np.inf)
        stations = self._road.stations
        self._tree = cKDTree(stations.positions)
        self._across = np.column_stack([-np.sin(stations.headings), np.cos(stations.headings)])

    def at(self, stamp):
        """Returns the Moment at `stamp` (ns); None if no truth is near in time."""
        nearest = int(self._stamps[np.argmin(np.abs(self._stamps - stamp))])
        if abs(nearest - stamp) > NEAR_STAMP:
            return None
        base = self._road.poses.at(stamp)
        items = self._objects[nearest]
        standing = [item for item in items if item.id not in self._movers]
        resting = [item for item in items if item.id in self._movers and not item.moving]
        seen = [self._first_seen.get(item.id, stamp + 1) <= stamp for item in standing]
        return Moment(
            boxes_from(base, [_box(item) for item in standing]),
            boxes_from(base, [_box(item) for item in resting]),
            np.array(seen, dtype=bool),
            np.array([item.label == POLE for item in standing], dtype=bool),
            lambda points: self._is_road(transforms.points_in_parent(base, points)),
        )

    def _is_road(self, points):
        if not len(points):
            return np.zeros(0, dtype=bool)
        distance, station = self._tree.query(points)
        offsets = points - self._road.stations.positions[station]
        lateral = np.sum(offsets * self._across[station], axis=1)
        left, right = (self._road.sides[name].curb[station] for name in ("left", "right"))
        beside = np.abs(distance**2 - lateral**2) <= SPACING**2  # not beyond an end of the path
        with np.errstate(invalid="ignore"):
            return beside & (lateral <= left - FROM_CURB) & (-lateral <= right - FROM_CURB)


def _box(item):
    return (*planar(item.pose), item.size.x, item.size.y)


def score(run, drive, topic="/map/fused", conflicts="/map/conflicts"):
    """Returns the score of the maps on `topic` in the bag `run` (Path) against the drive's bag
    (Path), as a dictionary that JSON can hold. Raises InputError, also without such truth."""
    truth = _Truth(drive)
    counts, maps = NOTHING, 0
    for stamp, grid in base_grids(run, topic):
        moment = truth.at(stamp)
        if moment is not None:
            counts += count(grid, moment)
            maps += 1
    if maps == 0:
        raise InputError(f"{run}: no grid on {topic} of a stamp with truth in {drive}")
    return {
        "run": str(run),
        "drive": str(drive),
        "topic": topic,
        "maps": maps,
        **counts._asdict(),
        "conflicts": _conflicts(run, conflicts),
    }


def _conflicts(run, topic):
    """Returns the mean number of cells in conflict of a map; None if they are not published."""
    numbers = [int(np.sum(grid.cells >= CONFLICT)) for _, _, grid in grid_messages(run, topic)]
    return float(np.mean(numbers)) if numbers else None


def sections(result):
    """Returns a list of Section for a score."""
    rows = [[result["topic"], "right", "of"]]
    for name, right, of in (
        ("occupied", "occupied_right", "occupied"),
        ("free", "free_right", "free"),
        ("things", "things_found", "things"),
        ("poles", "poles_found", "poles"),
    ):
        rows.append([name, rounded(share(result, right, of), 4), str(result[of])])
    rows.append(["conflicts", "", rounded(result["conflicts"], 1)])
    return [Section(rows=rows, lines=[f"{result['maps']} maps"])]


def share(result, right, of):
    """Returns the share of two counts of a score; None if there is nothing."""
    return result[right] / result[of] if result[of] else None


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    result = score(values.run, values.drive, values.topic, values.conflicts)
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag, with --map-fusion or without")
    add("drive", type=Path, metavar="DRIVE.bag", help="bag of simulate")
    for option, what in (("topic", "of the maps"), ("conflicts", "of their conflicts")):
        default = {"topic": "/map/fused", "conflicts": "/map/conflicts"}[option]
        add(f"--{option}", default=default, metavar="TOPIC", help=f"{what} (default %(default)s)")
