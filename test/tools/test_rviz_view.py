#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""config/perception.rviz shows what is published: each topic in it has a publisher, each namespace
of markers in it is drawn, and each one that is drawn is in it, so that none is on by accident."""

import contextlib
import io
import os
import re
import shlex
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from unittest import mock

import yaml
from launch_files import PACKAGE, load

from datmo_tools import open_rviz
from datmo_tools.errors import InputError

FILE = str(PACKAGE / "config/perception.rviz")


def read(file):
    return yaml.safe_load(Path(file).read_text(encoding="utf-8"))


VIEW = read(FILE)
DISPLAYS = VIEW["Visualization Manager"]["Displays"]
# What our own displays draw, or what is for debugging.
OFF = {"vehicle", "dropped labels", "intersection", "objects", "object bodies", "object heads", "road borders",
       "road border sigmas", "track covariances", "track sensors", "track bodies", "track labels",
       "track paths", "host tube", "contacts", "contact labels", "risk level"}
PLUGINS = {each.get("name") for each in
           ElementTree.parse(PACKAGE / "rviz_plugins.xml").getroot().iter("class")}

# Inputs: from the stereo camera's nodelets or the bag.
INPUTS = {"/stereo/points2"}


def text_of(pattern):
    return "\n".join(path.read_text(encoding="utf-8") for path in sorted(PACKAGE.glob(pattern)))


def published():
    """Returns the topics that nodelets advertise and stages declare, and those to which
    perception.launch remaps them."""
    topics = set(re.findall(r'advertise<[^>]+>\(\s*"([^"]+)"', text_of("src/nodelets/*")))
    topics |= set(re.findall(r'\.out<[^>]+>\(\s*"([^"]+)"', text_of("src/ros/stage/*_stage.cpp")))
    launch = text_of("launch/perception.launch")
    renamed = re.findall(r'<remap from="([^"]+)" to="([^"$]+)"', launch)
    topics |= {new for old, new in renamed if old in topics}
    return {f"/{topic}" for topic in topics} | INPUTS


def drawn():
    """Returns the namespaces of the markers: the named ones, and those of shapes with two."""
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

    def test_the_namespaces_are_the_drawn_ones(self):
        for display in DISPLAYS:
            if "Namespaces" in display:
                with self.subTest(display=display["Name"]):
                    self.assertEqual(set(display["Namespaces"]), drawn())

    def test_nothing_is_drawn_twice_and_debugging_is_off(self):
        shown = {name for display in DISPLAYS if display["Enabled"]
                 for name, on in display.get("Namespaces", {}).items() if on}
        self.assertEqual(shown & OFF, set())
        self.assertLessEqual({"scan", "ground truth"}, shown)

    def test_our_displays_and_panels_exist(self):
        for name in ("perception.rviz", "risk.rviz"):
            view = yaml.safe_load((PACKAGE / "config" / name).read_text(encoding="utf-8"))
            classes = {each["Class"] for each in
                       view["Panels"] + view["Visualization Manager"]["Displays"]}
            ours = {each for each in classes if each.startswith("datmo_fusion/")}
            self.assertLessEqual(ours, PLUGINS)
            self.assertLessEqual({"datmo_fusion/Tracks", "datmo_fusion/Risk",
                                  "datmo_fusion/DriverView", "datmo_fusion/Sources"}, ours)
            self.assertLessEqual({topic_of(each) for each in
                                  view["Visualization Manager"]["Displays"]} - {None}, published())

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
        for panel in VIEW["Panels"]:
            self.assertIn(panel["Name"].encode("utf-16-be"), state)


class ViewOfAVehicle(unittest.TestCase):
    """One of several vehicles on one master."""

    def vehicle_view(self, prefix, namespace, **shown):
        """Returns the configuration that open_rviz shows."""
        environment = {"ROS_HOME": self.home, "ROS_NAMESPACE": namespace}
        with mock.patch.dict(os.environ, environment):
            return open_rviz.vehicle_view(FILE, prefix, shown)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = folder.name

    def test_for_a_single_vehicle_it_is_the_file_itself(self):
        for namespace in ("", "/"):
            self.assertEqual(self.vehicle_view("", namespace), FILE)

    def test_frames_have_the_prefix_and_topics_are_in_the_namespace(self):
        view = read(self.vehicle_view("car1/", "/car1/"))
        manager = view["Visualization Manager"]
        self.assertEqual(manager["Global Options"]["Fixed Frame"], "car1/map")
        for each in (manager["Views"]["Current"], *manager["Views"]["Saved"]):
            self.assertEqual(each["Target Frame"], "car1/base_link")
        self.assertEqual([topic_of(each) for each in manager["Displays"]],
                         [topic_of(each) and "/car1" + topic_of(each) for each in DISPLAYS])
        panel = next(each for each in view["Panels"] if each["Class"] == "datmo_fusion/DriverView")
        self.assertEqual((panel["Risks Topic"], panel["Tracks Topic"]), ("/car1/risks", "/car1/tracks"))

    def test_everything_else_is_unchanged(self):
        text = Path(self.vehicle_view("car1/", "/car1")).read_text(encoding="utf-8")
        view = yaml.safe_load(text.replace("/car1/", "/").replace("car1/", ""))
        self.assertEqual(view, VIEW)

    def test_a_namespace_or_a_prefix_alone(self):
        options = read(self.vehicle_view("car1/", ""))["Visualization Manager"]
        self.assertEqual(options["Global Options"]["Fixed Frame"], "car1/map")
        self.assertIn("/tracks", {topic_of(each) for each in options["Displays"]})
        options = read(self.vehicle_view("", "/fleet/car2"))["Visualization Manager"]
        self.assertEqual(options["Global Options"]["Fixed Frame"], "map")
        self.assertIn("/fleet/car2/tracks", {topic_of(each) for each in options["Displays"]})

    def test_each_vehicle_has_a_view_of_its_own(self):
        self.assertEqual(len({self.vehicle_view(prefix, namespace) for prefix, namespace in
                              (("car1/", "/car1"), ("car2/", "/car2"), ("", "/car3"), ("car4/", ""))}), 4)

    def test_an_invalid_view_is_named(self):
        file = Path(self.home, "a.rviz")
        for text, problem in (("a: [", "expected yaml"), ("a: &a [*a]", "expected yaml"), ("3", "expected an rviz")):
            file.write_text(text)
            said = io.StringIO()
            with mock.patch.object(open_rviz, "display_opens", lambda: True), contextlib.redirect_stderr(said), \
                    mock.patch.object(sys, "argv", ["open_rviz", "--frame-prefix", "car1/", "-d", str(file)]):  # fmt: skip
                self.assertEqual(open_rviz.main(), 1)
            self.assertRegex(said.getvalue(), f"open_rviz: {file}.*{problem}")

    def test_the_launch_file_passes_the_prefix_on(self):
        nodes = load("live.launch", ["rviz:=true", "frame_prefix:=car1/"]).nodes
        words = shlex.split(next(node.args for node in nodes if node.name == "rviz"))
        self.assertEqual(words, ["--frame-prefix", "car1/", "-d", FILE])
        nodes = load("live.launch", ["rviz:=true"]).nodes
        words = shlex.split(next(node.args for node in nodes if node.name == "rviz"))
        self.assertEqual(words, ["--frame-prefix", "", "-d", FILE])

    def test_the_camera_is_shown_if_there_is_a_camera_view(self):
        nodes = load("perception.launch", ["rviz:=true", "mono:=true"]).nodes
        words = shlex.split(next(node.args for node in nodes if node.name == "rviz"))
        self.assertEqual(words, ["--frame-prefix", "", "--show", "Camera", "-d", FILE])

    def test_a_panel_is_shown_by_its_display_and_in_the_state_of_the_window(self):
        for shown in (True, False):
            view = read(self.vehicle_view("", "", Camera=shown))
            camera = next(each for each in view["Visualization Manager"]["Displays"] if each["Name"] == "Camera")
            self.assertEqual(camera["Enabled"], shown)
            state = bytes.fromhex(str(view["Window Geometry"]["QMainWindow State"]))
            self.assertIn("Camera".encode("utf-16-be") + bytes([shown]), state)
            self.assertEqual(len(state), len(bytes.fromhex(str(VIEW["Window Geometry"]["QMainWindow State"]))))
        self.assertEqual(view, VIEW, "hidden, as it is shipped")

    def test_a_panel_that_is_none_is_refused(self):
        for name in ("Camra", "Risk"):
            with self.assertRaisesRegex(InputError, f"'{name}': no panel"):
                self.vehicle_view("", "", **{name: True})


if __name__ == "__main__":
    unittest.main()
