#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files that the package ships for other tools: the Foxglove layout and the groups of the
diagnostics name existing topics and nodes."""

import itertools
import json
import re
import unittest

import yaml
from launch_files import PACKAGE


def panels_of(node):
    """Returns the names of the panels in a layout's tree."""
    if isinstance(node, str):
        return [node]
    return panels_of(node["first"]) + panels_of(node["second"])


def node_names():
    """Returns the names of all nodelets of perception.launch."""
    text = (PACKAGE / "launch/perception.launch").read_text()
    return set(re.findall(r'name="(\w+)" args="load', text))


class ShippedViews(unittest.TestCase):
    def test_the_layout_shows_each_panel_once(self):
        layout = json.loads((PACKAGE / "config/foxglove_layout.json").read_text())
        self.assertEqual(sorted(panels_of(layout["layout"])), sorted(layout["configById"]))

    def test_the_layout_names_existing_topics(self):
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


if __name__ == "__main__":
    unittest.main()
