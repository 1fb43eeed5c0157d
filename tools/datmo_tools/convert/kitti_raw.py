# SPDX-License-Identifier: BSD-3-Clause
"""Reads and checks the frames of a KITTI raw drive folder, in both published forms.

`..._sync` is synchronized and rectified: line and file i of every sensor are one frame, clouds are
binary. `..._extract` is neither: each sensor has its own rate (the GPS/IMU 100 Hz), clouds are text.
Source: Geiger et al., "Vision meets robotics: the KITTI dataset", 2013, and its devkit's readme; the
oxts fields are described in the drive's own oxts/dataformat.txt.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools.convert.kitti_streams import Stream, read_text
from datmo_tools.errors import InputError
from datmo_tools.stamps import NANOSECONDS

OXTS_FIELDS = 30
CLOUD_FIELDS = 4  # x, y, z, reflectance
NOMINAL_TURN = NANOSECONDS // 10  # of the Velodyne, if a single scan does not tell it

# GPS/IMU records that may be lost, or stamped no later than the previous one, as in some of the
# unsynchronized drives: the pose between them is interpolated.
MAX_MISSING_MOTION = 0.1  # share

# For an unsynchronized drive, records count from this long before the first scan to this long after
# the last one: then there is one on both sides of each.
MOTION_MARGIN = NANOSECONDS // 20


class Oxts(NamedTuple):
    """One record of the GPS/IMU: position, heading (0 = east, to the left), speeds, yaw rate."""

    latitude: float  # degrees
    longitude: float  # degrees
    yaw: float  # rad
    forward_speed: float  # m/s
    leftward_speed: float  # m/s
    yaw_rate: float  # rad/s, about the upward axis


class Drive:
    """Frames of one drive. Every reader raises InputError with the file and what was expected."""

    def __init__(self, folder):
        """folder: pathlib.Path of the drive."""
        self.folder = folder
        _check_folder(folder)
        self._oxts = Stream(folder / "oxts", [".txt"], MAX_MISSING_MOTION)
        self._scans = Stream(folder / "velodyne_points", [".bin", ".txt"])
        self.synced = self._scans.suffix == ".bin" and not folder.name.endswith("_extract")
        if self.synced and len(self._oxts) < self.frames:
            raise InputError(
                f"{folder / 'oxts' / 'timestamps.txt'}: {len(self._oxts)} stamps, "
                f"expected {self.frames}, as the Velodyne has"
            )

    @property
    def frames(self):
        """Returns how many frames the drive has: one for each line of the Velodyne's stamps."""
        return len(self._scans)

    @property
    def oxts_stamps(self):
        """Returns the stamps (ns) of the GPS/IMU records."""
        return self._oxts.stamps

    @property
    def scan_stamps(self):
        """Returns the stamps (ns) of the frames; for a lost scan, between its neighbors."""
        return self._scans.stamps

    @property
    def turn_duration(self):
        """Returns the duration (ns) of one turn of the Velodyne, from the stamps of two scans."""
        steps = np.diff(self.scan_stamps)
        return int(np.median(steps)) if len(steps) > 0 else NOMINAL_TURN

    def motion_records(self, frames):
        """Returns the numbers of the GPS/IMU records of frames (a range), without lost ones."""
        if self.synced:
            wanted = list(frames)
        else:
            begin = self.scan_stamps[frames[0]] - MOTION_MARGIN
            end = self.scan_stamps[frames[-1]] + MOTION_MARGIN
            stamps = enumerate(self.oxts_stamps)
            wanted = [index for index, stamp in stamps if begin <= stamp <= end]
        found = [index for index in wanted if self._oxts.has(index)]
        if len(found) < (1.0 - MAX_MISSING_MOTION) * len(wanted) or not found:
            raise InputError(
                f"{self.folder / 'oxts'}: {len(found)} records with stamp and file, expected "
                f"{len(wanted) or 'some'} at the time of the scans"
            )
        return found

    def oxts(self, index):
        """Returns the GPS/IMU record (Oxts) of a number; in a synchronized drive, of the frame."""
        path = self._oxts.file(index)
        words = read_text(path).split()
        if len(words) < OXTS_FIELDS:
            raise InputError(f"{path}: {len(words)} fields, expected {OXTS_FIELDS}")
        try:
            values = np.array([float(word) for word in words])
        except ValueError as error:
            raise InputError(f"{path}: {error}, expected {OXTS_FIELDS} numbers") from error
        record = Oxts(*values[[0, 1, 5, 8, 9, 22]])
        if not np.all(np.isfinite(record)):
            raise InputError(
                f"{path}: not a finite number among latitude, longitude, yaw, vf, vl, wu"
            )
        return record

    def cloud_file(self, frame):
        """Returns the path of the Velodyne's file of a frame."""
        return self._scans.file(frame)

    def has_cloud(self, frame):
        """Whether the frame has the Velodyne's file and stamp; drive 0009 lost four."""
        return self._scans.has(frame)

    def cloud(self, frame):
        """Returns a frame's Velodyne points: n x 4 float32 (x, y, z in m; reflectance)."""
        path = self._scans.file(frame)
        try:
            return _text_cloud(path) if self._scans.suffix == ".txt" else _binary_cloud(path)
        except OSError as error:
            raise InputError(f"{path}: expected a Velodyne scan ({error})") from error

    def images(self, camera):
        """Returns the Stream of a camera's images, 0 (left) or 1 (right). Raises InputError."""
        folder = self.folder / f"image_{camera:02d}"
        if not folder.is_dir():
            found = ", ".join(sorted(path.name for path in self.folder.glob("image_*"))) or "none"
            raise InputError(
                f"{folder}: missing, expected the gray cameras image_00 and image_01 (found: "
                f"{found}); without --images the drive is converted without images"
            )
        return Stream(folder, [".png"])

    def image_stamps(self, camera):
        """Returns the stamps (ns) of a camera's images of a synchronized drive, one per frame."""
        images = self.images(camera)
        images.check_complete()
        if len(images) < self.frames:
            raise InputError(
                f"{self.folder / f'image_{camera:02d}' / 'timestamps.txt'}: {len(images)} stamps, "
                f"expected {self.frames}, as the Velodyne has"
            )
        return images.stamps

    def image(self, camera, frame, width, height):
        """Returns the gray image (height x width, uint8) of a camera."""
        cv2 = image_library()
        path = self.folder / f"image_{camera:02d}" / "data" / f"{frame:010d}.png"
        expected = f"expected a gray PNG of {width} x {height}"
        if not path.is_file():
            raise InputError(f"{path}: missing, {expected}")
        pixels = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
        if pixels is None:
            raise InputError(f"{path}: cannot be read, {expected}")
        if pixels.shape != (height, width):
            raise InputError(f"{path}: {pixels.shape[1]} x {pixels.shape[0]}, {expected}")
        return pixels


