# SPDX-License-Identifier: BSD-3-Clause
"""Parses one line of a CARMEN log into the record it holds.

Source: the format described by CARMEN's logger in the head of its files and in its manual: a line's
kind, its fields, and then the time at which the message was sent (ipc time, s), the host, and the
logger's own time. Lengths in m, angles in rad.
"""

import math
import re
from typing import NamedTuple

import numpy as np

from datmo_tools.stamps import parse_seconds

OLD_LASERS = ("FLASER", "RLASER")  # ranges and poses
NEW_LASERS = ("ROBOTLASER1", "ROBOTLASER2")  # also the scanner's angles and limits
LASERS = OLD_LASERS + NEW_LASERS
# Other kinds of lines that CARMEN's loggers write, which are not used here.
OTHER_KINDS = re.compile(
    r"SYNC|TRUEPOS|POSITION|SCANMARK|MARKER|SONAR|BUMPER|IMU|ARM|WIFI|VISUAL|CELLSIZE|CAMERA\w*"
    r"|GPS\w*|NMEA[-\w]*|[A-Z]*LASER\d*|BASE\w*|ROBOT\w*|NAVIGATOR\w*|MOTION\w*"
)
# ROBOTLASER lines of CARMEN's first releases have neither remissions nor the turn axis: the
# readings are followed by two poses, two speeds, two safety distances, ipc time, host and the
# logger's time.
OLD_FORM_FIELDS = 13
MAX_READINGS = 100_000  # more is a broken line, not a scanner
# Number of letters of an unknown kind that an error message quotes.
MAX_LETTERS = 30
MAX_FIELD_OF_VIEW = 2.0 * math.pi + 1e-3  # rad: a full turn, however it was rounded


class LaserLine(NamedTuple):
    """A scan with the poses that CARMEN logged with it."""

    stamp: int  # ns
    ranges: np.ndarray  # m, from right to left; +inf if the log has it
    first_bearing: float  # rad in the scanner's frame; NaN: not in the line
    step: float  # rad between beams; NaN: not in the line
    range_max: float  # m, +inf: not in the line
    laser_pose: np.ndarray  # x, y, yaw of the scanner, in the odometry's frame
    robot_pose: np.ndarray  # x, y, yaw of the robot by its odometry


class OdometryLine(NamedTuple):
    """The robot's pose by its odometry."""

    stamp: int  # ns
    pose: np.ndarray  # x, y, yaw


class ParameterLine(NamedTuple):
    """A setting of CARMEN's."""

    name: str
    value: str


def parse_line(words):
    """Returns the record of a line that is split into words; None for a kind that is not used.

    Raises ValueError with what is wrong.
    """
    kind = words[0]
    if kind in OLD_LASERS:
        return _old_laser(_Fields(words))
    if kind in NEW_LASERS:
        return _new_laser(_Fields(words))
    if kind == "ODOM":
        return _odometry(_Fields(words))
    if kind == "PARAM":
        fields = _Fields(words)
        return ParameterLine(fields.text("a name"), fields.text("a value"))
    if not OTHER_KINDS.fullmatch(kind):
        raise ValueError(f"{shown(kind)} is not a kind of line of a CARMEN log")
    return None


def shown(kind):
    """Returns the name of a kind for a message, without control characters."""
    return ascii(kind[:MAX_LETTERS])[1:-1]


class _Fields:
    """Reads the fields of a line one after another."""

    def __init__(self, words):
        self._kind = words[0]
        self._words = words[1:]
        self._at = 0

    def text(self, name):
        """Returns the next field. Like all of these, raises ValueError at the line's end."""
        return self._next(1, name)[0]

    def number(self, name):
        """Returns the next field, a finite number."""
        return float(self.numbers(1, name)[0])

    def count(self, name):
        """Returns the next field, a number of readings."""
        text = self.text(name)
        if not text.isdigit() or int(text) > MAX_READINGS:
            raise ValueError(f"{name} is '{text}', expected 0 to {MAX_READINGS}")
        return int(text)

    def numbers(self, count, name):
        """Returns the next `count` fields, all finite."""
        values = self._numbers(count, name)
        if not np.all(np.isfinite(values)):
            raise ValueError(f"{name}: {_first(values, ~np.isfinite(values))}, expected a number")
        return values

    def ranges(self, count):
        """Returns the next `count` fields: 0 or more, or +inf."""
        values = self._numbers(count, "readings")
        bad = ~(values >= 0.0)  # NaN too
        if np.any(bad):
            raise ValueError(f"a reading is {_first(values, bad)}, expected 0 m or more")
        return values

    def skip(self, count, name):
        """Skips `count` fields."""
        self._next(count, name)

    def left(self):
        """Returns how many fields have not been read yet."""
        return len(self._words) - self._at

    def stamp(self):
        """Returns the next field as a stamp (ns)."""
        return parse_seconds(self.text("the ipc time"))

    def _numbers(self, count, name):
        words = self._next(count, name)
        try:
            return np.array(words, dtype=float)
        except ValueError as error:
            raise ValueError(f"{name}: {error}, expected numbers") from error

    def _next(self, count, name):
        end = self._at + count
        if end > len(self._words):
            raise ValueError(
                f"{self._kind} with {len(self._words)} fields ends before {name}, "
                f"expected {end} or more"
            )
        taken = self._words[self._at : end]
        self._at = end
        return taken


def _first(values, where):
    return values[np.argmax(where)]


def _old_laser(fields):
    ranges = fields.ranges(fields.count("the number of readings"))
    laser, robot = fields.numbers(3, "the laser's pose"), fields.numbers(3, "the robot's pose")
    return _checked(LaserLine(fields.stamp(), ranges, math.nan, math.nan, math.inf, laser, robot))


def _new_laser(fields):
    fields.skip(1, "the laser's type")
    first_bearing = fields.number("the start angle")
    fields.skip(1, "the field of view")
    step = fields.number("the angular resolution")
    range_max = fields.number("the maximum range")
    fields.skip(2, "accuracy and remission mode")
    ranges = fields.ranges(fields.count("the number of readings"))
    is_old_form = fields.left() == OLD_FORM_FIELDS
    if not is_old_form:
        fields.skip(fields.count("the number of remissions"), "remissions")
    laser, robot = fields.numbers(3, "the laser's pose"), fields.numbers(3, "the robot's pose")
    fields.skip(4 if is_old_form else 5, "speeds and safety distances")
    if not 0.0 < step * (len(ranges) - 1) <= MAX_FIELD_OF_VIEW:
        raise ValueError(f"{len(ranges)} readings every {step} rad, expected them within one turn")
    if range_max <= 0.0:
        raise ValueError(f"the maximum range is {range_max} m, expected more than 0")
    return _checked(LaserLine(fields.stamp(), ranges, first_bearing, step, range_max, laser, robot))


def _odometry(fields):
    pose = fields.numbers(3, "the pose")
    fields.numbers(3, "speeds and acceleration")
    return OdometryLine(fields.stamp(), pose)


def _checked(line):
    if len(line.ranges) < 2:
        raise ValueError(f"{len(line.ranges)} readings, expected two or more")
    return line
