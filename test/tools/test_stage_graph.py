#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""perception.launch starts the stages of the graph that run_bag runs, with the same topics and the same
parameters, for every combination of levels, with and without all that goes with any of them."""

import itertools
import json
import os
import subprocess
import unittest

from launch_files import load

LEVELS = ("low_level_fusion", "stereo_objects", "object_fusion", "track_fusion", "mono")
OTHERS = ("cloud", "road_border", "static_points", "cloud_objects", "v2x", "risk")
DISPLAYS = {"markers", "lidar_markers", "stereo_markers", "grid_views", "camera_view", "stack"}


def graph_stages(switches):
    """The stages of the graph: name -> type, remaps, parameters."""
    text = subprocess.run([os.environ["DATMO_FUSION_PRINT_STAGE_GRAPH"], *switches], check=True,
                          stdout=subprocess.PIPE).stdout
    return json.loads(text)


def launched_stages(switches):
    """The same of perception.launch; topics that are remapped to themselves are left out."""
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


class StageGraph(unittest.TestCase):
    maxDiff = None

    @staticmethod
    def combinations():
        for values in itertools.product([False, True], repeat=len(LEVELS)):
            levels = [level for level, value in zip(LEVELS, values) if value]
            yield levels
            yield [*levels, *OTHERS]
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


if __name__ == "__main__":
    unittest.main()
