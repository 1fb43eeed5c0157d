# SPDX-License-Identifier: BSD-3-Clause
"""Plays topics of a bag as if they were measured now: all stamps are as much later as the clock is.

usage: play_now BAG --nodelets NAME... --topics TOPIC...

Waits until the nodelets have reported on /diagnostics and all who subscribe are connected, says `ready`,
and reads a line: the time (s) at which the first message is of. Several of these play one bag together.
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
LATCHED = ("/tf_static", "/stereo/left/camera_info", "/stereo/right/camera_info")


def shift(message, duration):
    """Makes a message, and the transforms in it, as much later."""
    for stamped in (message, *getattr(message, "transforms", ())):
        if hasattr(stamped, "header"):
            stamped.header.stamp += duration
    return message


def wait_for_nodelets(names):
    """Until all of them have reported once."""
    missing = set(names)

    def take(list_of_all):
        missing.difference_update(status.name.split(":")[0] for status in list_of_all.status)
    subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, take)
    while missing and not rospy.is_shutdown():
        time.sleep(POLL)
    subscriber.unregister()


def wait_for_connections(publishers):
    """Until as many are connected as the master knows subscribers."""
    master = rosgraph.Master(rospy.get_name())
    while not rospy.is_shutdown():
        subscribers = {topic: len(nodes) for topic, nodes in master.getSystemState()[1]}
        if all(publisher.get_num_connections() >= subscribers.get(topic, 0)
               for topic, publisher in publishers.items()):
            return
        time.sleep(POLL)


def play(values):
    rospy.init_node("play_now", anonymous=True, disable_signals=True)
    with rosbag.Bag(str(values.bag)) as bag:
        begin = bag.get_start_time()
        kinds = {topic: kind for topic, kind in bag.get_type_and_topic_info().topics.items() if topic in values.topics}
        messages = list(bag.read_messages(topics=list(kinds)))
    publishers = {}
    for topic in kinds:
        first = next(message for name, message, _ in messages if name == topic)
        publishers[topic] = rospy.Publisher(topic, type(first), queue_size=QUEUE, latch=topic in LATCHED)
    wait_for_nodelets(values.nodelets)
    wait_for_connections(publishers)
    print("ready", flush=True)
    later = float(sys.stdin.readline()) - begin
    for topic, message, recorded in messages:
        time.sleep(max(0.0, recorded.to_sec() + later - time.time()))
        publishers[topic].publish(shift(message, rospy.Duration.from_sec(later)))
    print("played", flush=True)
    sys.stdin.readline()  # latched messages are there until then


def main():
    """The exit code."""
    parser = new_parser("play_now", __doc__)
    parser.add_argument("bag")
    parser.add_argument("--nodelets", nargs="*", default=[])
    parser.add_argument("--topics", nargs="+", required=True)
    values = parser.parse_args()
    return run("play_now", lambda: play(values), "message")
