#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""perception.launch starts the stages of the graph that run_bag runs, with the same topics and the
same parameters, for every combination of levels, with and without everything that depends on them;
and each in the part of the stack given by the graph, if parts run on separate machines. What a new
stage lacks (doc/development.md) is reported by name."""

import collections
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

from launch_files import PACKAGE, load


def printed(*words):
    """Returns the output of print_stage_graph; if it fails, ends the test with its message."""
    done = subprocess.run([os.environ["DATMO_FUSION_PRINT_STAGE_GRAPH"], *words], check=False, encoding="utf-8",
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


SWITCHES = printed("--switches")
LEVELS = ("low_level_fusion", "stereo_objects", "object_fusion", "track_fusion", "mono")
OTHERS = ("cloud", *(name for name in SWITCHES if name not in (*LEVELS, "merge_scans")))
DISPLAYS = {"markers", "lidar_markers", "stereo_markers", "grid_views", "camera_view", "stack"}
SMALL_IMAGE = 640 * 480  # bytes
PARTS = ("sensors", "stereo", "perception", "risk")
# Nodelets that are no stages of the graph, by part; stereo_points and those of raw images belong to
# stereo_image_proc.
BESIDE = {"stack": "perception", "stereo_points": "stereo", "left_debayer": "stereo", "left_rectify": "stereo",
          "right_debayer": "stereo", "right_rectify": "stereo",
          **{name: "risk" for name in DISPLAYS - {"stack"}}}


def graph_stages(switches):
    """Returns the stages of the graph: name -> type, remaps, parameters."""
    return printed(*switches)


def launched_stages(switches):
    """Returns the same of perception.launch;
    topics that are remapped to themselves are left out."""
    words = [f"{switch}:={str(switch in switches).lower()}"
             for switch in (*LEVELS, *OTHERS, "merge_scans") if switch != "cloud"]
    words += ["cloud:=cloud"] if "cloud" in switches else []
    config = load("perception.launch", words)
    stages = {}
    for node in config.nodes:
        command, _, kind = node.args.partition(" ")
        if command != "load" or not kind.startswith("datmo_fusion/") or node.name in DISPLAYS:
            continue
        stages[node.name] = {
            "type": kind.split()[0].split("/")[1],
            "remaps": {a: b for a, b in node.remap_args if a != b},
            "parameters": {}}
    return stages, {key: parameter.value for key, parameter in config.params.items()}


def crossing_topics():
    """Returns topics that parts receive from drivers or other parts: type, publisher, and the parts
    that subscribe."""
    crossing = {}
    for switches in (LEVELS, ["rectified_images", *LEVELS, *OTHERS], ["merge_scans", *LEVELS]):
        stages = graph_stages(switches).values()
        makers = {topic: stage["part"] for stage in stages for topic in stage["outputs"]}
        for stage in stages:
            for topic, kind in stage["inputs"].items():
                maker = makers.get(topic, "drivers")
                if maker != stage["part"]:
                    crossing.setdefault((topic, kind, maker), set()).add(stage["part"])
    return {key: ", ".join(part for part in PARTS if part in takers) for key, takers in crossing.items()}


class StageGraph(unittest.TestCase):
    maxDiff = None

    @staticmethod
    def combinations():
        for values in itertools.product([False, True], repeat=len(LEVELS)):
            levels = [level for level, value in zip(LEVELS, values) if value]
            yield levels
            yield [*levels, *OTHERS]
        yield from ([other] for other in OTHERS)
        yield ["merge_scans"]
        yield ["merge_scans", *LEVELS]

    def test_the_launch_file_starts_the_graph(self):
        for switches in self.combinations():
            with self.subTest(switches=switches):
                expected = graph_stages(switches)
                launched, parameters = launched_stages(switches)
                self.assertEqual({name: (stage["type"], stage["remaps"])
                                  for name, stage in launched.items()},
                                 {name: (stage["type"], stage["remaps"])
                                  for name, stage in expected.items()})
                for name, stage in expected.items():
                    for key, value in stage["parameters"].items():
                        self.assertEqual(parameters[f"/{name}/{key}"], value, f"{name}/{key}")

    def test_topics_between_parts_are_documented(self):
        """The table of doc/machines.md: topic, type, publisher, and the parts that subscribe."""
        page = (PACKAGE / "doc/machines.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| `([\w/]+)` \| `([\w/]+)` \| ([\w ]+) \| ([\w, ]+) \|$", page, re.MULTILINE)
        self.assertEqual({row[:3]: row[3] for row in rows}, crossing_topics())


class NewStage(unittest.TestCase):
    """Everything that a stage needs is there; a failure names only what is missing."""
    longMessage = False

    @classmethod
    def setUpClass(cls):
        cls.classes = {each.get("name"): each.get("type")
                       for each in ElementTree.parse(PACKAGE / "nodelets.xml").getroot().iter("class")}
        cls.stages = sorted(path.name[:-len("_stage.cpp")] for path in (PACKAGE / "src/ros/stage").glob("*_stage.cpp"))
        cls.graph = graph_stages(["cloud", "rectified_images", "merge_scans", *LEVELS, *OTHERS])
        cls.launch = ElementTree.parse(PACKAGE / "launch/perception.launch").getroot()

    def test_each_stage_has_an_entry_in_nodelets_xml(self):
        for name in self.stages:
            self.assertIn(f"datmo_fusion/{name}", self.classes,
                          f'src/ros/stage/{name}_stage.cpp: nodelets.xml lacks <class name="datmo_fusion/{name}" ...>')

    def test_each_entry_names_the_class_of_its_stage(self):
        for name in self.stages:
            if f"datmo_fusion/{name}" not in self.classes:
                continue  # reported by the test before
            stage = self.classes[f"datmo_fusion/{name}"].replace("datmo::", "").replace("Nodelet", "Stage")
            header = f"include/datmo_fusion/ros/stage/{name}_stage.h"
            self.assertRegex((PACKAGE / header).read_text(encoding="utf-8"), rf"\nclass {stage} ",
                             f"{header}: lacks class {stage}, which nodelets.xml hosts as datmo_fusion/{name}")

    def test_each_stage_has_a_row_in_the_graph(self):
        types = {stage["type"] for stage in self.graph.values()}
        for name in self.stages:
            self.assertIn(name, types, f"src/ros/stage/stage_graph.cpp lacks a row '{name}'")

    def test_each_row_has_a_node_in_the_launch_file(self):
        nodes = {node.get("name") for node in self.launch.iter("node")}
        for name in set(self.graph) - {"stereo_image_proc"}:  # of stereo_images.launch
            self.assertIn(name, nodes, f'launch/perception.launch lacks <node name="{name}" ...>')

    def test_each_switch_is_one_of_the_launch_file(self):
        arguments = {each.get("name") for each in self.launch.findall("arg")}
        for name in SWITCHES:
            self.assertIn(name, arguments, f'launch/perception.launch lacks <arg name="{name}" ...>')


class Parts(unittest.TestCase):
    """The parts of the stack on separate machines."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.machines = Path(folder.name, "machines.launch")
        tags = "".join(f'<machine name="{part}" address="localhost" />' for part in PARTS)
        self.machines.write_text(f"<launch>{tags}</launch>", encoding="utf-8")

    def loaded(self, parts, switches, *more):
        words = [f"{switch}:=true" for switch in switches if switch != "cloud"]
        words += ["cloud:=cloud"] if "cloud" in switches else []
        words += [f"{part}_machine:={part}" for part in parts]
        self.config = load("perception.launch", [*words, f"machines:={self.machines}", *more])
        return self.config.nodes

    @staticmethod
    def by_name(nodes):
        """Returns everything about a node except its machine, by name;
        the clock responder is left out."""
        return {node.name: (node.package, node.type, node.args.split()[:2], sorted(node.remap_args), node.respawn)
                for node in nodes if "part_clock" not in node.args}

    def test_all_parts_together_are_the_whole_stack(self):
        for switches, images in (([], "none"), (LEVELS, "rectified"), ([*LEVELS, *OTHERS], "raw")):
            more = ["aggregator:=true", f"stereo_images:={images}"]
            whole = self.by_name(self.loaded([], switches, *more))
            for parts in (["stereo"], PARTS):
                with self.subTest(switches=switches, images=images, parts=parts):
                    split = self.by_name(self.loaded(parts, switches, *more))
                    managers = {f"perception_{part}" for part in parts if part != "perception"}
                    self.assertEqual(set(split) - set(whole), managers)
                    for name in managers:
                        self.assertEqual(split[name], whole["perception"])
                    self.assertEqual({name: split[name] for name in whole}, whole)

    def test_each_part_loads_what_the_graph_says(self):
        everything = ["rectified_images", "merge_scans", *LEVELS, *OTHERS]
        expected = {name: stage["part"] for name, stage in graph_stages(everything).items()}
        expected.update(BESIDE)
        seen = set()
        for switches, more in (([*LEVELS, *OTHERS], ["stereo_images:=raw"]), (["merge_scans"], [])):
            for parts in ([], *([part] for part in PARTS), PARTS):
                for node in self.loaded(parts, switches, *more):
                    self.check(node, parts, expected, seen)
        self.assertEqual(seen, set(expected))

    def check(self, node, parts, expected, seen):
        """A nodelet is loaded into the process of its part, on the same machine."""
        words = node.args.split()
        if words[:1] != ["load"] or "part_clock" in words[1]:
            return
        seen.add(node.name)
        part = expected[node.name]
        alone = part in parts and part != "perception"
        with self.subTest(node=node.name, parts=parts):
            self.assertEqual(words[2], f"perception_{part}" if alone else "perception")
            self.assertEqual(node.machine_name,
                             part if alone else "perception" if "perception" in parts else None)

    def check_threads(self, config, managers):
        """As many threads as nodelets in each process."""
        loaded = collections.Counter(node.args.split()[2] for node in config.nodes if node.args.startswith("load "))
        self.assertEqual(len(loaded), managers)
        for manager, nodelets in loaded.items():
            self.assertGreaterEqual(config.params[f"/{manager}/num_worker_threads"].value, nodelets)

    def test_there_is_a_thread_for_each_nodelet(self):
        self.loaded(PARTS, [*LEVELS, *OTHERS], "stereo_images:=raw")
        self.check_threads(self.config, len(PARTS))

    def test_each_process_returns_the_memory_of_images_to_the_system(self):
        nodes = self.loaded(PARTS, [*LEVELS, *OTHERS])
        managers = [dict(node.env_args) for node in nodes if node.args == "manager"]
        self.assertEqual(len(managers), len(PARTS))
        for environment in managers:
            self.assertLess(int(environment["MALLOC_MMAP_THRESHOLD_"]), SMALL_IMAGE)

    def test_there_is_a_thread_for_each_nodelet_of_one_process_with_devices(self):
        words = [f"{switch}:=true" for switch in (*LEVELS, *OTHERS, "v2x_wire") if switch != "cloud"]
        self.check_threads(load("live.launch", [*words, "cloud:=cloud", "stereo_images:=raw", "lidar:=velodyne",
                                                "odometry:=can_imu", f"config:={PACKAGE}/config/demonstrator.yaml"]), 1)

    def test_each_machine_beside_perceptions_answers_for_its_clock(self):
        nodes = {node.name: node for node in self.loaded(PARTS, ["risk"])}
        for part in PARTS:
            manager = "perception" if part == "perception" else f"perception_{part}"
            self.assertEqual(nodes[manager].machine_name, part)
            if part == "perception":
                self.assertNotIn("perception_clock", nodes)
            else:
                self.assertEqual(nodes[f"{part}_clock"].args, f"load datmo_fusion/part_clock perception_{part}")
                self.assertEqual(nodes[f"{part}_clock"].machine_name, part)


if __name__ == "__main__":
    unittest.main()
