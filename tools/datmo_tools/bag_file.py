# SPDX-License-Identifier: BSD-3-Clause
"""Writes bags that either are complete or do not exist."""

import contextlib
import os

import rosbag

from datmo_tools.errors import InputError
from datmo_tools.stamps import to_ros_time

# The mounts are recorded this long before the first measurement, so that no reader receives a scan
# before them.
MOUNTS_LEAD = 1_000_000  # ns


class BagFile:
    """Writes messages to an open rosbag.Bag, each recorded at its given stamp."""

    def __init__(self, bag, writer):
        """writer: name of the tool that writes."""
        self._bag = bag
        self._writer = writer

    def write(self, topic, stamp, message):
        """Writes `message` at `stamp` (ns)."""
        self._bag.write(topic, message, to_ros_time(stamp))

    def write_latched(self, topic, stamp, message):
        """Like write(), but marks the connection as latched, so that rosbag play latches it."""
        self._bag.write(
            topic,
            message,
            to_ros_time(stamp),
            connection_header={
                "topic": topic,
                "type": message._type,  # pylint: disable=protected-access
                "md5sum": message._md5sum,  # pylint: disable=protected-access
                "message_definition": message._full_text,  # pylint: disable=protected-access
                "callerid": f"/{self._writer}",
                "latching": "1",
            },
        )

    def copy(self, message):
        """Writes a raw message as read from another bag, with its connection's header."""
        header = message.connection_header
        self._bag.write(
            message.topic, message.message, message.timestamp, raw=True, connection_header=header
        )


@contextlib.contextmanager
def whole_bag(path, writer):
    """Context manager of a BagFile that is named `path` (Path) on success, and deleted otherwise.

    writer: name of the tool. Raises InputError if the file cannot be written.
    """
    if path.is_dir():
        raise InputError(f"{path}: is a folder, expected the name of a bag")
    part = path.with_name(path.name + ".part")
    try:
        with rosbag.Bag(str(part), "w") as bag:
            yield BagFile(bag, writer)
        os.replace(part, path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error})") from error
    finally:
        with contextlib.suppress(FileNotFoundError, NotADirectoryError):
            part.unlink()
