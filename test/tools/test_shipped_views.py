#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files that the package ships for other tools: the Foxglove layout names existing topics, and the
groups of the diagnostics contain every node that reports a status."""

import json
import re
import unittest
from xml.etree import ElementTree

import yaml
from launch_files import PACKAGE

# Types of nodelets that report no status: they only draw, or answer with their machine's clock.
WITHOUT_STATUS = {"markers", "grid_views", "part_clock"}
GROUP = re.compile(r"\(\.\*/\)\?\(([a-z0-9_|]+)\): \.\*")

def panels_of(node):
    """Returns the names of the panels in a layout's tree."""
    if isinstance(node, str):
        return [node]
    return panels_of(node["first"]) + panels_of(node["second"])


def launched_types():
    """Returns the types of the package's nodelets in all launch files, by the name of the node."""
    types = {}
    for file in sorted((PACKAGE / "launch").glob("*.launch")):
        for node in ElementTree.parse(file).getroot().iter("node"):
            kind = re.match(r"load datmo_fusion/(\w+) ", node.get("args", ""))
            if kind:
                types[node.get("name")] = kind[1]
    return types


def graph_stages():
    """Returns the names of the stages of the graph, but for that of another package's nodelets."""
    rows = (PACKAGE / "src/ros/stage/stage_graph.cpp").read_text(encoding="utf-8")
    return set(re.findall(r'StackPart::k\w+,\s*"(\w+)"', rows)) - {"stereo_image_proc"}


def reporting_nodes():
    """Returns the names of the nodes that report a status."""
    return {name for name, kind in launched_types().items() if kind not in WITHOUT_STATUS} | graph_stages()


def groups():
    """Returns the regular expressions of the groups of the diagnostics, by group."""
    text = (PACKAGE / "config/diagnostics/aggregator.yaml").read_text(encoding="utf-8")
    return {name: group["regex"] for name, group in yaml.safe_load(text)["analyzers"].items()}


def groups_of(status):
    """Returns the groups that list a status: as GenericAnalyzer, which compares the whole name."""
    return [name for name, expressions in groups().items()
            if any(re.fullmatch(expression, status) for expression in expressions)]


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

    def test_each_node_is_in_one_group_of_diagnostics_in_any_namespace(self):
        nodes = reporting_nodes()
        self.assertLess({"device", "cloud_to_scan", "grid_slam", "stack", "v2x_wire"}, nodes)
        for node in sorted(nodes):
            for namespace in ("", "car1/", "fleet/car1/"):
                with self.subTest(node=node, namespace=namespace):
                    self.assertEqual(len(groups_of(f"{namespace}{node}: stage")), 1)

    def test_groups_contain_nothing_but_nodes(self):
        listed = [name for expressions in groups().values() for expression in expressions
                  for name in GROUP.fullmatch(expression)[1].split("|")]
        self.assertEqual(sorted(listed), sorted(reporting_nodes()))
        self.assertEqual(groups_of("urg_node: Hokuyo Status"), [])
        self.assertEqual(groups_of("my_tracker: stage"), [])

    def test_all_nodelets_but_the_exempt_ones_report_a_status(self):
        kinds = set(launched_types().values())
        self.assertLessEqual(WITHOUT_STATUS, kinds)
        for kind in kinds:
            file = PACKAGE / f"src/nodelets/{kind}_nodelet.cpp"  # none: a stage, whose host reports
            reports = not file.exists() or re.search("StageReporter|Updater", file.read_text(encoding="utf-8"))
            self.assertEqual(bool(reports), kind not in WITHOUT_STATUS, kind)


if __name__ == "__main__":
    unittest.main()
