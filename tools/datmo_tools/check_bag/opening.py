# SPDX-License-Identifier: BSD-3-Clause
"""Opens a recording, or says why it cannot be read."""

from datmo_tools.bag_input import opened
from datmo_tools.check_bag.recording import read_recording


def open_recording(path):
    """Recording of the bag `path` (Path). Raises InputError where it cannot be read."""
    with opened(path) as bag:
        return read_recording(path, bag)
