# SPDX-License-Identifier: BSD-3-Clause
"""Findings of check_bag: how severe each is, what it is, and what to do about it."""

import enum
from typing import NamedTuple


class Severity(enum.IntEnum):
    """How much a finding matters."""

    NOTE = 0  # worth knowing; the stack handles it
    WARNING = 1  # the result gets worse
    ERROR = 2  # the stack cannot work with it, or its result is wrong


class Finding(NamedTuple):
    """One finding."""

    severity: Severity
    kind: str  # an identifier for programs, e.g. `stamp_gap`
    where: str  # topic, frame, or "" for the whole recording
    what: str  # what was found, with values and what was expected
    advice: str  # what to do; "" if there is nothing to do


class Findings:
    """Collects findings; at most one of each kind for each topic or frame."""

    def __init__(self):
        self._items = {}

    def error(self, kind, where, what, advice=""):
        """Adds an error."""
        self._add(Finding(Severity.ERROR, kind, where, what, advice))

    def warn(self, kind, where, what, advice=""):
        """Adds a warning."""
        self._add(Finding(Severity.WARNING, kind, where, what, advice))

    def note(self, kind, where, what, advice=""):
        """Adds a note."""
        self._add(Finding(Severity.NOTE, kind, where, what, advice))

    def _add(self, finding):
        self._items.setdefault((finding.kind, finding.where), finding)

    def sorted(self):
        """Returns all of them, the most severe first, otherwise in the order they were found."""
        return sorted(self._items.values(), key=lambda finding: -finding.severity)

    def worst(self):
        """Returns the severity of the worst one; None if there is none."""
        return max((finding.severity for finding in self._items.values()), default=None)

    def kinds(self):
        """Returns the set of the kinds that were found."""
        return {finding.kind for finding in self._items.values()}
