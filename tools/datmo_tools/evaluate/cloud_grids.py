# SPDX-License-Identifier: BSD-3-Clause
"""Compares a run's grids with the clouds of the Velodyne in its drive, by range."""

import numpy as np

from datmo_tools.convert import kitti_messages
from datmo_tools.errors import InputError
from datmo_tools.evaluate.grid_recordings import base_grids, mount_of
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.stereo_grid_scores import BAND_EDGES, moved
from datmo_tools.evaluate.truth import TRUE_POSE
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS

CLOUDS = "/points"

MAX_GAP = 0.1  # s, from a grid to the nearest cloud: a turn of the Velodyne


def points_by_stamp(path, messages, mounts, points_of):
    """Returns a dictionary stamp (ns) -> points_of(cloud, base_from_velodyne): tuple of points (n x
    2, base_link, m), of the clouds in the bag `path`."""
    velodyne = mount_of(path, mounts, messages[0].header.frame_id)
    return {
        message.header.stamp.to_nsec(): points_of(kitti_messages.points(message), velodyne)
        for message in messages
    }


def score(run, drive, topic, clouds, count, nothing):
    """Returns the sum of count(grid, *points) over the grids (Grid) on `topic` in the bag `run`,
    and what a score reports about them; the points are of the cloud nearest in time, transformed to
    the grid's stamp by the true poses.

    clouds: from points_by_stamp(), of the bag `drive`; nothing: initial value of the sum. Raises
    InputError if no grid has a cloud near in time.
    """
    path = read_path(drive, TRUE_POSE)
    counts, used, left_out = nothing, 0, 0
    for stamp, grid, nearest in _with_clouds(run, topic, clouds):
        if nearest is None:
            left_out += 1
            continue
        then, now = path.at(nearest), path.at(stamp)
        counts += count(grid, *(moved(points, then, now) for points in clouds[nearest]))
        used += 1
    if used == 0:
        raise InputError(
            f"{run}: of {left_out} grids on {topic} none is within {MAX_GAP:g} s of a cloud in "
            f"{drive}, expected one or more"
        )
    return counts, {
        "run": str(run),
        "drive": str(drive),
        "topic": topic,
        "grids": used,
        "grids_without_cloud": left_out,
    }


def _with_clouds(run, topic, clouds):
    """Yields stamp (ns), Grid, and stamp of the cloud nearest in time, or None if none is near."""
    stamps = np.array(sorted(clouds))
    for stamp, grid in base_grids(run, topic):
        nearest = int(stamps[np.argmin(np.abs(stamps - stamp))])
        yield stamp, grid, nearest if abs(nearest - stamp) <= MAX_GAP * NANOSECONDS else None


def in_bands(counts, sums):
    """Yields begin and end (m) of each band, and its counts in each of `sums`, as int."""
    for near, far in [*zip(BAND_EDGES, BAND_EDGES[1:]), *sums]:
        chosen = [near <= begin < far for begin in BAND_EDGES[:-1]]
        yield near, far, [int(column[chosen].sum()) for column in counts]


def sections(result, columns, cells_of):
    """Returns a list of Section for a score. columns: headings; cells_of(band): cells below."""
    rows = [[result["topic"], *columns]]
    rows += [[f"{band['from']:g} to {band['to']:g} m", *cells_of(band)] for band in result["bands"]]
    scored = f"{result['grids']} grids, {result['grids_without_cloud']} more without a cloud"
    return [Section(rows=rows, lines=[scored])]
