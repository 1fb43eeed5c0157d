# SPDX-License-Identifier: BSD-3-Clause
"""The gray stereo images of a KITTI raw drive, rectified if they are not published so."""

import numpy as np

from datmo_tools.convert import kitti_messages
from datmo_tools.convert.kitti_calibration import read_raw_cameras
from datmo_tools.convert.kitti_raw import image_library
from datmo_tools.errors import InputError

SIDES = ("left", "right")


class ImagePairs:
    """Images and calibrations of both gray cameras, as messages."""

    def __init__(self, drive, calibration_folder, calibration):
        """drive: Drive; calibration: contents of the folder. Raises InputError without images."""
        self._drive = drive
        self._cameras = (calibration.left, calibration.right)
        if drive.synced:
            self._stamps = [drive.image_stamps(camera) for camera in range(len(SIDES))]
            return
        self._streams = [drive.images(camera) for camera in range(len(SIDES))]
        self._stamps = [stream.stamps for stream in self._streams]
        self._raw_cameras = read_raw_cameras(calibration_folder)
        self._maps = [
            _rectification(raw, camera) for raw, camera in zip(self._raw_cameras, self._cameras)
        ]

    def events(self, frames):
        """Returns a list of (stamp, index, write) for frames (a range); write: see kitti_bag."""
        indices = list(frames) if self._drive.synced else self._paired(frames)
        return [
            (self._stamps[camera][index], index, self._writer(camera))
            for camera in range(len(SIDES))
            for index in indices
        ]

    def _paired(self, frames):
        """Returns the numbers of the images that both cameras took during the frames' scans."""
        begin, end = (self._drive.scan_stamps[frames[index]] for index in (0, -1))
        numbers = range(min(len(stream) for stream in self._streams))
        paired = [
            number
            for number in numbers
            if begin <= self._stamps[0][number] <= end
            and all(stream.has(number) for stream in self._streams)
        ]
        if not paired:
            raise InputError(
                f"{self._drive.folder}: no image of both cameras at the time of the scans"
            )
        return paired

    def _writer(self, camera):
        topic, parameters = f"/stereo/{SIDES[camera]}", self._cameras[camera]

        def write(bag, stamp, index):
            pixels = self._pixels(camera, index)
            bag.write(f"{topic}/image_rect", stamp, kitti_messages.gray_image(stamp, pixels))
            bag.write(f"{topic}/camera_info", stamp, kitti_messages.camera_info(stamp, parameters))

        return write

    def _pixels(self, camera, index):
        if self._drive.synced:
            parameters = self._cameras[camera]
            return self._drive.image(camera, index, parameters.width, parameters.height)
        raw = self._raw_cameras[camera]
        pixels = self._drive.image(camera, index, raw.width, raw.height)
        cv2 = image_library()
        return cv2.remap(pixels, *self._maps[camera], cv2.INTER_LINEAR)


def _rectification(raw, camera):
    """Returns maps for cv2.remap from a RawCamera's images to those of the rectified Camera."""
    cv2 = image_library()
    return cv2.initUndistortRectifyMap(
        raw.matrix,
        raw.distortion,
        raw.rotation,
        np.ascontiguousarray(camera.projection[:, :3]),
        (camera.width, camera.height),
        cv2.CV_32FC1,
    )
