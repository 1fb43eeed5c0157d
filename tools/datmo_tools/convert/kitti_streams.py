# SPDX-License-Identifier: BSD-3-Clause
"""Reads one sensor's folder of a KITTI raw drive: timestamps.txt and data/0000000000.* in order.

Source: the readme of the raw data's devkit. Where data were lost, the published files have gaps:
the line of timestamps.txt is blank and the file is missing (drive 2011_09_26_0009: four scans).
"""

import calendar
import time

import numpy as np

from datmo_tools.errors import InputError
from datmo_tools.stamps import NANOSECONDS

STAMPS = "timestamps.txt"
# The Velodyne also has these: of the first and the last point of a scan.
BOUNDS = ("timestamps_start.txt", "timestamps_end.txt")


class Stream:
    """Stamps and files of one sensor.

    stamps: ns, of every line; interpolated between its neighbors for a line without stamp.
    """

    def __init__(self, folder, suffixes, max_disorder=0.0):
        """folder: Path of the sensor; suffixes: of its data, the one with most files is used.

        max_disorder: share of the lines that may be stamped no later than an earlier one; they
        count as lost. Raises InputError: no folder, no stamp, an invalid line, stamps that do not
        increase, more files than lines.
        """
        self._data = folder / "data"
        files = {suffix: len(list(self._data.glob(f"*{suffix}"))) for suffix in suffixes}
        self.suffix = max(suffixes, key=lambda suffix: files[suffix])
        self.files = files[self.suffix]
        path, stamps = _read_lines(folder)
        stamps = _rising(path, stamps, max_disorder)
        self._stamped = [stamp is not None for stamp in stamps]
        self.stamps = _filled(stamps)
        if self.files > len(self.stamps):
            raise InputError(f"{self._data}: {self._expected()}")

    def __len__(self):
        return len(self.stamps)

    def file(self, index):
        """Returns the path of the data of a line (from 0)."""
        return self._data / f"{index:010d}{self.suffix}"

    def has(self, index):
        """Whether a line has both a stamp and a file."""
        return index < len(self) and self._stamped[index] and self.file(index).is_file()

    def check_complete(self):
        """Raises InputError if a line has no file."""
        if self.files < len(self.stamps):
            raise InputError(f"{self._data}: {self._expected()}")

    def _expected(self):
        return (
            f"{self.files} files {self.suffix}, expected {len(self.stamps)}, one for each line of "
            f"{STAMPS}"
        )


def read_text(path):
    """Returns the text of a file (Path). Raises InputError that names it."""
    try:
        return path.read_text(encoding="ascii")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: expected a text file ({error})") from error


def _read_lines(folder):
    """Returns the stamps' file, and its stamps (ns); None: a blank line before the last stamp."""
    path = folder / STAMPS
    if path.exists() or not all((folder / name).exists() for name in BOUNDS):
        return path, _stamps_in(path)
    begins, ends = (_stamps_in(folder / name) for name in BOUNDS)
    if len(begins) != len(ends):
        raise InputError(f"{folder / BOUNDS[1]}: {len(ends)} stamps, expected {len(begins)}")
    pairs = zip(begins, ends)
    return path, [None if None in (begin, end) else (begin + end) // 2 for begin, end in pairs]


def _stamps_in(path):
    lines = read_text(path).rstrip().splitlines()
    if not lines:
        raise InputError(f"{path}: empty, expected one stamp for each frame")
    return [_parse_stamp(path, number, line) for number, line in enumerate(lines, 1)]


def _rising(path, stamps, max_disorder):
    """Replaces stamps that do not increase by None. Raises InputError if there are too many."""
    kept, latest = [], -1
    for stamp in stamps:
        rises = stamp is not None and stamp > latest
        kept.append(stamp if rises else None)
        latest = stamp if rises else latest
    disorder = kept.count(None) - stamps.count(None)
    if disorder > max_disorder * len(stamps):
        raise InputError(f"{path}: stamps do not increase, expected the order of the frames")
    return kept


def _filled(stamps):
    """Fills gaps in stamps (ns)."""
    known = [index for index, stamp in enumerate(stamps) if stamp is not None]
    values = np.array([stamps[index] for index in known], dtype=np.int64)
    # Relative to the first one, as a float64 cannot hold ns since 1970.
    between = np.interp(np.arange(len(stamps)), known, values - values[0])
    filled = (values[0] + np.rint(between).astype(np.int64)).tolist()
    return [guess if stamp is None else stamp for stamp, guess in zip(stamps, filled)]


def _parse_stamp(path, number, line):
    """Converts `2011-09-26 13:04:32.349659964` (taken as UTC) to ns since 1970; blank to None."""
    if not line.strip():
        return None
    try:
        seconds, _, fraction = line.strip().partition(".")
        parsed = time.strptime(seconds, "%Y-%m-%d %H:%M:%S")
        return calendar.timegm(parsed) * NANOSECONDS + int(fraction.ljust(9, "0")[:9] or 0)
    except ValueError as error:
        raise InputError(
            f"{path}:{number}: '{line}', expected YYYY-MM-DD HH:MM:SS.fraction"
        ) from error
