# SPDX-License-Identifier: BSD-3-Clause
"""Images of a camera from a folder or a video file, and its calibration from a yaml file as written
by camera_calibration."""

from pathlib import Path

import cv2
import numpy as np

from datmo_tools.errors import InputError
from datmo_tools.yaml_files import load_yaml

IMAGE_FILES = {".bmp", ".jpeg", ".jpg", ".pgm", ".png", ".ppm", ".tif", ".tiff"}
RECTIFIED_MODELS = ("plumb_bob", "rational_polynomial")
DISTORTION_COUNTS = (0, 4, 5, 8)
MATRICES = {"camera_matrix": 9, "rectification_matrix": 9, "projection_matrix": 12}


class Images:
    """Iterates once over the images: numpy arrays, gray (rows, columns) or BGR (rows, columns, 3).

    skipped: number of files in the folder that could not be read.
    """

    def __init__(self, path):
        self.path = Path(path)
        self.skipped = 0
        if self.path.is_dir():
            self._files = sorted(file for file in self.path.iterdir() if file.suffix.lower() in IMAGE_FILES)
            if not self._files:
                raise InputError(f"{path}: no image in it, expected files of {', '.join(sorted(IMAGE_FILES))}")
        elif not self.path.is_file():
            raise InputError(f"{path}: expected a folder of images or a video file")
        elif not cv2.VideoCapture(str(path)).isOpened():
            raise InputError(f"{path}: not a video that OpenCV can read, expected one or a folder of images")

    def __iter__(self):
        return self._from_folder() if self.path.is_dir() else self._from_video()

    def _from_folder(self):
        for file in self._files:
            image = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
            if image is None or image.dtype != np.uint8 or image.ndim == 3 and image.shape[2] not in (3, 4):
                self.skipped += 1
                yield None
            else:
                yield image[:, :, :3] if image.ndim == 3 else image

    def _from_video(self):
        video = cv2.VideoCapture(str(self.path))
        while True:
            is_there, image = video.read()
            if not is_there:
                return
            yield image


def _numbers(tree, key, count, file):
    """Returns the numbers of {rows: ..., cols: ..., data: [...]}; count None: any number."""
    data = tree.get(key, {}).get("data") if isinstance(tree.get(key), dict) else None
    good = isinstance(data, list) and all(isinstance(value, (int, float)) for value in data)
    if not good or count not in (None, len(data)):
        raise InputError(f"{file}: {key}: expected data with {count or 'some'} numbers, as camera_calibration "
                         "writes it")
    return [float(value) for value in data]


def read_calibration(file):
    """Returns the fields of a sensor_msgs/CameraInfo (dict) from a yaml file. Raises InputError."""
    tree = load_yaml(file)
    if not isinstance(tree, dict):
        raise InputError(f"{file}: expected a calibration: image_width, camera_matrix and others")
    size = [tree.get("image_width"), tree.get("image_height")]
    if not all(isinstance(value, int) and value > 0 for value in size):
        raise InputError(f"{file}: image_width, image_height = {size}: expected whole numbers above 0")
    matrices = {key: _numbers(tree, key, count, file) for key, count in MATRICES.items()}
    return {"width": size[0], "height": size[1],
            "distortion_model": str(tree.get("distortion_model", "plumb_bob")),
            "D": _numbers(tree, "distortion_coefficients", None, file),
            "K": matrices["camera_matrix"], "R": matrices["rectification_matrix"],
            "P": matrices["projection_matrix"]}


class Rectifier:
    """Rectifies raw images, as image_proc does."""

    def __init__(self, calibration):
        """calibration: as read_calibration() returns it. Raises InputError for an unknown distortion model."""
        if calibration["distortion_model"] not in RECTIFIED_MODELS:
            raise InputError(f"distortion_model {calibration['distortion_model']}: expected {' or '.join(RECTIFIED_MODELS)}")
        if len(calibration["D"]) not in DISTORTION_COUNTS:
            raise InputError(f"{len(calibration['D'])} distortion_coefficients: expected {', '.join(map(str, DISTORTION_COUNTS))}")
        intrinsics, projection = np.reshape(calibration["K"], (3, 3)), np.reshape(calibration["P"], (3, 4))
        self._maps = cv2.initUndistortRectifyMap(
            intrinsics, np.array(calibration["D"]), np.reshape(calibration["R"], (3, 3)), projection[:, :3],
            (calibration["width"], calibration["height"]), cv2.CV_16SC2)

    def rectified(self, image):
        """Returns the image; pixels from outside the raw image are black."""
        return cv2.remap(image, *self._maps, cv2.INTER_LINEAR)


def check_size(image, calibration, file):
    """Raises InputError unless the image has the calibration's size."""
    size, expected = image.shape[1::-1], (calibration["width"], calibration["height"])
    if size != expected:
        raise InputError(f"{file}: images of {size[0]} x {size[1]}: expected {expected[0]} x {expected[1]}, "
                         "as their calibration says")
