# SPDX-License-Identifier: BSD-3-Clause
"""Reads single messages of a long bag: those whose stamps are nearest to given stamps.

Only these are deserialized, which is what takes long in Python.
"""

import bisect
import struct

from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError

_HEADER = struct.Struct("<III")  # the begin of a message with a header: sequence number, s, ns


def topics_of(path):
    """Returns a dictionary topic -> message type of the bag at `path` (Path). Raises InputError."""
    with opened(path) as bag:
        topics = bag.get_type_and_topic_info().topics
    return {topic: info.msg_type for topic, info in topics.items()}


def check_kinds(path, topics, kinds):
    """Raises InputError if a topic has another type than expected.

    topics: of topics_of(); kinds: dictionary topic -> type of message.
    """
    for topic, kind in kinds.items():
        if topics.get(topic, kind) != kind:
            raise InputError(f"{path}: {topic} is {topics[topic]}, expected {kind}")


def stamps_of(path, topic):
    """Returns the increasing stamps (ns) of the messages on a topic, each once."""
    with opened(path) as bag:
        return sorted({_stamp(raw[1]) for _, raw, _ in bag.read_messages([topic], raw=True)})


def nearest_messages(path, topics, stamps, tolerance=0):
    """Returns a dictionary topic -> {stamp of `stamps`: the nearest message on it}.

    topics: of messages with a header; stamps: increasing, ns; tolerance: ns, a stamp without a
    message this near is left out. Of equally near messages the last one in the bag counts.
    """
    found = {topic: {} for topic in topics}
    with opened(path) as bag:
        for topic, raw, _ in bag.read_messages(list(topics), raw=True):
            late = _stamp(raw[1])
            first = bisect.bisect_left(stamps, late - tolerance)
            for stamp in stamps[first : bisect.bisect_right(stamps, late + tolerance)]:
                distance = abs(stamp - late)
                if distance <= found[topic].get(stamp, (distance,))[0]:
                    found[topic][stamp] = (distance, raw)
    return {
        topic: {stamp: _message(raw) for stamp, (_, raw) in items.items()}
        for topic, items in found.items()
    }


def _stamp(data):
    _, seconds, nanoseconds = _HEADER.unpack_from(data)
    return seconds * 10**9 + nanoseconds


def _message(raw):
    """raw: type's name, bytes, MD5 sum, position in the bag, class."""
    return raw[4]().deserialize(raw[1])
