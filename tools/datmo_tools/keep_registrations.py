# SPDX-License-Identifier: BSD-3-Clause
"""Registers all nodes, topics, services and parameters again after the master was restarted.

usage: keep_registrations [ROS remappings]

Nodes register only once, at startup. If roscore ends and is restarted with the same URI, they stay
connected to each other, but new nodes cannot find them, and respawned nodes lack their parameters.
This node asks the master every second whether it is still registered there, and remembers what the
master knows.
"""

import http.client
import sys
import time

import rosgraph
import rospy

from datmo_tools import registrations

PERIOD = 1.0  # s; what registers in the last period before the master ends is not registered again


class Keeper:
    """Remembers what the master knew at the last query."""

    def __init__(self, uri, own_name):
        self._master = rosgraph.Master(own_name, uri)
        self._known = registrations.NOTHING
        self._is_there = True

    def step(self):
        """Queries the master once; logs what is new."""
        try:
            self._ask()
            self._is_there = True
        except rosgraph.MasterException:
            pass  # a node shut down between two queries: retry next time
        except (OSError, http.client.HTTPException) as error:
            if self._is_there:
                rospy.logwarn("no master answers at %s (%s), expected roscore there: connected nodes keep running",
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
        """Whether this is still the master with which this node registered."""
        try:
            self._master.lookupNode(self._master.caller_id)
        except rosgraph.MasterError:
            return False
        return True


def main():
    """Returns the exit code: 1 for an invalid command line."""
    words = rospy.myargv()[1:]
    if words:
        is_question = words in (["-h"], ["--help"])
        print(__doc__, file=sys.stdout if is_question else sys.stderr)
        return 0 if is_question else 1
    rospy.init_node("keep_registrations")
    keeper = Keeper(rosgraph.get_master_uri(), rospy.get_name())
    while not rospy.is_shutdown():
        keeper.step()
        time.sleep(PERIOD)  # wall time: ROS time may stand still
    return 0
