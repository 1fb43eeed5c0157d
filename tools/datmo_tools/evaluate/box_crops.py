# SPDX-License-Identifier: BSD-3-Clause
"""Cuts boxes out of camera images, with their edges drawn, as pictures for a page."""

import base64
from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.convert.kitti_raw import image_library
from datmo_tools.errors import InputError
from datmo_tools.evaluate.outlines import corners

DEFAULT_HEIGHT = 1.6  # m, of a box whose height is not measured: as mono_classifier/default_height

MARGIN = 0.4  # of the box's larger side in the image, around it
MIN_SIDE = 64  # px of the image
SHOWN_HEIGHT = 200  # px, of the picture
MAX_SCALE = 4.0
COLOR = (74, 222, 128)  # red, green, blue of the edges

# Corners 0 to 3 are on the road, 4 to 7 above them.
EDGES = [(i, (i + 1) % 4) for i in range(4)]
EDGES += [(4 + i, 4 + j) for i, j in EDGES] + [(i, 4 + i) for i in range(4)]


class Box(NamedTuple):
    """A box on the road."""

    pose: np.ndarray  # x, y (m), yaw (rad) of its center
    size: tuple  # m: length, width, height; 0: not measured
    velocity: np.ndarray  # m/s: vx, vy, in the frame of the pose

    def after(self, seconds):
        """Returns the Box predicted by this time (s)."""
        return self._replace(pose=self.pose + np.append(self.velocity * seconds, 0.0))

    def seen_from(self, base):
        """Returns its 8 corners (8 x 3, m) relative to a pose (x, y, yaw) in the same frame."""
        outline = corners(transforms.relative(base, self.pose), np.asarray(self.size[:2]))
        heights = np.repeat([0.0, self.size[2] or DEFAULT_HEIGHT], len(outline))
        return np.column_stack([np.tile(outline, (2, 1)), heights])


def crop(image, points):
    """Returns a data URL of a PNG: the part of a CameraImage around the 8 corners of a box
    (base_link at its stamp), with the edges that are ahead of the camera.

    Raises InputError if the box is not in the image.
    """
    pixels = image.camera.pixels(points)
    first, last = _window(pixels, image.pixels.shape[1::-1])
    part = image.pixels[first[1] : last[1], first[0] : last[0]]
    scale = float(np.clip(SHOWN_HEIGHT / len(part), 1.0, MAX_SCALE))
    cv2 = image_library()
    picture = np.ascontiguousarray(np.broadcast_to(part.reshape(*part.shape[:2], -1), (*part.shape[:2], 3)))
    picture = cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
    for one, other in EDGES:
        ends = (pixels[[one, other]] - first) * scale
        # Farther away than any picture is wide: OpenCV's coordinates are of 16 bits.
        if np.all(np.abs(ends) < 2**15):
            start, end = (tuple(map(int, np.round(point))) for point in ends)
            cv2.line(picture, start, end, COLOR, 1, cv2.LINE_AA)
    _, data = cv2.imencode(".png", picture[:, :, ::-1])
    return "data:image/png;base64," + base64.b64encode(data.tobytes()).decode("ascii")


def _window(pixels, size):
    """Returns first and last corner (x, y, px) of what is cut out; size: of the image, px."""
    ahead = pixels[np.isfinite(pixels).all(axis=1)]
    if not len(ahead):
        raise InputError("the box is not ahead of the camera")
    low, high = ahead.min(axis=0), ahead.max(axis=0)
    if np.any(high < 0.0) or np.any(low >= size):
        raise InputError("the box is outside the image")
    low, high = np.maximum(low, 0.0), np.minimum(high, size)
    half = np.maximum((0.5 + MARGIN) * np.max(high - low), 0.5 * MIN_SIDE)
    middle = 0.5 * (low + high)
    first = np.clip(np.floor(middle - half), 0, size).astype(int)
    return first, np.clip(np.ceil(middle + half), 0, size).astype(int)
