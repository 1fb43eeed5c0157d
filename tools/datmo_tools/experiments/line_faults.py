# SPDX-License-Identifier: BSD-3-Clause
"""Sensor faults in a drive that is played through the stack: how they change the messages."""

import copy
import functools
from typing import Callable, NamedTuple

import genpy

SCANS = ("/scan", "/echoes")
ODOMETRY = ("/odometry",)
TRANSFORMS = ("/tf",)
STEREO = ("/stereo/points2", "/stereo/point_velocities")
INPUTS = {"scan": SCANS, "odometry": ODOMETRY, "tf": TRANSFORMS}
STEREO_INPUTS = {**INPUTS, "stereo": STEREO}
MOUNTS = "/tf_static"
KEPT = (MOUNTS, "/ground_truth/pose", "/ground_truth/objects", "/stereo/left/camera_info", "/stereo/right/camera_info")
JUMP = 100.0  # s, longer than the drive


class Fault(NamedTuple):
    """One fault, for `seconds` from the time at which it begins."""

    name: str
    seconds: float
    # (Message, s since the fault began) -> list of Message that are recorded instead.
    apply: Callable
    jump: float = 0.0  # s, by which all stamps are later from its begin on
    whole: bool = False  # `apply` gets all messages of the drive


class Message(NamedTuple):
    """A message of a bag."""

    topic: str
    content: object
    recorded: float  # s


def faults(inputs=None):
    """Returns all faults, by input; with all inputs (default) also those of all inputs at once."""
    listed = [Fault("none", 0.0, lambda message, _: [message])]
    for name, topics in (inputs or INPUTS).items():
        listed += [
            fault._replace(name=f"{name} {fault.name}", apply=functools.partial(_on, topics, fault.apply))
            for fault in _of_one_input()
        ]
    if inputs is not None:
        return listed
    wrong = functools.partial(_on, ODOMETRY, once(_twist(yaw_rate=3.0)))
    fast = functools.partial(_on, ODOMETRY, once(_twist(speed=100.0)))
    return [
        *listed,
        Fault("odometry 3 rad/s once", 0.0, wrong),
        Fault("odometry 100 m/s once", 0.0, fast),
        Fault("mounts missing in all of the drive", 0.0, _without(MOUNTS), whole=True),
        Fault("mounts late by 1 s", 0.0, functools.partial(_on, (MOUNTS,), _late(1.0)), whole=True),
        Fault("mounts twice", 0.0, functools.partial(_on, (MOUNTS,), _again_at_begin), whole=True),
        Fault(f"all clocks back by {JUMP:g} s (a looped bag)", 0.0, _jumped(-JUMP), -JUMP, True),
        Fault(f"all clocks ahead by {JUMP:g} s", 0.0, _jumped(JUMP), JUMP, True),
    ]


def faulty(messages, fault, begin):
    """Returns the messages (list of Message), with a fault from `begin` (s) on, by record time."""
    result = []
    for message in messages:
        since = message.recorded - begin
        hit = fault.whole or (message.topic not in KEPT and 0.0 <= since <= max(fault.seconds, 1.0))
        result += fault.apply(message, since) if hit else [message]
    return sorted(result, key=lambda message: message.recorded)


def once(change):
    """Returns the same change, applied only to the first message."""
    done = []

    def apply(message, since):
        if done:
            return [message]
        done.append(since)
        return change(message, since)

    return apply


def _of_one_input():
    shift = _restamped
    return [
        Fault("silent for 3 s", 3.0, lambda message, since: []),
        Fault("at half the rate for 5 s", 5.0, _every_other()),
        Fault("late by 0.1 s for 5 s", 5.0, _late(0.1)),
        Fault("late by 0.5 s for 5 s", 5.0, _late(0.5)),
        Fault("late by 1 s for 5 s", 5.0, _late(1.0)),
        Fault("frozen for 3 s", 3.0, _frozen()),
        Fault("twice each for 5 s", 5.0, lambda message, since: [message, message]),
        Fault("clock 0.1 s ahead for 5 s", 5.0, lambda message, since: [shift(message, 0.1)]),
        Fault("clock 0.1 s behind for 5 s", 5.0, lambda message, since: [shift(message, -0.1)]),
        Fault("clock 5 s ahead for 3 s", 3.0, lambda message, since: [shift(message, 5.0)]),
        Fault("clock 5 s behind for 3 s", 3.0, lambda message, since: [shift(message, -5.0)]),
        Fault("clock 100 ppm fast for 8 s", 8.0, lambda message, since: [shift(message, 1e-4 * since)]),
        Fault("stamp 1 s ahead once", 0.0, once(lambda message, since: [shift(message, 1.0)])),
        Fault("stamp 1.5 s behind once", 0.0, once(lambda message, since: [shift(message, -1.5)])),
        Fault("stamp 1e6 s ahead once", 0.0, once(lambda message, since: [shift(message, 1e6)])),
        *(Fault(f"clock always {abs(offset):g} s {'ahead' if offset > 0.0 else 'behind'}", 0.0, _off(offset), whole=True)
          for offset in (0.1, -0.1, 1.0, -1.0)),
    ]  # fmt: skip


def _on(topics, apply, message, since):
    return apply(message, since) if message.topic in topics else [message]


def _stamped(content):
    """Returns the parts of a message that have a header."""
    return content.transforms if hasattr(content, "transforms") else [content]


def _restamped(message, offset):
    content = copy.deepcopy(message.content)
    for part in _stamped(content):
        part.header.stamp += genpy.Duration.from_sec(offset)
    return message._replace(content=content)


def _off(offset):
    return lambda message, since: [_restamped(message, offset)]


def _again_at_begin(message, since):
    """Returns a latched message, and the same again at the fault's begin: its publisher was restarted."""
    return [message, message._replace(recorded=message.recorded - since)]


def _without(topic):
    return lambda message, since: [] if message.topic == topic else [message]


def _jumped(seconds):
    """Shifts everything measured from the fault's begin on, including the truth."""
    def apply(message, since):
        return [message if since < 0.0 or message.topic == MOUNTS else _restamped(message, seconds)]

    return apply


def _late(seconds):
    return lambda message, since: [message._replace(recorded=message.recorded + seconds)]


def _every_other():
    counts = {}

    def apply(message, _):
        counts[message.topic] = counts.get(message.topic, 0) + 1
        return [message] if counts[message.topic] % 2 else []

    return apply


def _frozen():
    """Repeats the first content, with the stamps of the current messages."""
    first = {}

    def apply(message, _):
        content = copy.deepcopy(first.setdefault(message.topic, message.content))
        for part, now in zip(_stamped(content), _stamped(message.content)):
            part.header.stamp = now.header.stamp
        return [message._replace(content=content)]

    return apply


def _twist(speed=None, yaw_rate=None):
    def apply(message, _):
        content = copy.deepcopy(message.content)
        if speed is not None:
            content.twist.twist.linear.x = speed
        if yaw_rate is not None:
            content.twist.twist.angular.z = yaw_rate
        return [message._replace(content=content)]

    return apply
