# SPDX-License-Identifier: BSD-3-Clause
"""evaluate stereo_grids."""

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate import cloud_grids
from datmo_tools.evaluate.arguments import add_grids
from datmo_tools.evaluate.cloud_grids import CLOUDS
from datmo_tools.evaluate.grid_recordings import (
    CAMERA_INFOS,
    MOUNTS,
    mounts_of,
    read_topics,
    view_of,
)
from datmo_tools.evaluate.stereo_grid_scores import (
    NOTHING,
    REACH,
    CommonView,
    count,
    obstacle_points,
)
from datmo_tools.text_table import rounded

DESCRIPTION = """\
Scores the stereo (or fused) grids of a run with the Velodyne of the drive that it was made from
(kitti_to_bag --points --images), by range from the camera:

  precision    share of the occupied cells where the Velodyne has an obstacle
  recall       share of the cells with an obstacle that are occupied
  called free  share of the cells with an obstacle that are free; the others are unknown

An obstacle is anything 0.3 m to 2 m above the road, whose plane is fitted in each cloud. The cloud
closest in time is transformed to the grid's stamp by the true poses. A cell is right if the
other side has an obstacle within one cell, or within the standard deviation of the camera's depth
there, whichever is more. Areas that one of the two cameras does not see are excluded. OpenCV's
matchers give no disparity in the first columns of the left image, as many as disparity_range,
whatever is there: --first-column excludes them, too, so that the rest is scored by itself.

The Velodyne is mounted 8 cm above the cameras and 0.3 m behind them, so it sees a little more: over
low obstacles and roofs, where the cameras look along the surface; and between 0.3 m and 0.6 m above
the road nearer than 4.5 m, below the image's lower edge. It sees less than the cameras where its
files are cropped (z from -2.0 m to 0.3 m in its frame: some 2 m above the road) and between its
beams (0.4 degrees). Objects that moved between cloud and grid (up to 0.05 s) are slightly displaced."""

DISPARITY_SIGMA = 0.5  # px: the median error of semi-global matching on drive 0005

# Bands together: those for which the targets are stated.
SUMS = ((0.0, 15.0), (0.0, REACH))


def score(run, drive, topic="/grids/stereo", disparity_sigma=DISPARITY_SIGMA, first_column=0.0):
    """Returns the score of the grids on `topic` in the bag `run` (Path) against the drive's bag
    (Path), as a dictionary that JSON can hold.

    disparity_sigma: px; first_column: of the left image that counts, px. Raises InputError, also if
    no grid has a cloud near in time.
    """
    clouds, view = _read_drive(drive, disparity_sigma, first_column)
    counts, result = cloud_grids.score(
        run, drive, topic, clouds, lambda grid, points: count(grid, points, view), NOTHING
    )
    result["bands"] = [_band(*band) for band in cloud_grids.in_bands(counts, SUMS)]
    return result


def sections(result):
    """Returns a list of Section for a score."""
    return cloud_grids.sections(
        result, ["precision", "of occupied", "recall", "of obstacles", "called free"],
        lambda band: [rounded(band["precision"], 3), str(band["occupied"]), rounded(band["recall"], 3),
                      str(band["true"]), rounded(band["called_free"], 3)],
    )  # fmt: skip


def _read_drive(path, disparity_sigma, first_column):
    """Returns a dictionary stamp (ns) -> (its cloud's obstacles, n x 2, m,), and the CommonView."""
    kept, infos = read_topics(path, (MOUNTS, CLOUDS))
    if not kept[CLOUDS]:
        raise InputError(f"{path}: nothing on {CLOUDS}, expected a bag of kitti_to_bag --points")
    mounts = mounts_of(kept[MOUNTS])
    left = view_of(path, infos, mounts, REACH, disparity_sigma)
    projection = infos[CAMERA_INFOS[1]].P
    begin, end = left.tangents
    left = left._replace(tangents=(begin + first_column / projection[0], end))
    clouds = cloud_grids.points_by_stamp(
        path, kept[CLOUDS], mounts, lambda cloud, mount: (obstacle_points(cloud, mount),)
    )
    return clouds, CommonView(left, -projection[3] / projection[0], begin)


def _band(near, far, counts):
    occupied, right, true, found, free = counts
    return {
        "from": near,
        "to": far,
        "occupied": occupied,
        "right": right,
        "precision": right / occupied if occupied else None,
        "true": true,
        "found": found,
        "recall": found / true if true else None,
        "called_free": free / true if true else None,
    }


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    command_line.check_positive(values, "disparity_sigma")
    command_line.check_not_negative(values, "first_column")
    result = score(
        values.run, values.drive, values.topic, values.disparity_sigma, values.first_column
    )
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add_grids(parser, "/grids/stereo")
    command_line.add_number(parser, "--disparity-sigma", DISPARITY_SIGMA, "PX",
                            "standard deviation of disparities, px: by how far a cell may "
                            "be off")  # fmt: skip
    command_line.add_number(parser, "--first-column", 0.0, "PX",
                            "first column of the left image that counts")  # fmt: skip
