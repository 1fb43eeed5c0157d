# SPDX-License-Identifier: BSD-3-Clause
"""evaluate stereo_grids."""


import numpy as np

from datmo_tools import command_line
from datmo_tools.convert import kitti_messages
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_grids
from datmo_tools.evaluate.grid_recordings import (
    CAMERA_INFOS,
    MOUNTS,
    base_grids,
    mount_of,
    mounts_of,
    read_topics,
    view_of,
)
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.stereo_grid_scores import (
    BAND_EDGES,
    NOTHING,
    REACH,
    CommonView,
    count,
    moved,
    obstacle_points,
)
from datmo_tools.evaluate.truth import TRUE_POSE
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.text_table import rounded

DESCRIPTION = """\
Scores the stereo (or fused) grids of a run with the Velodyne of the drive that it was made from
(kitti_to_bag --points --images), by range from the camera:

  precision    of the cells that are occupied, how many the Velodyne has an obstacle at
  recall       of the cells with an obstacle, how many are occupied
  called free  of the cells with an obstacle, how many are free; the others are unknown

An obstacle is what stands 0.3 m to 2 m above the road, whose plane is fitted in each cloud. The
cloud nearest in time is brought to the grid's stamp by the true poses. A cell is right where the
other side has an obstacle within one cell, or within the standard deviation of the camera's depth
there, whichever is more. What one of the two cameras does not see is left out. OpenCV's matchers
give no disparity in the first columns of the left image, as many as disparity_range says, whatever
is there: --first-column leaves them out too, so that the rest is judged by itself.

The Velodyne stands 8 cm above the cameras and 0.3 m behind them, so it sees a little more: over
low obstacles and roofs, where the cameras look along the surface; and between 0.3 m and 0.6 m above
the road nearer than 4.5 m, below the image's lower edge. It sees less than the cameras where its
files are cropped (z from -2.0 m to 0.3 m in its frame: some 2 m above the road) and between its
beams (0.4 degrees). What moved by itself between cloud and grid (up to 0.05 s) is a little off."""

CLOUDS = "/points"

DISPARITY_SIGMA = 0.5  # px: the median error of semi-global matching on drive 0005
MAX_GAP = 0.1  # s, from a grid to the nearest cloud: a turn of the Velodyne

# Bands together: those that the targets are stated for.
SUMS = ((0.0, 15.0), (0.0, REACH))


def with_clouds(run, drive, topic, clouds):
    """Yields stamp (ns), Grid, and stamp of the cloud nearest in time, of each grid on `topic` in the bag
    `run`; None: no cloud is near. clouds: by stamp, of the bag `drive`. Raises InputError if none has one."""
    stamps = np.array(sorted(clouds))
    found, left_out = False, 0
    for stamp, grid in base_grids(run, topic):
        nearest = int(stamps[np.argmin(np.abs(stamps - stamp))])
        is_near = abs(nearest - stamp) <= MAX_GAP * NANOSECONDS
        found, left_out = found or is_near, left_out + (not is_near)
        yield stamp, grid, nearest if is_near else None
    if not found:
        raise InputError(
            f"{run}: of {left_out} grids on {topic} none is within {MAX_GAP:g} s of a cloud in "
            f"{drive}, expected one or more"
        )


def score(run, drive, topic="/grids/stereo", disparity_sigma=DISPARITY_SIGMA, first_column=0.0):
    """Score of the grids on `topic` in the bag `run` (Path) against the drive's bag (Path), as a
    dictionary that JSON can hold.

    disparity_sigma: px; first_column: of the left image that counts, px. Raises InputError, also if
    no grid has a cloud near in time.
    """
    clouds, view = _read_drive(drive, disparity_sigma, first_column)
    path = read_path(drive, TRUE_POSE)
    counts, used, left_out = NOTHING, 0, 0
    for stamp, grid, nearest in with_clouds(run, drive, topic, clouds):
        if nearest is None:
            left_out += 1
            continue
        points = moved(clouds[nearest], path.at(nearest), path.at(stamp))
        counts += count(grid, points, view)
        used += 1
    return {
        "run": str(run),
        "drive": str(drive),
        "topic": topic,
        "grids": used,
        "grids_without_cloud": left_out,
        "bands": _bands(counts),
    }


def sections(result):
    """List of Section of a score."""
    rows = [[result["topic"], "precision", "of occupied", "recall", "of obstacles", "called free"]]
    rows += [
        [
            f"{band['from']:g} to {band['to']:g} m",
            rounded(band["precision"], 3),
            str(band["occupied"]),
            rounded(band["recall"], 3),
            str(band["true"]),
            rounded(band["called_free"], 3),
        ]
        for band in result["bands"]
    ]
    scored = f"{result['grids']} grids, {result['grids_without_cloud']} more without a cloud"
    return [Section(rows=rows, lines=[scored])]


def _read_drive(path, disparity_sigma, first_column):
    """Dictionary stamp (ns) -> obstacles of its cloud (n x 2, base_link, m), and the CommonView."""
    kept, infos = read_topics(path, (MOUNTS, CLOUDS))
    if not kept[CLOUDS]:
        raise InputError(f"{path}: nothing on {CLOUDS}, expected a bag of kitti_to_bag --points")
    mounts = mounts_of(kept[MOUNTS])
    left = view_of(path, infos, mounts, REACH, disparity_sigma)
    projection = infos[CAMERA_INFOS[1]].P
    begin, end = left.tangents
    left = left._replace(tangents=(begin + first_column / projection[0], end))
    velodyne = mount_of(path, mounts, kept[CLOUDS][0].header.frame_id)
    clouds = {
        message.header.stamp.to_nsec(): obstacle_points(kitti_messages.points(message), velodyne)
        for message in kept[CLOUDS]
    }
    return clouds, CommonView(left, -projection[3] / projection[0], begin)


def _bands(counts):
    ends = [*zip(BAND_EDGES, BAND_EDGES[1:]), *SUMS]
    return [_band(counts, near, far) for near, far in ends]


def _band(counts, near, far):
    chosen = [near <= begin < far for begin in BAND_EDGES[:-1]]
    occupied, right, true, found, free = (int(column[chosen].sum()) for column in counts)
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
    """The score, and its sections. Raises InputError."""
    command_line.check_positive(values, "disparity_sigma")
    if values.first_column < 0.0:
        raise InputError(f"--first-column is {values.first_column:g}, expected 0 or more")
    result = score(
        values.run, values.drive, values.topic, values.disparity_sigma, values.first_column
    )
    return result, sections(result)


def add_arguments(parser):
    """Of this subcommand, for argparse."""
    add_grids(parser, "/grids/stereo")
    command_line.add_number(parser, "--disparity-sigma", DISPARITY_SIGMA, "PX",
                            "standard deviation of disparities, px: how far off a cell may "
                            "be")  # fmt: skip
    command_line.add_number(parser, "--first-column", 0.0, "PX",
                            "of the left image that counts")  # fmt: skip
