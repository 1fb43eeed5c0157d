# SPDX-License-Identifier: BSD-3-Clause
"""evaluate grids."""

import math
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.grid_recordings import grid_pairs, read_drive
from datmo_tools.evaluate.grid_scores import GridScores
from datmo_tools.evaluate.report import Section
from datmo_tools.text_table import NO_VALUE

DESCRIPTION = """\
Scores the fused grids of a run against the truth of the simulated drive that it was made from
(simulate with stereo/enabled=true and ground_truth/echoes=true): how many of the cells that white
paint occupies in the lidar's grid fusion removed; how many of the cells of true obstacles it
lost; and at how many stamps a thin pole that the camera sees is in the fused grid and in the
lidar's. In view means within the camera's image and effective range, and not behind a true object."""

# Edges of the bands of range, m, as far as they are within the camera's effective range.
BANDS = (0.0, 10.0, 20.0)

EFFECTIVE_RANGE = 36.0  # m; thesis 3.3.3
DISPARITY_SIGMA = 0.25  # px; as the simulator's default

ROWS = (
    ("paint cells gone", "paint_gone"),
    ("obstacle cells lost", "bodies_lost"),
    ("poles in lidar grid", "poles_in_lidar"),
    ("poles in fused grid", "poles_in_fused"),
)


def score(run, drive, lidar="/grids/lidar", fused="/grids/fused", reach=EFFECTIVE_RANGE,
          disparity_sigma=DISPARITY_SIGMA):  # fmt: skip
    """Returns the score of the grids in the bag `run` (Path) against the drive's bag (Path), as a
    dictionary that JSON can hold.

    lidar, fused: topics; reach: effective range of the camera, m; disparity_sigma: px. Raises
    InputError, also if the two bags have no stamp in common.
    """
    edges = [*(edge for edge in BANDS if edge < reach), reach]
    recorded = read_drive(drive, reach, disparity_sigma)
    scores = GridScores(recorded.view, edges)
    used = 0
    for stamp, lidar_grid, fused_grid in grid_pairs(run, lidar, fused):
        moment = recorded.moments.get(stamp)
        if moment is not None:
            scores.add(lidar_grid, fused_grid, moment.echoes, moment.bodies, moment.poles)
            used += 1
    if used == 0:
        raise InputError(
            f"{run}: no stamp with both {lidar} and {fused} that is one of {len(recorded.moments)} "
            f"scans with truth in {drive}"
        )
    columns = ["whole grid", "in view"]
    columns += [f"{near:g}-{far:g} m" for near, far in zip(edges, edges[1:])]
    return {
        "run": str(run),
        "drive": str(drive),
        "scans_with_truth": len(recorded.moments),
        "scans_scored": used,
        "columns": columns,
        **{key: _figures(getattr(scores, key)) for _, key in ROWS},
    }


def sections(result):
    """Returns a list of Section for a score."""
    rows = [["", *result["columns"]]]
    for name, key in ROWS:
        rows.append([name, *map(_share, result[key]["percent"], result[key]["of"])])
    scored = f"{result['scans_scored']} of {result['scans_with_truth']} scans scored"
    return [Section(rows=rows, lines=[scored])]


def _share(percent, count):
    return f"{percent:.1f}% of {count}" if count else NO_VALUE


def _figures(tally):
    percent = [None if math.isnan(share) else float(share) for share in tally.percent()]
    return {"count": tally.having.tolist(), "of": tally.total.tolist(), "percent": percent}


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    command_line.check_positive(values, "effective_range", "disparity_sigma")
    result = score(values.run, values.drive, values.lidar, values.fused, values.effective_range,
                   values.disparity_sigma)  # fmt: skip
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag")
    add("drive", type=Path, metavar="DRIVE.bag", help="bag of simulate")
    for source in ("lidar", "fused"):
        add(f"--{source}", default=f"/grids/{source}", metavar="TOPIC",
            help="of the grids (default %(default)s)")  # fmt: skip
    command_line.add_number(parser, "--effective-range", EFFECTIVE_RANGE, "M",
                            "effective range of the camera, m")  # fmt: skip
    command_line.add_number(parser, "--disparity-sigma", DISPARITY_SIGMA, "PX",
                            "standard deviation of disparities, px: how far poles may be off along the line of "
                            "sight")  # fmt: skip
