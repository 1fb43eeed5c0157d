# SPDX-License-Identifier: BSD-3-Clause
"""evaluate draw_borders."""

from pathlib import Path

import numpy as np

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.border_recordings import Run
from datmo_tools.evaluate.camera_images import CAMERA, read_images
from datmo_tools.evaluate.plot_files import drawing_module, picture_kind
from datmo_tools.whole_files import write_whole

DESCRIPTION = """\
Draws the road borders that a run found (run_bag --road-border), as sheets of pictures of
chosen moments: from above, with the scan, the objects that were kept and dropped, and the ground
truth if the bag has it (run_bag --with-truth); and with --images borders and scan projected into
the camera's images.

In the images everything is on the road, the plane z = 0 of base_link: the points of a scan are
below the end points of its beams; if the road slopes or the vehicle pitches, distant points are
displaced accordingly. A border is fainter the less probable it is."""

PRODUCT = "picture"

PERIOD = 5.0  # s
HISTORY = 3.0  # s
ROWS = 4


def execute(values):
    """Writes the sheets of pictures. Raises InputError."""
    kind = picture_kind(values.out, "--out")
    sheets = drawing_module("border_sheets").sheets
    command_line.check_positive(values, "every")
    command_line.check_not_negative(values, "history")
    run = Run(values.run)
    if not values.at and run.duration == 0.0:
        raise InputError(f"{values.run}: all borders have one stamp, expected two or more, or --at 0")
    stamps = run.nearest_stamps(values.at or np.arange(0.0, run.duration, values.every))
    images = None
    if values.images is not None:
        images = read_images(values.images, values.camera.rstrip("/"), stamps)
        if not images:
            raise InputError(f"{values.images}: no image with a stamp near those of {values.run}")
    pictures = sheets(run.moments(stamps, values.history), images, run.poses, kind, values.rows)
    write_whole(values.out.parent, dict(zip(_names(values.out, len(pictures)), pictures)))


def _names(out, count):
    """Returns the file names of the sheets: --out itself, or numbered ones."""
    if count == 1:
        return [out.name]
    return [f"{out.stem}_{number}{out.suffix}" for number in range(1, count + 1)]


def _times(text):
    return [command_line.number(word) for word in text.split(",")]


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag --road-border")
    add("--out", type=command_line.output_file, default=Path("road_borders.png"), metavar="FILE",
        help=".png, .svg or .pdf; several sheets are numbered (default %(default)s)")  # fmt: skip
    add("--at", type=_times, metavar="S,S", help="times, s since the run's first borders")
    add("--every", type=command_line.number, default=PERIOD, metavar="S",
        help="time between two pictures without --at, s (default %(default)s)")  # fmt: skip
    command_line.add_number(parser, "--history", HISTORY, "S",
                            "age up to which earlier scans are shown, s")  # fmt: skip
    add("--images", type=Path, metavar="DRIVE.bag",
        help="bag with rectified images, camera_info and /tf_static, of the drive that the run "
        "was made from (kitti_to_bag --images)")  # fmt: skip
    add("--camera", default=CAMERA, metavar="NAME",
        help="of NAME/image_rect and NAME/camera_info (default %(default)s)")  # fmt: skip
    add("--rows", type=command_line.count, default=ROWS, metavar="N",
        help="rows of pictures per sheet (default %(default)s)")  # fmt: skip
