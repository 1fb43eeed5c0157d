# SPDX-License-Identifier: BSD-3-Clause
"""Reads tracklet_labels.xml of a KITTI raw drive: labeled objects."""

import math
import xml.etree.ElementTree as ElementTree

from datmo_tools.convert.true_boxes import TrueBox, TrueObject, occlusion_share
from datmo_tools.errors import InputError


def read_tracklets(path):
    """Returns a list of TrueObject in the file at `path`, in its order. Raises InputError."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise InputError(f"{path}: expected KITTI's tracklet XML ({error})") from error
    items = root.findall("tracklets/item")
    count = _number(path, root.find("tracklets"), "count", "the file")
    if len(items) != count:
        raise InputError(f"{path}: {len(items)} tracklets, expected {count:g} as its count says")
    return [_object(path, number, item) for number, item in enumerate(items)]


def _object(path, number, item):
    where = f"tracklet {number}"
    height = _number(path, item, "h", where)
    first = int(_number(path, item, "first_frame", where))
    poses = item.findall("poses/item")
    return TrueObject(
        number=number,
        label=item.findtext("objectType", "").strip(),
        length=_number(path, item, "l", where),
        width=_number(path, item, "w", where),
        height=height,
        boxes={
            first + i: _box(path, pose, height, f"{where}, pose {i}")
            for i, pose in enumerate(poses)
        },
    )


def _box(path, pose, height, where):
    """Returns a pose's TrueBox; tz is the bottom of the box."""
    x, y, bottom, yaw, level = (
        _number(path, pose, key, where) for key in ("tx", "ty", "tz", "rz", "occlusion")
    )
    return TrueBox(x, y, bottom + 0.5 * height, yaw, occlusion_share(level))


def _number(path, element, key, where):
    text = element.findtext(key) if element is not None else None
    try:
        value = float(text)
    except (TypeError, ValueError) as error:
        raise InputError(f"{path}: {where}: <{key}> is {text!r}, expected a number") from error
    if not math.isfinite(value):
        raise InputError(f"{path}: {where}: <{key}> is {text!r}, expected a finite number")
    return value
