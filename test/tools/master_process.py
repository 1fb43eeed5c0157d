# SPDX-License-Identifier: BSD-3-Clause
"""A ROS master in a separate process, which a test kills and restarts.

As a program: master_process PORT; writes a line each time that all parameters are requested.
"""

import socket
import subprocess
import sys
import threading
import time

import rosgraph.xmlrpc
from rosmaster.master_api import ROSMasterHandler

WORKERS = 3  # threads that tell subscribers of publishers, as rosmaster's
PATIENCE = 120.0  # s, of what it takes on a machine that is busy many times over


class MasterProcess:
    """The master of one port, with start() and kill(), which can be called repeatedly."""

    def __init__(self):
        with socket.socket() as probe:
            probe.bind(("", 0))
            self.port = probe.getsockname()[1]
        self.uri = f"http://localhost:{self.port}"
        self._process = None
        self._reads = 0

    def start(self):
        """Starts it and waits until it answers."""
        self._process = subprocess.Popen([sys.executable, __file__, str(self.port)], stdout=subprocess.PIPE)
        threading.Thread(target=self._count, args=[self._process.stdout], daemon=True).start()
        master = rosgraph.Master("/test", self.uri)
        wait_for(master.is_online, "the master answers")

    def kill(self):
        """Kills it without warning, as the kernel would."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
        self._process = None

    def wait_for_read(self):
        """Waits until a client that polls the master has read everything that it knows now.

        The client reads the parameters last: the read after the next one belongs to a round that
        begins after now, and the one after that shows that the client has the answer.
        """
        end = self._reads + 3
        wait_for(lambda: self._reads >= end, "the master is read")

    def _count(self, lines):
        with lines:
            for _ in lines:
                self._reads += 1


def wait_for(condition, what):
    """Waits for the condition; raises AssertionError if it does not become true."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"not within {PATIENCE:g} s: {what}"
        time.sleep(0.1)


class _Handler(ROSMasterHandler):
    def getParam(self, caller_id, key):
        if key == "/":
            print("read", flush=True)
        return super().getParam(caller_id, key)


if __name__ == "__main__":
    node = rosgraph.xmlrpc.XmlRpcNode(int(sys.argv[1]), _Handler(WORKERS))
    node.run()