def image_library():
    """Imports OpenCV: only needed with images, and slow to load."""
    try:
        import cv2
    except ImportError as error:
        raise InputError(
            f"images need OpenCV, expected Debian's python3-opencv ({error})"
        ) from error
    return cv2


def _check_folder(folder):
    """Raises InputError unless it is a drive's folder, with hints for common mistakes."""
    expected = "expected the folder of a KITTI raw drive (..._drive_NUMBER_sync or _extract)"
    if folder.is_file() and folder.suffix == ".zip":
        raise InputError(
            f"{folder}: {expected}; 'unzip {folder}' makes it, and the zip of the day's "
            "calibration is unpacked in the same folder"
        )
    if not folder.is_dir():
        raise InputError(f"{folder}: {expected}")
    if not (folder / "velodyne_points").is_dir():
        inside = sorted(
            path for pattern in ("*_drive_*", "*/*_drive_*") for path in folder.glob(pattern)
        )
        hint = f"; it holds {inside[0]}" if inside else ", with velodyne_points in it"
        raise InputError(f"{folder}: {expected}{hint}")


def _binary_cloud(path):
    values = np.fromfile(path, dtype="<f4")
    size = path.stat().st_size
    if size == 0 or size % 16 != 0:
        raise InputError(f"{path}: {size} bytes, expected a multiple of 16 (x, y, z, reflectance)")
    return values.reshape(-1, CLOUD_FIELDS)


def _text_cloud(path):
    try:
        values = np.array(path.read_bytes().split(), dtype=np.float32)
    except ValueError as error:
        raise InputError(f"{path}: {error}, expected lines of x, y, z, reflectance") from error
    if values.size == 0 or values.size % CLOUD_FIELDS != 0:
        raise InputError(
            f"{path}: {values.size} numbers, expected a multiple of 4 (x, y, z, reflectance)"
        )
    return values.reshape(-1, CLOUD_FIELDS)
