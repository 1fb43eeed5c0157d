# SPDX-License-Identifier: BSD-3-Clause
"""Publishes the topic `tracks` in another package's messages, for nodes that expect those.

usage: publish_tracks_as vision_msgs|derived_object_msgs [tracks:=TOPIC] [ROS remappings]

Out: tracks/vision_msgs (vision_msgs/Detection3DArray) or tracks/derived_object_msgs
(derived_object_msgs/ObjectArray), while there is a subscriber. The package must be installed:
Ubuntu has both, Debian 12 has neither.
"""

import importlib
import sys

import rospy

from datmo_fusion.msg import TrackArray
from datmo_tools import track_bridge

BRIDGES = {"vision_msgs": ("Detection3DArray", track_bridge.to_detections),
           "derived_object_msgs": ("ObjectArray", track_bridge.to_derived_objects)}
QUEUE = 20  # one second of tracks: enough for a short delay, and bounded


def main():
    """Returns the exit code: 1 for an invalid command line or a missing package."""
    words = rospy.myargv()[1:]
    if words in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    if len(words) != 1 or words[0] not in BRIDGES:
        print(__doc__, file=sys.stderr)
        return 1
    package = words[0]
    try:
        module = importlib.import_module(f"{package}.msg")
    except ImportError:
        print(f"publish_tracks_as: the package {package} not found, expected it on PYTHONPATH "
              f"(Ubuntu: ros-noetic-{package.replace('_', '-')})", file=sys.stderr)
        return 1
    name, convert = BRIDGES[package]
    rospy.init_node("tracks_as_" + package)
    publisher = rospy.Publisher(f"tracks/{package}", getattr(module, name), queue_size=QUEUE)

    def take(tracks):
        if publisher.get_num_connections() > 0:
            publisher.publish(convert(tracks, module))

    rospy.Subscriber("tracks", TrackArray, take, queue_size=QUEUE, tcp_nodelay=True)
    rospy.spin()
    return 0

