# SPDX-License-Identifier: BSD-3-Clause
"""Rectified images of a recording, and the projection of points of the vehicle's frame into them."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.evaluate.grid_recordings import MOUNTS, mount_of, mounts_of
from datmo_tools.evaluate.nearest_messages import check_kinds, nearest_messages, topics_of
from datmo_tools.stamps import NANOSECONDS

CAMERA = "/stereo/left"  # name of the topics without their last part

IMAGE, INFO = "image_rect", "camera_info"
KINDS = {IMAGE: "sensor_msgs/Image", INFO: "sensor_msgs/CameraInfo"}

# Encodings, and the indices of red, green and blue in a pixel.
CHANNELS = {"mono8": (0,), "rgb8": (0, 1, 2), "bgr8": (2, 1, 0)}

MAX_GAP = 0.2  # s, to the image
NEAREST = 1.0  # m ahead of the camera; nearer points are out of view and would not project


class Camera(NamedTuple):
    """A rectified camera on the vehicle."""

    camera_from_base: np.ndarray  # 4 x 4, into optical axes
    projection: np.ndarray  # 3 x 4

    def pixels(self, points):
        """Projects points (n x 3, m, base_link) to pixels (n x 2: right, down); NaN: not ahead."""
        seen = transforms.apply(self.camera_from_base, np.asarray(points, dtype=float))
        seen[seen[:, 2] < NEAREST] = np.nan
        rays = transforms.apply(np.vstack([self.projection, np.zeros((1, 4))]), seen)
        return rays[:, :2] / rays[:, 2:]

    def road_pixels(self, points):
        """The same for points (n x 2) on the road, the plane z = 0 of base_link."""
        return self.pixels(np.column_stack([points, np.zeros(len(points))]))


class CameraImage(NamedTuple):
    """An image with its camera."""

    stamp: int  # ns
    pixels: np.ndarray  # height x width, gray, or height x width x 3: red, green, blue
    camera: Camera


def read_images(path, camera, stamps):
    """Returns a dictionary stamp of `stamps` (increasing, ns) -> the nearest CameraImage, if near.

    path: of the bag (Path); camera: the name of its topics without their last part. Raises
    InputError if there is no rectified image, no calibration or no mount, or an image is unusable.
    """
    images, faults = read_usable_images(path, camera, stamps)
    for error in faults.values():
        raise error
    return images


def read_usable_images(path, camera, stamps):
    """Like read_images, but returns also a dictionary stamp -> InputError: the nearest image is
    unusable. A stamp without an image near it is in neither."""
    kinds = {f"{camera}/{name}": kind for name, kind in KINDS.items()}
    topics = topics_of(path)
    check_kinds(path, topics, kinds)
    for topic in kinds:
        if topic not in topics:
            raise InputError(f"{path}: nothing on {topic}, expected a bag with rectified images")
    found = nearest_messages(path, kinds, stamps, round(MAX_GAP * NANOSECONDS))
    messages, infos = (found[topic] for topic in kinds)
    with opened(path) as bag:
        mounts = mounts_of([message for _, message, _ in bag.read_messages([MOUNTS])])
    images, faults = {}, {}
    for stamp in messages.keys() & infos.keys():
        try:
            images[stamp] = _camera_image(path, messages[stamp], infos[stamp], mounts)
        except InputError as error:
            faults[stamp] = error
    return images, faults


def camera_of(path, info, mounts):
    """Returns the Camera of a CameraInfo in the bag at `path`; mounts: of mounts_of. Raises
    InputError without a focal length or a mount."""
    if not info.P[0] > 0.0:
        raise InputError(f"{path}: camera_info has P[0] = {info.P[0]:g}, expected the focal length")
    mount = mount_of(path, mounts, info.header.frame_id)
    return Camera(transforms.inverse(mount), np.array(info.P).reshape(3, 4))


def _camera_image(path, image, info, mounts):
    if image.encoding not in CHANNELS:
        raise InputError(
            f"{path}: an image is {image.encoding}, expected one of {', '.join(CHANNELS)}"
        )
    channels = CHANNELS[image.encoding]
    if image.width * len(channels) > image.step or len(image.data) != image.step * image.height:
        raise InputError(
            f"{path}: an image of {image.width} x {image.height} has {len(image.data)} bytes in rows "
            f"of {image.step}, expected {image.height} rows of {image.width * len(channels)} or more"
        )
    rows = np.frombuffer(image.data, dtype=np.uint8).reshape(image.height, image.step)
    pixels = rows[:, : image.width * len(channels)].reshape(image.height, image.width, -1)
    return CameraImage(
        image.header.stamp.to_nsec(),
        pixels[:, :, channels] if len(channels) > 1 else pixels[:, :, 0],
        camera_of(path, info, mounts),
    )
