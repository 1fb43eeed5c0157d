# SPDX-License-Identifier: BSD-3-Clause
"""Reads the calibration files of a KITTI raw recording day: mounts and camera matrices.

Source: Geiger et al., "Vision meets robotics: the KITTI dataset", 2013, section IV and its devkit.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.errors import InputError

CAMERAS_FILE = "calib_cam_to_cam.txt"
VELODYNE_HEIGHT = 1.73  # m above the road (Geiger et al. 2013, figure 3)


class Camera(NamedTuple):
    """A rectified camera: `projection` (3 x 4, from the left one's frame) and size, in pixels."""

    projection: np.ndarray
    width: int
    height: int


class RawCamera(NamedTuple):
    """A camera before rectification, and its rectification."""

    matrix: np.ndarray  # 3 x 3, pixels
    distortion: np.ndarray  # k1, k2, p1, p2, k3
    rotation: np.ndarray  # 3 x 3, into the rectified camera
    width: int
    height: int


class Calibration(NamedTuple):
    """Mounts on the car (4 x 4, named target_from_source) and the rectified gray stereo pair."""

    base_from_velodyne: np.ndarray
    base_from_imu: np.ndarray
    left_from_velodyne: np.ndarray  # into the rectified left camera, optical axes
    left: Camera
    right: Camera

    @property
    def baseline(self):
        """Returns the distance (m) from the left to the right rectified camera, along x."""
        return -self.right.projection[0, 3] / self.right.projection[0, 0]


def find_calibration(drive):
    """Returns the folder (Path) of a drive's calibration: above the drive, as it is unpacked, or in
    it, or in its day's folder next to it. Raises InputError that lists where it was looked for.
    """
    drive = drive.resolve()
    day = drive.name[: len("2011_09_26")]
    folders = [drive.parent, drive, drive.parent / day]
    for folder in folders:
        if (folder / CAMERAS_FILE).is_file():
            return folder
    looked = ", ".join(map(str, folders))
    raise InputError(
        f"{drive}: no calibration, expected {CAMERAS_FILE} and the others of {day}_calib.zip in "
        f"{looked}, or --calibration FOLDER"
    )


def read_raw_cameras(folder):
    """Returns both gray cameras (RawCamera), left and right. Raises InputError if invalid."""
    cameras = _KeyedFile(folder / CAMERAS_FILE)
    return [_raw_camera(cameras, number) for number in ("00", "01")]


def read_calibration(folder):
    """Reads the three calib_*.txt of `folder` (Path). Raises InputError if one is invalid."""
    cameras = _KeyedFile(folder / CAMERAS_FILE)
    velodyne_from_imu = _KeyedFile(folder / "calib_imu_to_velo.txt").rigid()
    camera_from_velodyne = _KeyedFile(folder / "calib_velo_to_cam.txt").rigid()
    rectification = transforms.rigid(cameras.values("R_rect_00", 9).reshape(3, 3), np.zeros(3))
    base_from_imu = _base_from_imu(velodyne_from_imu)
    return Calibration(
        base_from_velodyne=base_from_imu @ transforms.inverse(velodyne_from_imu),
        base_from_imu=base_from_imu,
        left_from_velodyne=rectification @ camera_from_velodyne,
        left=_camera(cameras, "00"),
        right=_camera(cameras, "01"),
    )


def _base_from_imu(velodyne_from_imu):
    """Returns base_link: on the road below the IMU, VELODYNE_HEIGHT below the Velodyne."""
    velodyne_above_imu = transforms.inverse(velodyne_from_imu)[2, 3]
    return transforms.rigid(np.eye(3), [0.0, 0.0, VELODYNE_HEIGHT - velodyne_above_imu])


def _camera(cameras, number):
    width, height = cameras.values(f"S_rect_{number}", 2)
    return Camera(cameras.values(f"P_rect_{number}", 12).reshape(3, 4), int(width), int(height))


def _raw_camera(cameras, number):
    width, height = cameras.values(f"S_{number}", 2)
    return RawCamera(
        matrix=cameras.values(f"K_{number}", 9).reshape(3, 3),
        distortion=cameras.values(f"D_{number}", 5),
        rotation=cameras.values(f"R_rect_{number}", 9).reshape(3, 3),
        width=int(width),
        height=int(height),
    )


class _KeyedFile:
    """Reads a text file with lines `key: values`."""

    def __init__(self, path):
        self._path = path
        try:
            lines = path.read_text(encoding="ascii").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(
                f"{path}: expected a calibration file, a text file ({error})"
            ) from error
        self._entries = dict(line.split(":", 1) for line in lines if ":" in line)

    def values(self, key, count):
        """Returns the `count` numbers after `key`."""
        if key not in self._entries:
            raise InputError(f"{self._path}: key {key} is missing, expected {count} numbers")
        try:
            values = np.array([float(word) for word in self._entries[key].split()])
        except ValueError as error:
            raise InputError(f"{self._path}: {key}: {error}, expected {count} numbers") from error
        if values.size != count or not np.all(np.isfinite(values)):
            raise InputError(
                f"{self._path}: {key} has {values.size} numbers, expected {count}, finite"
            )
        return values

    def rigid(self):
        """Returns the transform given by the keys R and T."""
        return transforms.rigid(self.values("R", 9).reshape(3, 3), self.values("T", 3))
