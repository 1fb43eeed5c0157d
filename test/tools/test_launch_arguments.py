#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The command line of roslaunch: argument names that no launch file has are refused,
with the nearest one."""

import tempfile
import unittest
import xmlrpc.client
import xmlrpc.server
import threading
from pathlib import Path
from xml.etree import ElementTree

from datmo_tools import launch_arguments

PACKAGE = Path(__file__).resolve().parents[2]


def in_package(path):
    return path.replace("$(find datmo_fusion)", str(PACKAGE))


class LaunchArguments(unittest.TestCase):
    def test_words_of_roslaunch_alone(self):
        words = launch_arguments.launch_words
        self.assertEqual(words(["/usr/bin/python3", "/usr/bin/roslaunch", "a", "b:=1"]), ["a", "b:=1"])
        self.assertEqual(words(["roslaunch", "a"]), ["a"])
        self.assertEqual(words(["/usr/bin/python3", "test.py", "roslaunch"]), [])
        self.assertEqual(words([]), [])

    def test_replay_takes_what_perception_takes(self):
        perception = launch_arguments.arguments_of(PACKAGE / "launch/perception.launch", in_package)
        replay = launch_arguments.arguments_of(PACKAGE / "launch/replay.launch", in_package)
        self.assertIn("config", perception)
        self.assertNotIn("tracked_objects", perception, "it has a value")
        self.assertLess(perception, replay)
        self.assertIn("bag", replay)

    def test_a_plain_include_passes_nothing_on(self):
        with tempfile.TemporaryDirectory() as folder:
            inner = Path(folder, "inner.launch")
            inner.write_text('<launch><arg name="scan" default="s"/></launch>')
            outer = Path(folder, "outer.launch")
            outer.write_text(f'<launch><arg name="bag"/><group><include file="{inner}"/></group></launch>')
            self.assertEqual(launch_arguments.arguments_of(outer, str), {"bag"})
            outer.write_text(outer.read_text().replace("/></group>", ' pass_all_args="true"/></group>'))
            self.assertEqual(launch_arguments.arguments_of(outer, str), {"bag", "scan"})

    def test_every_argument_has_a_doc_string(self):
        for file in sorted((PACKAGE / "launch").glob("*.launch")):
            for tag in ElementTree.parse(file).getroot().findall("arg"):
                self.assertTrue(tag.get("doc"), f"{file}: {tag.get('name')}")
                internal = tag.get("doc").startswith("internal: ")
                self.assertEqual(internal, tag.get("value") is not None, f"{file}: {tag.get('name')}")

    def test_a_sensor_set_without_a_file(self):
        folder = PACKAGE / "config"
        missing = launch_arguments.missing_configuration
        self.assertIsNone(missing(["sensors:=kitti", "preset:=thesis"], folder))
        self.assertIsNone(missing(["preset:=", f"config:={folder}/kitti.yaml", "sensors:=own"], folder))
        self.assertIn("sensors:=kiti: no kiti.yaml in", missing(["sensors:=kiti"], folder))
        self.assertIn("did you mean kitti? There are demonstrator, ", missing(["sensors:=kiti"], folder))
        self.assertIn("preset:=thesi", missing(["preset:=thesi"], folder))
        self.assertIn("config:=/none.yaml: no such file", missing(["config:=/none.yaml"], folder))

    def test_an_unknown_name_is_refused_with_the_nearest(self):
        known = {"sensors", "scan", "odometry"}
        self.assertIsNone(launch_arguments.refusal(["scan"], known))
        self.assertEqual(launch_arguments.refusal(["scan", "odometri"], known),
                         "no argument odometri: did you mean odometry? There are odometry, scan, sensors")
        self.assertEqual(launch_arguments.refusal(["xyz"], known),
                         "no argument xyz: There are odometry, scan, sensors")

    def test_the_words_of_a_real_command_line(self):
        file = str(PACKAGE / "launch/stereo_images.launch")
        self.assertIsNone(launch_arguments.check_words([file, "images:=raw", "__name:=x"]))
        self.assertIsNone(launch_arguments.check_words([file]))
        self.assertIsNone(launch_arguments.check_words(["-p", "11311", file, "images:=raw"]))
        self.assertIn("no argument image: did you mean images?",
                      launch_arguments.check_words([file, "image:=raw", "-v"]))

    def test_an_unknown_level_of_fusion_is_refused(self):
        file = str(PACKAGE / "launch/perception.launch")
        self.assertIsNone(launch_arguments.check_words([file, "fusion:=recommended"]))
        self.assertEqual(launch_arguments.check_words([file, "fusion:=all"]),
                         "fusion:=all: expected one of none, low, object, track, recommended")

    def test_whether_a_stack_runs_is_asked_of_its_node(self):
        with xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False) as server:
            uri = f"http://localhost:{server.server_address[1]}"
            server.register_function(lambda caller, name: (1, "", uri), "lookupNode")
            server.register_function(lambda caller: (1, "", 7), "getPid")
            threading.Thread(target=server.serve_forever, daemon=True).start()
            self.assertTrue(launch_arguments.runs("/perception", uri))
            self.assertIn("/left/perception already runs on", launch_arguments.second_stack(
                ["a.launch"], {"ROS_MASTER_URI": uri, "ROS_NAMESPACE": "/left/"}))
            self.assertIsNone(launch_arguments.second_stack(["--nodes", "a.launch"], {"ROS_MASTER_URI": uri}))
            server.register_function(lambda caller, name: (-1, "unknown node", ""), "lookupNode")
            self.assertFalse(launch_arguments.runs("/perception", uri))
            server.shutdown()
        self.assertFalse(launch_arguments.runs("/perception", uri), "no master at all")


if __name__ == "__main__":
    unittest.main()
