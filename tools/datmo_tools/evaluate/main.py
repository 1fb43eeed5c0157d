# SPDX-License-Identifier: BSD-3-Clause
"""Command line of evaluate."""

import argparse
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.evaluate import (
    borders,
    calibrate_classes,
    calibrate_object_covariance,
    calibrate_track_sources,
    changes,
    classes,
    compare_borders,
    draw_borders,
    free_cells,
    grids,
    labels,
    maps,
    objects,
    operating_curve,
    risk,
    slam,
    stereo_grids,
    track_fusion,
    tracks,
)
from datmo_tools.evaluate.report import as_text, write

DESCRIPTION = """\
Scores the results of a run against ground truth: a table on the terminal, and in a folder a JSON
file and an HTML page that needs no network, both named after the subcommand. If something cannot be
scored, the message names what is missing in which file, and there is no report. compare_borders,
draw_borders and the calibrations write the files that their options name instead. evaluate
SUBCOMMAND --help explains what is scored."""

# Each has DESCRIPTION, add_arguments(parser), and evaluate(values): the score as a dictionary that
# JSON can hold, and its sections.
REPORTS = {
    "tracks": (tracks, "tracks, pose and times of one run, or of several side by side"),
    "classes": (classes, "the classes of the tracks"),
    "operating_curve": (operating_curve, "missed frames against false tracks a minute"),
    "track_fusion": (track_fusion, "the fusion of tracks: which tracks of two sensors belong to one object"),
    "labels": (labels, "tracks at positions labeled in a recording"),
    "objects": (objects, "the objects of single measurements, before tracking"),
    "borders": (borders, "the borders of the road"),
    "grids": (grids, "fused grids, on simulated drives"),
    "maps": (maps, "maps of stationary things, on simulated drives"),
    "changes": (changes, "reported changes since a prior map, on simulated drives"),
    "stereo_grids": (stereo_grids, "stereo grids, by the Velodyne of a KITTI drive"),
    "free_cells": (free_cells, "free cells of grids, by the Velodyne of a KITTI drive"),
    "risk": (risk, "risks of contact, on simulated drives"),
    "slam": (slam, "poses, by the relations of the SLAM benchmark"),
}

# Each has DESCRIPTION, PRODUCT, add_arguments(parser), and execute(values), which prints and writes
# files of its own: the PRODUCT.
OTHERS = {
    "compare_borders": (compare_borders, "moving objects and tracks, without and with borders of the road"),
    "draw_borders": (draw_borders, "pictures of the borders of the road"),
    "calibrate_classes": (calibrate_classes, "how often the classes of an image detector are right, by score"),
    "calibrate_object_covariance": (calibrate_object_covariance, "the errors of a camera's objects, by range"),
    "calibrate_track_sources": (calibrate_track_sources, "how reliable the tracks of each source are"),
}

SUBCOMMANDS = {**REPORTS, **OTHERS}


def main(arguments=None, score_run=None):
    """Runs the command line; returns its exit code.

    score_run: the program that matches tracks and scores a run; by default the one that is
    installed next to this.
    """
    values = _parser().parse_args(arguments)
    values.score_run = score_run
    name = values.subcommand
    module = SUBCOMMANDS[name][0]
    if name in OTHERS:
        return command_line.run("evaluate", lambda: module.execute(values), module.PRODUCT)
    return command_line.run("evaluate", lambda: _report(name, module, values), "report")


def _report(name, module, values):
    result, sections = module.evaluate(values)
    write(values.out, name, f"Evaluation: {name.replace('_', ' ')}", result, sections)
    print(as_text(sections))
    print(f"\nreport: {values.out / name}.html, {values.out / name}.json")


def _parser():
    parser = command_line.new_parser("evaluate", DESCRIPTION)
    subparsers = parser.add_subparsers(dest="subcommand", required=True, metavar="SUBCOMMAND")
    for name, (module, short) in SUBCOMMANDS.items():
        subparser = subparsers.add_parser(
            name, help=short, description=module.DESCRIPTION,
            formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
        module.add_arguments(subparser)
        if name in REPORTS:
            subparser.add_argument("--out", type=command_line.output_folder, default=Path("evaluation"),
                                   metavar="DIR", help="folder of the report (default %(default)s)")  # fmt: skip
    return parser
