# SPDX-License-Identifier: BSD-3-Clause
"""The worst mistakes among reported classes, with what the camera's image shows there."""

from pathlib import Path

import numpy as np

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.box_crops import crop
from datmo_tools.evaluate.camera_images import CAMERA, MAX_GAP, read_usable_images
from datmo_tools.evaluate.class_tally import NOTHING
from datmo_tools.evaluate.report import Picture, Section
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.text_table import NO_VALUE, percent

COUNT = 12
SAME_PLACE = 2.0  # m between two reports about one thing without an id

HINT = (
    "The most confident wrong classes, then objects that are reported where the truth has none; of "
    "each track, or of one thing, the most confident report."
)
HEADINGS = ("reported", "true", "probability, %", "range, m", "stamp, s", "track", "true object", "image")


def add_arguments(parser):
    """Adds the options --images, --camera and --mistakes."""
    add = parser.add_argument
    add("--images", type=Path, metavar="DRIVE.bag",
        help="bag with rectified images, camera_info and /tf_static, of the drive that the run was "
        "made from (kitti_to_bag --images): the page shows the worst mistakes in them")  # fmt: skip
    add("--camera", default=CAMERA, metavar="NAME",
        help="of NAME/image_rect and NAME/camera_info (default %(default)s)")  # fmt: skip
    add("--mistakes", type=command_line.count, default=COUNT, metavar="N",
        help="number of the worst mistakes shown (default %(default)s)")  # fmt: skip


def worst(reports, count):
    """Returns the wrong ones of a list of Report, at most `count`, each about another thing: those
    of a true object first, the most confident first. Objects whose true class is not known are no
    mistakes."""
    wrong = [item for item in reports if not item.is_right and item.true != "unknown"]
    wrong.sort(key=lambda item: (item.true == NOTHING, -item.probability, item.stamp))
    chosen = []
    for item in wrong:
        if len(chosen) < count and not any(_is_same(item, other) for other in chosen):
            chosen.append(item)
    return chosen


def _is_same(one, other):
    """Whether two reports say the same of one thing."""
    if (one.said, one.true) != (other.said, other.true):
        return False
    if one.track is not None or one.true_id is not None:
        return (one.track, one.true_id) == (other.track, other.true_id)
    return np.hypot(*(one.box.pose[:2] - other.box.pose[:2])) <= SAME_PLACE


def as_dictionaries(mistakes):
    """Returns what JSON can hold of a list of Report."""
    return [{"said": item.said, "true": item.true, "probability": item.probability,
             "range_m": item.distance, "stamp_s": item.stamp / NANOSECONDS, "track": item.track,
             "true_object": item.true_id} for item in mistakes]  # fmt: skip


def mistakes_section(mistakes, path, values, title):
    """Returns a list with the Section of a list of Report, empty without any.

    path: PosePath of the vehicle in the map of their boxes; values: of add_arguments. Raises
    InputError if the bag of --images has no images.
    """
    if not mistakes:
        return []
    pictures, faults = _pictures(mistakes, path, values)
    rows = [_row(item, fault) for item, fault in zip(mistakes, faults)]
    return [Section(title, HINT, rows=(HEADINGS, *rows), pictures=tuple(pictures))]


def _pictures(mistakes, path, values):
    """Returns a Picture for each mistake that can be shown, and for all of them why not, or ""."""
    if values.images is None:
        return [], [NO_VALUE] * len(mistakes)
    stamps = sorted({item.stamp for item in mistakes})
    images, unusable = read_usable_images(values.images, values.camera.rstrip("/"), stamps)
    pictures, faults = [], []
    for item in mistakes:
        try:
            if item.stamp in unusable:
                raise unusable[item.stamp]
            if item.stamp not in images:
                raise InputError(f"no image with camera_info within {MAX_GAP:g} s")
            pictures.append(Picture(_crop(item, images[item.stamp], path), _caption(item)))
            faults.append("")
        except InputError as error:
            faults.append(str(error))
    return pictures, faults


def _crop(item, image, path):
    box = item.box.after((image.stamp - item.stamp) / NANOSECONDS)
    return crop(image, box.seen_from(path.at(image.stamp)))


def _caption(item):
    said, true, probability, distance, stamp, track, true_id, _ = _row(item, "")
    ids = [f"{name} {number}" for name, number in (("track", track), ("object", true_id))
           if number != NO_VALUE]  # fmt: skip
    return ", ".join([f"{said} ({probability} %), true: {true}", f"{distance} m", f"{stamp} s", *ids])


def _row(item, fault):
    ids = [NO_VALUE if number is None else str(number) for number in (item.track, item.true_id)]
    return (item.said, item.true, percent(item.probability), f"{item.distance:.1f}",
            f"{item.stamp / NANOSECONDS:.3f}", *ids, fault or "on the page")  # fmt: skip
