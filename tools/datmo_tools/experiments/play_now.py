# SPDX-License-Identifier: BSD-3-Clause
"""Plays topics of a bag as if they were measured now: all stamps are shifted to the clock.

usage: play_now BAG --seconds S --nodelets NAME... --topics TOPIC...

Waits until the nodelets have reported on /diagnostics and all subscribers are connected, prints
`ready`, and reads a line: the time (s) for the first message. Several of these play one bag
together.
"""

import sys
import time

import rosbag
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray

from datmo_tools.command_line import new_parser, run

QUEUE = 200
POLL = 0.1  # s
STATIC = "/tf_static"  # published before it begins
LATCHED = (STATIC, "/stereo/left/camera_info", "/stereo/right/camera_info")


def shift(message, duration):
    """Shifts a message, and the transforms in it, by this much."""
    for stamped in (message, *getattr(message, "transforms", ())):
        if hasattr(stamped, "header"):
            stamped.header.stamp += duration
    return message


def wait_for_nodelets(names):
    """Waits until all have reported; returns their subscriptions: (topic, node of the process)."""
    missing, subscriptions = set(names), set()

    def take(list_of_all):
        process = list_of_all._connection_header["callerid"]
        for status in list_of_all.status:
            missing.discard(status.name.split(":")[0])
            for value in status.values:
                if value.key == "inputs":
                    subscriptions.update((topic, process) for topic in value.value.split())
    subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, take)
    while missing and not rospy.is_shutdown():
        time.sleep(POLL)
    subscriber.unregister()
    return subscriptions


def wait_for_connections(publishers, subscriptions):
    """Waits until all subscribers of the topics are known to the master, and connected."""
    master = rosgraph.Master(rospy.get_name())
    while not rospy.is_shutdown():
        subscribers = {topic: set(nodes) for topic, nodes in master.getSystemState()[1]}
        known = all(process in subscribers.get(topic, ()) for topic, process in subscriptions if topic in publishers)
        if known and all(publisher.get_num_connections() >= len(subscribers.get(topic, ()))
                         for topic, publisher in publishers.items()):
            return
        time.sleep(POLL)


def play(values):
    rospy.init_node("play_now", anonymous=True, disable_signals=True)
    with rosbag.Bag(str(values.bag)) as bag:
        begin = bag.get_start_time()
        messages = [each for each in bag.read_messages(topics=values.topics)
                    if each.timestamp.to_sec() - begin < values.seconds]
    publishers = {}
    for topic, message, _ in messages:
        if topic not in publishers:
            publishers[topic] = rospy.Publisher(topic, type(message), queue_size=QUEUE, latch=topic in LATCHED)
    for topic, message, _ in messages:
        if topic == STATIC:
            publishers[topic].publish(message)
    wait_for_connections(publishers, wait_for_nodelets(values.nodelets))
    print("ready", flush=True)
    later = float(sys.stdin.readline()) - begin
    for topic, message, recorded in messages:
        if topic == STATIC:
            continue
        time.sleep(max(0.0, recorded.to_sec() + later - time.time()))
        publishers[topic].publish(shift(message, rospy.Duration.from_sec(later)))
    print("played", flush=True)
    sys.stdin.readline()  # latched messages have arrived by then


def main():
    """Returns the exit code."""
    parser = new_parser("play_now", __doc__)
    parser.add_argument("bag")
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--nodelets", nargs="*", default=[])
    parser.add_argument("--topics", nargs="+", required=True)
    values = parser.parse_args()
    return run("play_now", lambda: play(values), "message")
