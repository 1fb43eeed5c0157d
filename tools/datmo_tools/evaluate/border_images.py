# SPDX-License-Identifier: BSD-3-Clause
"""Projects borders into a camera's images: on the road, the plane z = 0 of base_link."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.evaluate.border_recordings import edge
from datmo_tools.evaluate.border_views import BAND, SHADES, SIGMAS, line_style, opacity
from datmo_tools.evaluate.grid_recordings import MOUNTS, mount_of, mounts_of
from datmo_tools.evaluate.nearest_messages import check_kinds, nearest_messages, topics_of
from datmo_tools.stamps import NANOSECONDS

IMAGE, INFO = "image_rect", "camera_info"
KINDS = {IMAGE: "sensor_msgs/Image", INFO: "sensor_msgs/CameraInfo"}

# Encodings, and the indices of red, green and blue in a pixel.
CHANNELS = {"mono8": (0,), "rgb8": (0, 1, 2), "bgr8": (2, 1, 0)}

MAX_GAP = 0.2  # s, from the borders to the image
STEP = 0.25  # m, sampling of a line, which the camera bends
NEAREST = 1.0  # m ahead of the camera; nearer points are out of view and would not project
MARKS = (10.0, 20.0, 30.0, 40.0)  # m ahead of base_link, labeled next to the borders
POINT = "#fde047"  # color of the scan, on gray


class CameraImage(NamedTuple):
    """An image with what is needed to draw on it."""

    stamp: int  # ns
    pixels: np.ndarray  # height x width, gray, or height x width x 3: red, green, blue
    camera_from_base: np.ndarray  # 4 x 4, into optical axes
    projection: np.ndarray  # 3 x 4

    def seen(self, points):
        """Projects points (n x 2, m) on the road to pixels (n x 2: right, down); NaN: not seen."""
        on_road = np.column_stack([points, np.zeros(len(points))])
        seen = transforms.apply(self.camera_from_base, on_road)
        seen[seen[:, 2] < NEAREST] = np.nan
        rays = transforms.apply(np.vstack([self.projection, np.zeros((1, 4))]), seen)
        return rays[:, :2] / rays[:, 2:]


def read_images(path, camera, stamps):
    """Returns a dictionary stamp of `stamps` (increasing, ns) -> the nearest CameraImage, if near.

    path: of the bag (Path); camera: the name of its topics without their last part. Raises
    InputError if there is no rectified image, no calibration or no mount.
    """
    kinds = {f"{camera}/{name}": kind for name, kind in KINDS.items()}
    topics = topics_of(path)
    check_kinds(path, topics, kinds)
    for topic in kinds:
        if topic not in topics:
            raise InputError(f"{path}: nothing on {topic}, expected a bag with rectified images")
    found = nearest_messages(path, kinds, stamps, round(MAX_GAP * NANOSECONDS))
    images, infos = (found[topic] for topic in kinds)
    with opened(path) as bag:
        mounts = mounts_of([message for _, message, _ in bag.read_messages([MOUNTS])])
    return {
        stamp: _camera_image(path, image, infos[stamp], mounts)
        for stamp, image in images.items()
        if stamp in infos
    }


def draw_image(ax, image, moment, base):
    """Draws a Moment's scan and borders into an image on the axes.

    base: pose (x, y, yaw) of base_link in the map at the image's stamp.
    """
    height, width = image.pixels.shape[:2]
    ax.imshow(image.pixels, cmap="gray", vmin=0, vmax=255, interpolation="antialiased")
    in_map = transforms.points_in_parent(moment.base, moment.points)
    seen = image.seen(transforms.points_seen_from(base, in_map))
    ax.plot(*seen.T, ".", color=POINT, markersize=2.5)
    for border in moment.borders:
        _draw_border(ax, image, border, base)
    ax.set(xlim=(-0.5, width - 0.5), ylim=(height - 0.5, -0.5))
    ax.axis("off")


def _draw_border(ax, image, border, base):
    middle, left, right = (
        _finely(transforms.points_seen_from(base, edge(border, sigmas)))
        for sigmas in (0.0, SIGMAS, -SIGMAS)
    )
    shade, alpha = SHADES[border.side], opacity(border)
    outline = np.concatenate([image.seen(left), image.seen(right)[::-1]])
    outline = outline[np.isfinite(outline).all(axis=1)]
    ax.fill(*outline.T, color=shade, alpha=BAND * alpha, linewidth=0.0)
    ax.plot(*image.seen(middle).T, color=shade, alpha=alpha, linestyle=line_style(border))
    for mark in MARKS:
        _write_distance(ax, image, middle, mark, shade)


def _write_distance(ax, image, line, distance, shade):
    """Labels where the line first reaches a distance ahead (m)."""
    beyond = np.flatnonzero((line[:-1, 0] < distance) & (line[1:, 0] >= distance))
    if len(beyond):
        position = image.seen(line[beyond[:1]])[0]
        ax.plot(*position, "o", color=shade, markersize=2.5)
        ax.annotate(f"{distance:g} m", position, xytext=(2, 2), textcoords="offset points", fontsize=6,
                    color=shade, annotation_clip=True)  # fmt: skip


def _finely(line):
    """Returns the line (n x 2) with points at most STEP apart."""
    lengths = np.hypot(*np.diff(line, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    positions = np.linspace(0.0, along[-1], max(2, int(np.ceil(along[-1] / STEP)) + 1))
    return np.column_stack([np.interp(positions, along, line[:, i]) for i in (0, 1)])


def _camera_image(path, image, info, mounts):
    if image.encoding not in CHANNELS:
        raise InputError(
            f"{path}: an image is {image.encoding}, expected one of {', '.join(CHANNELS)}"
        )
    if not info.P[0] > 0.0:
        raise InputError(f"{path}: camera_info has P[0] = {info.P[0]:g}, expected the focal length")
    channels = CHANNELS[image.encoding]
    rows = np.frombuffer(image.data, dtype=np.uint8).reshape(image.height, image.step)
    pixels = rows[:, : image.width * len(channels)].reshape(image.height, image.width, -1)
    mount = mount_of(path, mounts, info.header.frame_id)
    return CameraImage(
        image.header.stamp.to_nsec(),
        pixels[:, :, channels] if len(channels) > 1 else pixels[:, :, 0],
        transforms.inverse(mount),
        np.array(info.P).reshape(3, 4),
    )
