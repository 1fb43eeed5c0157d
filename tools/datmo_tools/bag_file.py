"""A bag that is either whole or not there."""

import contextlib
import os

import rosbag

from datmo_tools.stamps import to_ros_time


class BagFile:
    """Writes messages to an open rosbag.Bag, each recorded at the stamp given with it."""

    def __init__(self, bag):
        self._bag = bag

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
                "callerid": "/kitti_to_bag",
                "latching": "1",
            },
        )


@contextlib.contextmanager
def whole_bag(path):
    """Context of a BagFile that is named `path` (Path) when all went well, and gone otherwise."""
    part = path.with_name(path.name + ".part")
    try:
        with rosbag.Bag(str(part), "w") as bag:
            yield BagFile(bag)
        os.replace(part, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            part.unlink()
        raise
