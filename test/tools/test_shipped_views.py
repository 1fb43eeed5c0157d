#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the package ships for other people's tools: the Foxglove layout and the groups of the diagnostics
name topics and nodes that there are, and record.launch takes what the chain takes."""

import itertools
import json
import re
import unittest

import yaml
from launch_files import PACKAGE, load

from datmo_tools.launch_arguments import arguments_of


def panels_of(node):
    """The names of the panels in a layout's tree."""
    if isinstance(node, str):
        return [node]
    return panels_of(node["first"]) + panels_of(node["second"])


def node_names():
    """Of all nodelets of perception.launch."""
    text = (PACKAGE / "launch/perception.launch").read_text()
    return set(re.findall(r'name="(\w+)" args="load', text))


def recorder(*words):
    """The words of rosbag record."""
    node, = load("record.launch", ["bag:=drive", *words]).nodes
    return node.args.split()


class ShippedViews(unittest.TestCase):
    def test_the_layout_shows_each_panel_once(self):
        layout = json.loads((PACKAGE / "config/foxglove_layout.json").read_text())
        self.assertEqual(sorted(panels_of(layout["layout"])), sorted(layout["configById"]))

    def test_the_layout_names_topics_that_there_are(self):
        text = (PACKAGE / "config/foxglove_layout.json").read_text()
        code = "".join(file.read_text() for folder in ("src/nodelets", "src/ros", "launch")
                       for file in (PACKAGE / folder).rglob("*") if file.is_file())
        for topic in set(re.findall(r'"/([a-z_0-9/]+)', text)) - {"diagnostics", "rosout"}:
            self.assertTrue(re.search(f'["/]{topic}"', code), topic)

    def test_each_stage_has_one_group_of_diagnostics(self):
        groups = yaml.safe_load((PACKAGE / "config/diagnostics/aggregator.yaml").read_text())["analyzers"]
        starts = list(itertools.chain(*(group["startswith"] for group in groups.values())))
        self.assertEqual(len(starts), len(set(starts)))
        self.assertLessEqual(set(starts), node_names())

    def test_record_takes_the_inputs_of_the_chain(self):
        takes = arguments_of(PACKAGE / "launch/perception.launch", str)
        inputs = {name for name in ("scan", "echoes", "odometry", "points2", "right_camera_info",
                                    "imu", "twist", "joint_states", "cloud") if name in takes}
        self.assertLessEqual(inputs, arguments_of(PACKAGE / "launch/record.launch", str))

    def test_record_records_the_given_topics(self):
        words = recorder("scan:=/front")
        for word in ("/front", "odometry", "/tf", "/tf_static", "--lz4"):
            self.assertIn(word, words)
        for word in ("scan", "tracks", "--split"):
            self.assertNotIn(word, words)
        words = recorder("results:=true", "split:=1024", "compress:=false")
        for word in ("tracks", "map", "--split", "--size=1024"):
            self.assertIn(word, words)
        self.assertNotIn("--lz4", words)


if __name__ == "__main__":
    unittest.main()
