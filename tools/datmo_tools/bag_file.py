# SPDX-License-Identifier: BSD-3-Clause
"""A bag that is either whole or not there."""

import contextlib
import os

import rosbag

from datmo_tools.errors import InputError
from datmo_tools.stamps import to_ros_time

# The mounts stand in a bag this much before the first measurement, so that no reader meets a scan
# first.
MOUNTS_LEAD = 1_000_000  # ns


class BagFile:
    """Writes messages to an open rosbag.Bag, each recorded at the stamp given with it."""

    def __init__(self, bag, writer):
        """writer: name of the tool that writes."""
        self._bag = bag
        self._writer = writer

    def write(self, topic, stamp, message):
        """Writes `message` at `stamp` (ns)."""
        self._bag.write(topic, message, to_ros_time(stamp))

    def write_latched(self, topic, stamp, message):
        """As write, and marks the topic's connection as latched, so that rosbag play latches it."""
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
        """Writes a raw message as it was read from another bag, with its connection's header."""
        header = message.connection_header
        self._bag.write(
            message.topic, message.message, message.timestamp, raw=True, connection_header=header
        )


@contextlib.contextmanager
def whole_bag(path, writer):
    """Context of a BagFile that is named `path` (Path) when all went well, and gone otherwise.

    writer: name of the tool. Raises InputError where the file cannot be written.
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
