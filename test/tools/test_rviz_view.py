#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""config/perception.rviz shows what is published: each topic in it has a publisher, each namespace of
markers is one that is drawn, and each that is drawn is named, so that none is on by accident."""

import re
import unittest
from pathlib import Path

import yaml

PACKAGE = Path(__file__).resolve().parents[2]
VIEW = yaml.safe_load((PACKAGE / "config/perception.rviz").read_text(encoding="utf-8"))
DISPLAYS = VIEW["Visualization Manager"]["Displays"]
DEBUGGING = {"dropped labels", "intersection", "objects", "object bodies", "object heads",
             "road border sigmas", "track covariances", "track sensors"}

# Of the input: the stereo camera's nodelets or the bag.
INPUTS = {"/stereo/points2"}


def text_of(pattern):
    return "\n".join(path.read_text(encoding="utf-8") for path in sorted(PACKAGE.glob(pattern)))


def published():
    """Topics that nodelets advertise and stages declare, and those that perception.launch remaps theirs to."""
    topics = set(re.findall(r'advertise<[^>]+>\(\s*"([^"]+)"', text_of("src/nodelets/*")))
    topics |= set(re.findall(r'\.out<[^>]+>\(\s*"([^"]+)"', text_of("src/ros/stage/*_stage.cpp")))
    launch = text_of("launch/perception.launch")
    renamed = re.findall(r'<remap from="([^"]+)" to="([^"$]+)"', launch)
    topics |= {new for old, new in renamed if old in topics}
    return {f"/{topic}" for topic in topics} | INPUTS


def drawn():
    """The namespaces of the markers: those that are named, and those that shapes have two of."""
    code = text_of("src/ros/display/*marker*.cpp")
    made = re.findall(r'(?:makeMarker|outlineOf|groundOutline)\([^;"]*?"([^"]+)"', code)
    shapes = re.findall(r'shapeOf\([^;"]*?"([^"]+)"', code)
    return set(made) | {f"{shape} {part}" for shape in shapes for part in ("bodies", "heads")}


def topic_of(display):
    return next((display[key] for key in ("Topic", "Image Topic", "Marker Topic")
                 if key in display), None)


class RvizView(unittest.TestCase):
    def test_each_topic_is_published(self):
        topics = {topic_of(display) for display in DISPLAYS} - {None}
        self.assertGreater(len(topics), 8)
        self.assertLessEqual(topics, published())

    def test_the_namespaces_are_those_that_are_drawn(self):
        for display in DISPLAYS:
            if "Namespaces" in display:
                with self.subTest(display=display["Name"]):
                    self.assertEqual(set(display["Namespaces"]), drawn())

    def test_debugging_is_off(self):
        shown = {name for display in DISPLAYS if display["Enabled"]
                 for name, on in display.get("Namespaces", {}).items() if on}
        self.assertEqual(shown & DEBUGGING, set())
        self.assertLessEqual({"vehicle", "track bodies", "track labels", "ground truth"}, shown)

    def test_the_view_follows_the_vehicle_from_behind(self):
        view = VIEW["Visualization Manager"]["Views"]["Current"]
        self.assertEqual(view["Class"], "rviz/ThirdPersonFollower")
        self.assertEqual(view["Target Frame"], "base_link")
        self.assertAlmostEqual(view["Yaw"], 3.14159)

    def test_panels_of_images_have_their_places(self):
        state = bytes.fromhex(str(VIEW["Window Geometry"]["QMainWindow State"]))
        for display in DISPLAYS:
            if display["Class"] == "rviz/Image":
                self.assertIn(display["Name"].encode("utf-16-be"), state)


if __name__ == "__main__":
    unittest.main()
