#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""record.launch records the chain's inputs: all inputs of the graph of stages that no stage
publishes, under the names of perception.launch and live.launch; with `results` also the outputs;
each topic once."""

import json
import os
import re
import subprocess
import unittest
from xml.etree import ElementTree

from launch_files import PACKAGE, load

# Published but not recorded: large, drawn only for viewers, or without a topic of their own.
NOT_RECORDED = {"/tf", "/tf_static", "grids/lidar", "grids/stereo", "grids/mono", "grids/fused", "grids/conflict"}


def recorded(*words):
    """Returns the arguments of rosbag record."""
    node, = load("record.launch", ["bag:=drive", *words]).nodes
    return node.args.split()


def printed(*words):
    return json.loads(subprocess.check_output([os.environ["DATMO_FUSION_PRINT_STAGE_GRAPH"], *words]))


def graph_topics():
    """Returns the inputs that no stage publishes, with any switches (topic -> type), and the
    stages' outputs."""
    switches = printed("--switches")
    all_but_merging = [name for name in switches if name != "merge_scans"]
    inputs, outputs = {}, set()
    for given in ([], ["merge_scans"], all_but_merging, ["cloud", "stereo_objects", *all_but_merging],
                  ["rectified_images", "stereo_objects", *switches]):
        stages = printed(*given).values()
        made = {topic for stage in stages for topic in stage["outputs"]}
        outputs |= made
        inputs.update({topic: kind for stage in stages for topic, kind in stage["inputs"].items() if topic not in made})
    return inputs, outputs


def topic_arguments(file):
    """Returns the arguments of a launch file that name the topic of a message: name -> default."""
    return {tag.get("name"): tag.get("default") for tag in ElementTree.parse(PACKAGE / "launch" / file).findall("arg")
            if re.match(r"topic, \w+/\w+", tag.get("doc") or "")}


class RecordLaunch(unittest.TestCase):
    def test_all_inputs_of_the_stages_are_recorded(self):
        inputs, _ = graph_topics()
        words = recorded()
        for topic, kind in inputs.items():
            if kind == "sensor_msgs/Image":
                self.assertIn(topic, recorded(f"images:={topic}"))
            elif topic.startswith("objects/"):  # of another system
                self.assertIn(topic, recorded(f"sources:={topic}"))
            else:
                self.assertIn(topic, words)

    def test_topics_have_the_arguments_of_the_chain(self):
        arguments = topic_arguments("record.launch")
        for file in ("perception.launch", "live.launch"):
            for name, default in topic_arguments(file).items():
                if name == "camera_image":
                    continue  # among `images`
                with self.subTest(file=file, argument=name):
                    self.assertIn(name if name != "odometry_topic" else "odometry", arguments)
                    if default and "$" not in default:
                        self.assertIn(default, recorded())
                    self.assertIn("/elsewhere", recorded(f"{name.replace('_topic', '')}:=/elsewhere"))

    def test_a_drive_with_a_lidar_of_velodynes_has_its_clouds(self):
        remaps = {node.name: dict(node.remap_args) for node in load("live.launch", ["lidar:=velodyne"]).nodes}
        self.assertIn(remaps["device"]["points"], recorded())

    def test_with_results_all_outputs_of_the_stages_are_recorded(self):
        _, outputs = graph_topics()
        words = recorded("results:=true")
        self.assertLessEqual(outputs - NOT_RECORDED, set(words))
        self.assertIn("signal_advice", words)
        for topic in ("tracks", "risks", "stations/own"):
            self.assertNotIn(topic, recorded())

    def test_each_topic_is_given_once(self):
        words = recorded("results:=true", "cloud:=points", "sources:=objects/stereo tracks/other")
        self.assertIn("tracks/other", words)
        self.assertEqual(sorted(words), sorted(set(words)))

    def test_given_names_replace_the_defaults(self):
        words = recorded("scan:=/front")
        for word in ("/front", "odometry", "/tf", "/tf_static", "--lz4"):
            self.assertIn(word, words)
        for word in ("scan", "--split"):
            self.assertNotIn(word, words)

    def test_options_of_rosbag(self):
        words = recorded("split:=1024", "compress:=false")
        for word in ("--split", "--size=1024"):
            self.assertIn(word, words)
        self.assertNotIn("--lz4", words)


if __name__ == "__main__":
    unittest.main()
