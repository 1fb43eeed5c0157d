# SPDX-License-Identifier: BSD-3-Clause
"""Reads a label_02 file of KITTI tracking (boxes in the rectified camera's frame): labeled objects.

Source: the readme of the KITTI tracking devkit: frame, track id, type, truncated, occluded, alpha,
image box (4), height, width, length, bottom center x y z, rotation about the camera's y axis.
"""

import math

import numpy as np

from datmo_tools import transforms
from datmo_tools.convert.true_boxes import TrueBox, TrueObject, occlusion_share
from datmo_tools.errors import InputError

FIELDS = 17
DONT_CARE = "DontCare"


def read_labels(path, left_from_velodyne):
    """Returns a list of TrueObject in the file at `path`, by track id, without DontCare regions.

    left_from_velodyne: 4 x 4, into the rectified left camera. Raises InputError with the line.
    """
    try:
        lines = path.read_text(encoding="ascii").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: expected a label_02 file of KITTI tracking ({error})") from error
    velodyne_from_left = transforms.inverse(left_from_velodyne)
    objects = {}
    for number, line in enumerate(lines, 1):
        words = line.split()
        if len(words) > 2 and words[2] == DONT_CARE:
            continue
        _add(objects, _fields(f"{path}:{number}", words), velodyne_from_left)
    return [objects[number] for number in sorted(objects)]


def _fields(where, words):
    if len(words) < FIELDS:
        raise InputError(f"{where}: {len(words)} fields, expected {FIELDS}")
    try:
        values = [int(words[0]), int(words[1]), words[2]] + [
            float(word) for word in words[3:FIELDS]
        ]
    except ValueError as error:
        raise InputError(f"{where}: {error}, expected KITTI's {FIELDS} fields") from error
    if not all(math.isfinite(value) for value in values[3:]):
        raise InputError(f"{where}: a field is not finite, expected {FIELDS} finite fields")
    return values


def _add(objects, fields, velodyne_from_left):
    frame, number, label, _, occluded = fields[:5]
    height, width, length, x, y, z, rotation = fields[10:FIELDS]
    known = objects.setdefault(number, TrueObject(number, label, length, width, height, {}))
    center = transforms.apply(velodyne_from_left, np.array([[x, y - 0.5 * height, z]]))[0]
    forward = velodyne_from_left[:3, :3] @ [math.cos(rotation), 0.0, -math.sin(rotation)]
    yaw = math.atan2(forward[1], forward[0])
    known.boxes[frame] = TrueBox(*center, yaw, occlusion_share(occluded))
