#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The master is killed and restarted while the stack runs: new subscribers find all topics, the
parameters are there, and the process of the nodelets, if killed then, restarts with all of them."""

import os
import signal
import subprocess
import tempfile
import unittest
import xmlrpc.client
from pathlib import Path

import rosgraph
from master_process import MasterProcess, wait_for

from datmo_tools import registrations

PACKAGE = Path(__file__).resolve().parents[2]
MANAGER = "/perception"
# A separate process, which a new master tells where the topic is. One subscription for all messages:
# the publishers' phases are fixed, so one that subscribed anew after each message could forever
# miss those that closely follow another.
LISTEN = """
import threading
import rospy
from diagnostic_msgs.msg import DiagnosticArray
heard = threading.Event()
def hear(message):
    if any("stack" in status.name for status in message.status):
        heard.set()
rospy.init_node("listener", anonymous=True, disable_signals=True)  # an interrupt ends the wait
subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, hear)
heard.wait()
"""


class MasterRestart(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.master = MasterProcess()
        self.master.start()
        self.addCleanup(self.master.kill)
        self.as_test = rosgraph.Master("/test", self.master.uri)
        self.environment = dict(os.environ, ROS_MASTER_URI=self.master.uri, ROS_HOSTNAME="localhost",
                                ROS_LOG_DIR=folder.name, ROS_HOME=folder.name,
                                ROS_PACKAGE_PATH=f"{PACKAGE}:{os.environ.get('ROS_PACKAGE_PATH', '')}")
        # The scanner's device is there all the time, and tries to connect.
        self.start("roslaunch", str(PACKAGE / "launch/live.launch"), "lidar:=hokuyo", "lidar_address:=127.0.0.1",
                   "camera:=external", "fusion:=recommended")  # fmt: skip

    def start(self, *words):
        """A process that is ended with the test, and all of its own with it."""
        process = subprocess.Popen(words, env=self.environment)
        self.addCleanup(process.wait)
        self.addCleanup(process.send_signal, signal.SIGINT)
        return process

    def state(self):
        known = registrations.read(self.as_test)
        return known._replace(publishers=sorted(known.publishers), subscribers=sorted(known.subscribers))

    def is_complete(self):
        """Returns whether the stack publishes its tracks and subscribes to its sensors."""
        try:
            state = self.state()
        except rosgraph.MasterError:  # a node went away between two questions
            return False
        inputs = ("/scan", "/stereo/points2", "/odometry", "/diagnostics")
        return ({("/tracks", MANAGER), ("/scan", MANAGER)} <= set(state.publishers) and
                {(topic, MANAGER) for topic in inputs} <= set(state.subscribers))

    def manager(self):
        """Returns the process of the nodelets; None if it does not answer."""
        try:
            return xmlrpc.client.ServerProxy(self.as_test.lookupNode(MANAGER)).getPid("/test")[2]
        except (OSError, rosgraph.MasterError):
            return None

    def hears_the_stack(self):
        listener = self.start("/usr/bin/python3", "-c", LISTEN)
        wait_for(lambda: listener.poll() is not None, "somebody who comes later hears the stack")
        self.assertEqual(listener.returncode, 0)

    def test_everything_is_registered_again(self):
        wait_for(self.is_complete, "the stack is there")
        self.master.wait_for_read()
        manager, before = self.manager(), self.state()
        self.master.kill()
        self.assertEqual(os.kill(manager, 0), None, "it goes on")
        self.master.start()
        wait_for(self.is_complete, "the stack is registered again")
        self.master.wait_for_read()
        after = self.state()
        self.assertEqual(self.manager(), manager, "it was not started anew")
        self.assertEqual({**after.nodes, **before.nodes}, after.nodes)
        self.assertEqual(after.parameters, before.parameters)
        self.hears_the_stack()

        os.kill(manager, signal.SIGKILL)
        wait_for(lambda: self.manager() not in (None, manager), "the process of the nodelets comes back")
        self.hears_the_stack()


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # rosgraph leaves its connections to the garbage collector
