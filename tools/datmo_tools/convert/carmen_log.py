# SPDX-License-Identifier: BSD-3-Clause
"""Reads a CARMEN log file: its records in the order of the file, and what was not used of it."""

import bz2
import gzip
import zlib
from collections import Counter
from typing import NamedTuple

from datmo_tools.convert.carmen_lines import LASERS, OdometryLine, ParameterLine, parse_line, shown
from datmo_tools.errors import InputError

OPENERS = {".bz2": bz2.open, ".gz": gzip.open}

# Stamps of neighboring lines may be out of order by this much, as messages waited for the logger; a
# clock that jumps back further was set, or the file contains two recordings.
MAX_DISORDER = 10.0  # s


class Record(NamedTuple):
    """A line of the log."""

    number: int  # of the line, starting at 1
    line: object  # LaserLine or OdometryLine


class CarmenLog(NamedTuple):
    """The contents of a log that a conversion needs."""

    records: list  # Record of the chosen laser and of the odometry, in the order of the file
    laser: str  # kind of the chosen laser's lines
    parameters: dict  # name -> value, as text
    skipped: dict  # kind of line -> how many were not used
    malformed: list  # messages, one for each line that was skipped


def read_log(path, laser=None, skip_malformed=False):
    """Reads the file at `path` (Path; .bz2 and .gz are unpacked) into a CarmenLog.

    laser: kind of the laser's lines; None: the first of LASERS in the log. Raises InputError with
    file and line: an unreadable file, a broken line or one of an unknown kind (skipped with
    `skip_malformed`), a clock that was set back, no scan.
    """
    lines = _Lines(path, skip_malformed)
    chosen = laser or next((kind for kind in LASERS if kind in lines.records), None)
    if chosen not in lines.records:
        kinds = _names({*lines.records, *lines.unknown}) or "nothing"
        raise InputError(f"{path}: no line of {laser or ' or '.join(LASERS)}; it holds {kinds}")
    used = {chosen, "ODOM"}
    for kind in used & set(lines.records):
        _check_order(path, kind, lines.records[kind])
    records = sorted(record for kind in used for record in lines.records.get(kind, []))
    skipped = lines.unknown + Counter(
        {kind: len(found) for kind, found in lines.records.items() if kind not in used}
    )
    return CarmenLog(records, chosen, lines.parameters, dict(skipped), lines.malformed)


class _Lines:
    """Collects all lines of a file, by kind."""

    def __init__(self, path, skip_malformed):
        self.records = {}  # kind -> list of Record
        self.parameters = {}
        self.unknown = Counter()
        self.malformed = []
        self._skip_malformed = skip_malformed
        try:
            with OPENERS.get(path.suffix, open)(path, "rt", encoding="latin-1") as stream:
                for number, text in enumerate(stream, 1):
                    self._take(f"{path}:{number}", number, text.split())
        except (OSError, EOFError, zlib.error) as error:
            raise InputError(f"{path}: expected a CARMEN log ({error})") from error

    def _take(self, where, number, words):
        if not words or words[0].startswith("#"):
            return
        try:
            line = parse_line(words)
        except ValueError as error:
            self._refuse(f"{where}: {error}")
            return
        if line is None:
            self.unknown[words[0]] += 1
        elif isinstance(line, ParameterLine):
            self.parameters[line.name] = line.value
        else:
            self.records.setdefault(words[0], []).append(Record(number, line))

    def _refuse(self, message):
        if not self._skip_malformed:
            raise InputError(f"{message} (--skip-malformed skips such lines)")
        self.malformed.append(message)


def scans_of(log):
    """Returns the records of the log's scans."""
    return [record for record in log.records if not isinstance(record.line, OdometryLine)]


def out_of_order(records):
    """Returns records that are stamped no later than the previous one."""
    return [b for a, b in zip(records, records[1:]) if b.line.stamp <= a.line.stamp]


def _names(kinds):
    """Formats kinds of lines for a message."""
    return ", ".join(shown(kind) for kind in sorted(kinds))


def _check_order(path, kind, records):
    latest = records[0].line.stamp
    for record in records:
        back = (latest - record.line.stamp) * 1e-9
        if back > MAX_DISORDER:
            raise InputError(
                f"{path}:{record.number}: {kind} is stamped {back:.3f} s before an earlier line, "
                f"expected increasing stamps (out of order by at most {MAX_DISORDER:g} s)"
            )
        latest = max(latest, record.line.stamp)
