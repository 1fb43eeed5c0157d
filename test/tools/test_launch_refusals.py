#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""roslaunch on the launch files with invalid arguments: it ends before a node starts, with one line
that names the error and what was probably meant."""

import os
import subprocess
import tempfile
import threading
import unittest
import xmlrpc.server
from pathlib import Path

TIMEOUT = 600  # s for a roslaunch that hangs; on a busy machine one takes half a minute
PACKAGE = Path(__file__).resolve().parents[2]


class LaunchRefusals(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def refusal(self, file, *words, master="http://localhost:1"):
        """Returns the output of roslaunch; it ends by itself, without a master."""
        environment = dict(os.environ, ROS_LOG_DIR=str(self.folder), ROS_HOME=str(self.folder),
                           ROS_PACKAGE_PATH=f"{PACKAGE}:{os.environ.get('ROS_PACKAGE_PATH', '')}",
                           ROS_MASTER_URI=master, DISPLAY="")
        run = subprocess.run(["roslaunch", str(PACKAGE / "launch" / file), *words], text=True,
                             env=environment, capture_output=True, timeout=TIMEOUT, check=False)
        self.assertNotEqual(run.returncode, 0)
        self.assertNotIn("process[", run.stdout, "no node was started")
        return run.stderr

    def config(self, text):
        file = self.folder / "sensors.yaml"
        file.write_text(text)
        return f"config:={file}"

    def test_a_misspelled_section(self):
        said = self.refusal("perception.launch", self.config("grid_slm: {map_period: 1.0}\n"))
        self.assertIn("sensors.yaml: grid_slm: no such section; the nearest one is grid_slam", said)

    def test_a_misspelled_key(self):
        said = self.refusal("perception.launch", self.config("grid_slam: {map_perod: 1.0}\n"))
        self.assertIn("map_perod = 1: expected a known key; the nearest one is map_period", said)

    def test_a_file_that_contains_itself(self):
        said = self.refusal("perception.launch", self.config("a: &a {b: *a}\n"))
        self.assertIn("an alias stands for what it stands in", said)
        self.assertNotIn("RecursionError", said)

    def test_signals_of_a_bus_that_contain_themselves(self):
        signals = self.config("can: &a {speed: *a}\n").replace("config", "can_signals")
        said = self.refusal("live.launch", "odometry:=can", signals)
        self.assertIn("an alias stands for what it stands in", said)
        self.assertNotIn("RecursionError", said)

    def test_replay_takes_the_configuration_too(self):
        said = self.refusal("replay.launch", "bag:=a.bag", self.config("grid_slm: {}\n"))
        self.assertIn("grid_slm", said)

    def test_a_misspelled_argument(self):
        said = self.refusal("replay.launch", "bag:=a.bag", "odometri:=/odom")
        self.assertIn("no argument odometri: did you mean odometry?", said)

    def test_an_unknown_part(self):
        said = self.refusal("live.launch", "v2x_part:=foo")
        self.assertIn("v2x_part:=foo: expected one of perception, sensors, stereo, risk", said)

    def test_an_unknown_sensor_set(self):
        said = self.refusal("perception.launch", "sensors:=kiti")
        self.assertIn("sensors:=kiti: no kiti.yaml in", said)
        self.assertIn("did you mean kitti?", said)

    def test_a_second_stack_on_the_same_master(self):
        with xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False) as server:
            master = f"http://localhost:{server.server_address[1]}"
            server.register_function(lambda caller, name: (1, "", master), "lookupNode")
            server.register_function(lambda caller: (1, "", os.getpid()), "getPid")
            threading.Thread(target=server.serve_forever, daemon=True).start()
            said = self.refusal("perception.launch", master=master)
            server.shutdown()
        self.assertIn(f"/perception already runs on {master}", said)


if __name__ == "__main__":
    unittest.main()
