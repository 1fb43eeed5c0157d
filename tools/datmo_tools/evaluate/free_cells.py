# SPDX-License-Identifier: BSD-3-Clause
"""evaluate free_cells."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.bag_input import opened
from datmo_tools.convert import kitti_scans
from datmo_tools.errors import InputError
from datmo_tools.evaluate import cloud_grids, road_plane
from datmo_tools.evaluate.arguments import add_grids
from datmo_tools.evaluate.camera_images import Camera, camera_of
from datmo_tools.evaluate.cloud_grids import CLOUDS
from datmo_tools.evaluate.grid_recordings import (
    CAMERA_INFOS,
    MOUNTS,
    mounts_of,
)
from datmo_tools.evaluate.grid_scores import UNDECIDED
from datmo_tools.evaluate.stereo_grid_scores import BAND_EDGES, obstacle_points
from datmo_tools.text_table import rounded

DESCRIPTION = """\
Scores the free cells of a run's grids, of any source, with the Velodyne of the drive that it was
made from (kitti_to_bag --points --images), in the left camera's image, by range from the camera:

  precision  share of the free cells observed by the Velodyne that have no obstacle
  recall     share of the cells in which the Velodyne sees the road and no obstacle that are free

An obstacle is anything 0.3 m to 2 m above the road, whose plane is fitted in each cloud; the road is
within 0.15 m of it. The cloud closest in time is transformed to the grid's stamp by the true poses.
Objects that moved in between (up to 0.05 s) are slightly displaced."""

ROAD_TOLERANCE = 0.15  # m from the plane

SUMS = ((0.0, 20.0), (0.0, BAND_EDGES[-1]))


class Image(NamedTuple):
    """What an image shows of the road."""

    camera: Camera
    size: tuple  # px: columns, rows

    def ranges(self, points):
        """Returns ground distances (n, m) of road points (n x 2, base_link); inf: not in view."""
        pixels = self.camera.road_pixels(points)
        inside = np.all((pixels >= 0.0) & (pixels < self.size), axis=1)
        position = transforms.inverse(self.camera.camera_from_base)[:2, 3]
        return np.where(inside, np.linalg.norm(points - position, axis=1), np.inf)


class Counts(NamedTuple):
    """Numbers of cells by range band, n each."""

    known_free: np.ndarray  # free cells of the grid that the Velodyne observes
    right: np.ndarray  # those of them without an obstacle
    road: np.ndarray  # cells of the road that the Velodyne sees
    found: np.ndarray  # those of them that are free in the grid

    def __add__(self, other):
        return Counts(*(mine + its for mine, its in zip(self, other)))


NOTHING = Counts(*(np.zeros(len(BAND_EDGES) - 1, dtype=int) for _ in Counts._fields))


def count(grid, obstacles, road, image):
    """Returns the Counts of one grid (Grid); obstacles, road: n x 2, base_link at its stamp, m."""
    has_obstacle, has_road = (np.zeros(grid.cells.shape, dtype=bool) for _ in range(2))
    for points, cells in ((obstacles, has_obstacle), (road, has_road)):
        column, row = grid.cells_of(points).T
        cells[row, column] = True
    is_free = (grid.cells >= 0) & (grid.cells < UNDECIDED)
    is_road = has_road & ~has_obstacle
    chosen = (is_free & (has_obstacle | has_road), is_free & is_road, is_road, is_road & is_free)
    return Counts(*(_by_band(grid, cells, image) for cells in chosen))


def _by_band(grid, chosen, image):
    rows, columns = np.nonzero(chosen)
    ranges = image.ranges(grid.centers(np.column_stack([columns, rows])))
    return np.histogram(ranges, BAND_EDGES)[0]


def score(run, drive, topic):
    """Returns the score of the grids on `topic` in the bag `run` (Path) against the drive's bag
    (Path), as a dictionary that JSON can hold. Raises InputError."""
    clouds, image = _read_drive(drive)
    counts, result = cloud_grids.score(
        run, drive, topic, clouds, lambda grid, *points: count(grid, *points, image), NOTHING
    )
    result["bands"] = [_band(*band) for band in cloud_grids.in_bands(counts, SUMS)]
    return result


def _band(near, far, counts):
    free, right, road, found = counts
    return {
        "from": near,
        "to": far,
        "free": free,
        "precision": right / free if free else None,
        "road": road,
        "recall": found / road if road else None,
    }


def _read_drive(path):
    """Returns a dictionary stamp (ns) -> its cloud's obstacles and road (n x 2 each), and the
    Image."""
    kept = {MOUNTS: [], CLOUDS: [], CAMERA_INFOS[0]: []}
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages([*kept]):
            kept[topic].append(message)
    for topic in (CLOUDS, CAMERA_INFOS[0]):
        if not kept[topic]:
            raise InputError(
                f"{path}: nothing on {topic}, expected a bag of kitti_to_bag --points --images"
            )
    mounts = mounts_of(kept[MOUNTS])
    info = kept[CAMERA_INFOS[0]][0]
    image = Image(camera_of(path, info, mounts), (info.width, info.height))
    return cloud_grids.points_by_stamp(path, kept[CLOUDS], mounts, _parted), image


def _parted(cloud, base_from_velodyne):
    heights = road_plane.fit_road_plane(cloud).heights(cloud)
    chosen = np.abs(heights) <= ROAD_TOLERANCE
    chosen &= ~kitti_scans.on_own_car(cloud[:, 0], cloud[:, 1])
    road = transforms.apply(base_from_velodyne, cloud[chosen, :3].astype(float))[:, :2]
    return obstacle_points(cloud, base_from_velodyne), road


def sections(result):
    """Returns a list of Section for a score."""
    return cloud_grids.sections(
        result, ["precision", "of free", "recall", "of the road"],
        lambda band: [rounded(band["precision"], 4), str(band["free"]), rounded(band["recall"], 3), str(band["road"])],
    )  # fmt: skip


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    result = score(values.run, values.drive, values.topic)
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add_grids(parser, "/grids/mono")
