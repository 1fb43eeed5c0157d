"""A KITTI raw drive folder (`2011_09_26_drive_0005_sync`) -> its frames, checked while read.

Source: Geiger et al., "Vision meets robotics: the KITTI dataset", 2013; the oxts fields stand in
the drive's own oxts/dataformat.txt.
"""

import calendar
import time
from typing import NamedTuple

import numpy as np

from datmo_tools.errors import InputError
from datmo_tools.stamps import NANOSECONDS

OXTS_FIELDS = 30
NOMINAL_TURN = NANOSECONDS // 10  # of the Velodyne, where a single scan does not tell it


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
        """folder: pathlib.Path of the drive; the calib_*.txt are in its parent."""
        self.folder = folder
        if not folder.is_dir():
            raise InputError(
                f"{folder}: expected the folder of a KITTI raw drive (..._drive_NUMBER_sync)"
            )
        self.oxts_stamps = self._stamps("oxts", ".txt")
        self.scan_stamps = self._stamps("velodyne_points", ".bin", gaps_allowed=True)

    @property
    def frames(self):
        """How many frames the drive has."""
        return len(self.scan_stamps)

    @property
    def turn_duration(self):
        """Duration (ns) of one turn of the Velodyne: from one scan's stamp to the next one's."""
        steps = np.diff(self.scan_stamps)
        return int(np.median(steps)) if len(steps) > 0 else NOMINAL_TURN

    def oxts(self, frame):
        """The GPS/IMU record (Oxts) of a frame."""
        path = self._file("oxts", frame, ".txt")
        words = _read_text(path).split()
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

    def has_cloud(self, frame):
        """False where the Velodyne's file is missing, as KITTI lost a few (drive 0009: four)."""
        return self._file("velodyne_points", frame, ".bin").is_file()

    def cloud(self, frame):
        """Velodyne points of a frame: n x 4 float32 (x, y, z in m, its frame; reflectance)."""
        path = self._file("velodyne_points", frame, ".bin")
        try:
            values = np.fromfile(path, dtype="<f4")
            size = path.stat().st_size
        except OSError as error:
            raise InputError(f"{path}: expected a Velodyne scan ({error})") from error
        if size == 0 or size % 16 != 0:
            raise InputError(
                f"{path}: {size} bytes, expected a multiple of 16 (x, y, z, reflectance)"
            )
        return values.reshape(-1, 4)

    def image_stamps(self, camera):
        """Stamps (ns) of the images of a camera, 0 (left) or 1 (right)."""
        return self._stamps(f"image_{camera:02d}", ".png", length=self.frames)

    def image(self, camera, frame, width, height):
        """Gray image (height x width, uint8) of a camera."""
        cv2 = _image_library()
        path = self._file(f"image_{camera:02d}", frame, ".png")
        expected = f"expected a gray PNG of {width} x {height}"
        if not path.is_file():
            raise InputError(f"{path}: missing, {expected}")
        pixels = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
        if pixels is None:
            raise InputError(f"{path}: cannot be read, {expected}")
        if pixels.shape != (height, width):
            raise InputError(f"{path}: {pixels.shape[1]} x {pixels.shape[0]}, {expected}")
        return pixels

    def _file(self, kind, frame, suffix):
        return self.folder / kind / "data" / f"{frame:010d}{suffix}"

    def _stamps(self, kind, suffix, length=None, gaps_allowed=False):
        """Checked timestamps.txt of `kind`, in ns: rising, one for each data file."""
        path = self.folder / kind / "timestamps.txt"
        stamps = [
            _parse_stamp(path, number, line)
            for number, line in enumerate(_read_text(path).splitlines(), 1)
            if line.strip()
        ]
        if not stamps:
            raise InputError(f"{path}: empty, expected one stamp for each frame")
        if any(b <= a for a, b in zip(stamps, stamps[1:])):
            raise InputError(
                f"{path}: stamps do not rise, expected them in the order of the frames"
            )
        files = len(list((self.folder / kind / "data").glob(f"*{suffix}")))
        if files > len(stamps) or (files < len(stamps) and not gaps_allowed):
            raise InputError(
                f"{path.parent / 'data'}: {files} files {suffix}, expected {len(stamps)}, "
                "one for each line of timestamps.txt"
            )
        if length is not None and length != len(stamps):
            raise InputError(
                f"{path}: {len(stamps)} stamps, expected {length}, as the Velodyne has"
            )
        return stamps


def _image_library():
    """OpenCV: only needed with images, and slow to load."""
    try:
        import cv2
    except ImportError as error:
        raise InputError(
            f"images need OpenCV, expected Debian's python3-opencv ({error})"
        ) from error
    return cv2


def _read_text(path):
    try:
        return path.read_text(encoding="ascii")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: expected a text file ({error})") from error


def _parse_stamp(path, number, line):
    """`2011-09-26 13:04:32.349659964` (taken as UTC) -> ns since 1970, exactly."""
    try:
        seconds, _, fraction = line.strip().partition(".")
        parsed = time.strptime(seconds, "%Y-%m-%d %H:%M:%S")
        return calendar.timegm(parsed) * NANOSECONDS + int(fraction.ljust(9, "0")[:9] or 0)
    except ValueError as error:
        raise InputError(
            f"{path}:{number}: '{line}', expected YYYY-MM-DD HH:MM:SS.fraction"
        ) from error
