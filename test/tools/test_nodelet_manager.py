#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The process of the nodelets asks the master for nothing twice while nodelets are loaded: on a
slow network, requests to the master are most of the time that a killed process is missing."""

import collections
import os
import subprocess
import tempfile
import unittest
import xmlrpc.client
from pathlib import Path

import rosgraph.xmlrpc
from master_process import WORKERS, wait_for
from rosmaster.master_api import ROSMasterHandler

PACKAGE = Path(__file__).resolve().parents[2]
MANAGER = "/perception"
NODELETS = {"moving_objects": "/labeled_scan", "tracker": "/objects/early"}  # the last input of each
LATER = ("getPublishedTopics", "unregisterPublisher")  # of diagnostics, and of rosout at the end
MOST = 50  # requests; with `nodelet manager` and a request for each parameter 100


class CountingMaster:
    """A master that counts the HTTP requests of a node: (method, its arguments)."""

    def __init__(self, node):
        self.requests = collections.Counter()
        self._node = node
        server = rosgraph.xmlrpc.XmlRpcNode(0, ROSMasterHandler(WORKERS))
        server.start()
        wait_for(lambda: server.uri, "the master listens")
        self.uri = f"http://localhost:{server.port}"
        self.stop = lambda: server.shutdown("the test ends")
        self._answer = server.server._marshaled_dispatch
        server.server._marshaled_dispatch = self._count

    def _count(self, data, *arguments):
        parameters, method = xmlrpc.client.loads(data)
        calls = parameters[0] if method == "system.multicall" else [{"params": parameters}]
        if calls[0]["params"][0] == self._node and method not in LATER:
            self.requests[method, repr([call["params"] for call in calls])] += 1
        return self._answer(data, *arguments)

    def has_subscribed(self, topic):
        return any(method == "registerSubscriber" and f"'{topic}'" in arguments for method, arguments in [*self.requests])


class NodeletManager(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.master = CountingMaster(MANAGER)
        self.addCleanup(self.master.stop)
        self.environment = dict(os.environ, ROS_MASTER_URI=self.master.uri, ROS_HOSTNAME="localhost",
                                ROS_LOG_DIR=folder.name, ROS_HOME=folder.name,
                                ROS_PACKAGE_PATH=f"{PACKAGE}:{os.environ.get('ROS_PACKAGE_PATH', '')}")

    def start(self, program, *words):
        process = subprocess.Popen([os.environ[program], *words], env=self.environment)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)

    def test_no_request_is_sent_twice(self):
        self.start("NODELET_MANAGER", "manager", f"__name:={MANAGER[1:]}")
        for nodelet, last_input in NODELETS.items():
            self.start("LOAD_NODELET", "load", f"datmo_fusion/{nodelet}", MANAGER[1:], f"__name:={nodelet}",
                       "early_objects:=objects/early")  # fmt: skip
            wait_for(lambda topic=last_input: self.master.has_subscribed(topic), f"{nodelet} is loaded")
        repeated = {request: count for request, count in self.master.requests.items() if count > 1}
        self.assertFalse(repeated)
        self.assertLess(sum(self.master.requests.values()), MOST, self.master.requests)


if __name__ == "__main__":
    unittest.main()
