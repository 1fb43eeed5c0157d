# SPDX-License-Identifier: BSD-3-Clause
"""Registers all nodes, topics, services and parameters again when the master was restarted.

usage: keep_registrations [ROS remappings]

Nodes register once, at their start. When roscore ends and is started again with the same URI, they stay
connected with each other, but nobody new finds them, and what is respawned later comes back without its
parameters. This node asks the master each second whether it is still known there, and keeps what the
master knows.
"""

import http.client
import sys
import time

import rosgraph
import rospy

from datmo_tools import registrations

PERIOD = 1.0  # s; what registers in the last one before the master ends is not registered again


class Keeper:
    """What the master knew when it was asked last."""

    def __init__(self, uri, own_name):
        self._master = rosgraph.Master(own_name, uri)
        self._known = registrations.NOTHING
        self._is_there = True

    def step(self):
        """Asks once; says what is new."""
        try:
            self._ask()
            self._is_there = True
        except rosgraph.MasterException:
            pass  # a node went away between two questions: the next time
        except (OSError, http.client.HTTPException) as error:
            if self._is_there:
                rospy.logwarn("no master answers at %s (%s), expected roscore there: nodes that are connected go on",
                              self._master.master_uri, error)
            self._is_there = False

    def _ask(self):
        if self._is_known_to_master():
            self._known = registrations.read(self._master, self._known)
        elif not rospy.is_shutdown():
            nodes = registrations.write(self._master, self._known)
            rospy.logwarn("the master %s was restarted: registered %d nodes and their parameters again",
                          self._master.master_uri, len(nodes))

    def _is_known_to_master(self):
        """Whether it is still the one with which this node has registered."""
        try:
            self._master.lookupNode(self._master.caller_id)
        except rosgraph.MasterError:
            return False
        return True


def main():
    """The exit code: 1 for a command line that is not understood."""
    words = rospy.myargv()[1:]
    if words:
        is_question = words in (["-h"], ["--help"])
        print(__doc__, file=sys.stdout if is_question else sys.stderr)
        return 0 if is_question else 1
    rospy.init_node("keep_registrations")
    keeper = Keeper(rosgraph.get_master_uri(), rospy.get_name())
    while not rospy.is_shutdown():
        keeper.step()
        time.sleep(PERIOD)  # of the computer's clock: that of messages may stand still
    return 0
