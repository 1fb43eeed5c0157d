# SPDX-License-Identifier: BSD-3-Clause
"""Progress on standard error: a bar on a terminal, a few lines in a log file."""

import sys

BAR_WIDTH = 40
LINES_IN_A_LOG = 4


class Progress:
    """Shows how many of `total` steps are done.

    label: what is being done; stream: where to write, standard error by default.
    """

    def __init__(self, total, label, stream=None):
        self._total = max(int(total), 1)
        self._label = label
        self._stream = stream if stream is not None else sys.stderr
        self._is_terminal = self._stream.isatty()
        self._shown = -1

    def __enter__(self):
        return self

    def __exit__(self, *_):
        """Leaves a bar that did not come to its end on a line of its own."""
        if self._is_terminal and 0 <= self._shown < BAR_WIDTH:
            self._stream.write("\n")

    def update(self, done):
        """Shows `done` steps (0 to total), unless the same text stands there already."""
        steps = BAR_WIDTH if self._is_terminal else LINES_IN_A_LOG
        mark = steps * min(done, self._total) // self._total
        if mark == self._shown:
            return
        self._shown = mark
        percent = 100 * mark // steps
        if self._is_terminal:
            bar = "#" * mark + "." * (BAR_WIDTH - mark)
            end = "\n" if done >= self._total else ""
            self._stream.write(f"\r{self._label} [{bar}] {percent:3d} %{end}")
        else:
            self._stream.write(f"{self._label}: {percent} %\n")
        self._stream.flush()
