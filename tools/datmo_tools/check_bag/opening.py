# SPDX-License-Identifier: BSD-3-Clause
"""Opens a recording, or reports why it cannot be read."""

from datmo_tools.bag_input import opened
from datmo_tools.check_bag.recording import read_recording


def open_recording(path):
    """Returns the Recording of the bag `path` (Path). Raises InputError if it cannot be read."""
    with opened(path) as bag:
        return read_recording(path, bag)
