#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a ROS master knew is passed on to the master that replaces it; with made-up nodes."""

import threading
import unittest
import xmlrpc.server
from unittest import mock

import rosgraph
from master_process import MasterProcess, wait_for

from datmo_tools import registrations
from datmo_tools.keep_registrations import Keeper

OWN = "/car1/keep_registrations"


class Node:
    """A node's XML-RPC server: records what the master reports to it."""

    def __init__(self, name, master):
        self.name = name
        self.updates = []  # publishers of a topic, as the master says
        self._server = xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False)
        self._server.register_function(self._update, "publisherUpdate")
        self.uri = f"http://localhost:{self._server.server_address[1]}/"
        self.master = rosgraph.Master(name, master.uri)
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def _update(self, _caller, _topic, publishers):
        self.updates.append(publishers)
        return 1, "", 0

    def publish(self, topic, kind="std_msgs/String"):
        self.master.registerPublisher(topic, kind, self.uri)

    def subscribe(self, topic, kind="std_msgs/String"):
        self.master.registerSubscriber(topic, kind, self.uri)

    def stop(self):
        self._server.shutdown()
        self._server.server_close()


class KeepRegistrations(unittest.TestCase):
    def setUp(self):
        self.master = MasterProcess()
        self.master.start()
        self.addCleanup(self.master.kill)
        log = mock.patch("datmo_tools.keep_registrations.rospy.logwarn", self.warn)
        log.start()
        self.addCleanup(log.stop)
        self.said = []
        self.keeper = Keeper(self.master.uri, OWN)
        self.own = self.node(OWN)
        self.own.publish("/rosout", "rosgraph_msgs/Log")

    def warn(self, text, *values):
        self.said.append(text % values)

    def node(self, name):
        node = Node(name, self.master)
        self.addCleanup(node.stop)
        return node

    def restart(self):
        self.master.kill()
        self.master.start()

    def state(self):
        known = registrations.read(rosgraph.Master("/test", self.master.uri))
        return known._replace(publishers=sorted(known.publishers), subscribers=sorted(known.subscribers))

    def test_everything_is_restored(self):
        tracker, risk = self.node("/tracker"), self.node("/risk")
        tracker.publish("/tracks", "datmo_fusion/TrackArray")
        risk.subscribe("/tracks", "*")
        risk.subscribe("/silent", "*")
        risk.master.registerService("/risk/set", "rosrpc://localhost:5", risk.uri)
        risk.master.setParam("/risk/levels", {"near": 0.5, "names": ["a", "b"]})
        before = self.state()
        self.assertEqual(before.types["/tracks"], "datmo_fusion/TrackArray")
        self.keeper.step()
        self.restart()
        self.keeper.step()
        self.assertEqual(self.state(), before)
        self.assertEqual(self.said, [f"the master {self.master.uri} was restarted: registered 3 nodes and their "
                                     "parameters again"])
        self.keeper.step()
        self.assertEqual(len(self.said), 1, "once")

    def test_new_registrations_are_kept_and_announced(self):
        first, listener, gone = self.node("/first"), self.node("/listener"), self.node("/gone")
        first.publish("/tracks")
        gone.publish("/tracks")
        listener.subscribe("/tracks")
        gone.master.setParam("/shared/old", 1)
        gone.master.setParam("/shared/both", 1)
        self.keeper.step()
        gone.stop()
        self.restart()
        second, first_again = self.node("/second"), self.node("/first")
        second.publish("/tracks")
        first_again.publish("/tracks")
        second.master.setParam("/shared/both", 2)
        self.assertEqual(listener.updates, [], "the new master does not know it")
        self.keeper.step()
        state = self.state()
        self.assertEqual(set(state.nodes), {OWN, "/first", "/second", "/listener"})
        self.assertEqual(state.nodes["/first"], first_again.uri, "not the one before")
        self.assertEqual(state.parameters, {"shared": {"old": 1, "both": 2}})
        everybody = sorted([second.uri, first_again.uri])
        wait_for(lambda: [sorted(each) for each in listener.updates] == [everybody], "the listener knows both")

    def test_no_subscriber_gets_a_part_of_the_publishers(self):
        listener = self.node("/listener")
        publishers = [self.node(f"/publisher{i}") for i in range(5)]
        for publisher in publishers:
            publisher.publish("/tf")
        listener.subscribe("/tf")
        self.keeper.step()
        self.restart()
        self.keeper.step()
        wait_for(lambda: listener.updates, "the listener is told")
        everybody = sorted(publisher.uri for publisher in publishers)
        self.assertEqual({tuple(sorted(each)) for each in listener.updates}, {tuple(everybody)})

    def test_a_service_of_a_restarted_node_has_its_new_address(self):
        node = self.node("/perception")
        node.master.registerService("/perception/list", "rosrpc://localhost:5", node.uri)
        self.keeper.step()
        node.stop()
        again = self.node("/perception")
        again.master.registerService("/perception/list", "rosrpc://localhost:6", again.uri)
        self.keeper.step()
        self.restart()
        self.keeper.step()
        self.assertEqual(again.master.lookupService("/perception/list"), "rosrpc://localhost:6")

    def test_a_missing_master_is_reported_once_and_nothing_is_forgotten(self):
        self.node("/tracker").publish("/tracks")
        self.keeper.step()
        self.master.kill()
        for _ in range(3):
            self.keeper.step()
        self.assertEqual(len(self.said), 1)
        self.assertIn(f"no master answers at {self.master.uri}", self.said[0])
        self.master.start()
        self.keeper.step()
        self.assertEqual(set(self.state().nodes), {OWN, "/tracker"})


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # rosgraph leaves its connections to the garbage collector
