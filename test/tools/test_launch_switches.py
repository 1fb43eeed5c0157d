#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""perception.launch and replay.launch in every combination of their switches: each nodelet is there
once, with a type that the package (or a named one) has, and subscribes to published topics."""

import functools
import itertools
import re
import unittest
from xml.etree import ElementTree

from launch_files import PACKAGE, load

ALWAYS = {"grid_slam", "motion", "moving_objects", "tracker", "markers", "stack"}
LOW_LEVEL = {"lidar_grid", "stereo_grid", "grid_fusion", "grid_views"}
OBJECT_LEVEL = {"stereo_objects", "object_fusion"}
TRACK_LEVEL = {"stereo_objects", "stereo_tracker", "track_fusion", "lidar_markers",
               "stereo_markers"}
ROAD_BORDER = {"road_border"}
IMAGES = {"none": set(),
          "rectified": {"camera_view", "stereo_image_proc", "stereo_points"},
          "raw": {"camera_view", "stereo_image_proc", "stereo_points", "left_debayer", "left_rectify",
                  "right_debayer", "right_rectify"}}


def combinations():
    """Returns (low_level_fusion, road_border, object_fusion, track_fusion, stereo_images)."""
    return itertools.product(*[[False, True]] * 4, IMAGES)


@functools.lru_cache(maxsize=None)
def loaded(file, **arguments):
    """Returns the nodes of a launch file, by name, and its parameters, by key."""
    words = [f"{key}:={str(value).lower() if isinstance(value, bool) else value}"
             for key, value in arguments.items()]
    config = load(file, words)
    return ({node.name: node for node in config.nodes},
            {key: parameter.value for key, parameter in config.params.items()})


def nodelets(nodes):
    """Returns their types, by name."""
    return {name: node.args.split()[1] for name, node in nodes.items()
            if node.args.startswith("load ")}


def remapped(node, topic):
    return dict(node.remap_args).get(topic, topic)


class LaunchSwitches(unittest.TestCase):
    @staticmethod
    def each(file, **more):
        """Yields (switches, nodes, parameters) of each combination."""
        for low_level, borders, objects, tracks, images in combinations():
            switches = {"low_level_fusion": low_level, "road_border": borders,
                        "object_fusion": objects, "track_fusion": tracks,
                        "stereo_images": images}
            yield (switches, *loaded(file, **switches, **more))

    def test_the_switches_select_the_nodelets(self):
        for switches, nodes, _ in self.each("perception.launch"):
            with self.subTest(**switches):
                expected = ALWAYS | IMAGES[switches["stereo_images"]]
                if switches["low_level_fusion"]:
                    expected |= LOW_LEVEL
                if switches["road_border"]:
                    expected |= ROAD_BORDER
                if switches["object_fusion"]:
                    expected |= OBJECT_LEVEL
                if switches["track_fusion"]:
                    expected |= TRACK_LEVEL
                if expected & {"stereo_grid", "stereo_objects"}:
                    expected |= {"stereo_alignment"}
                if switches["stereo_images"] != "none" and "stereo_objects" in expected:
                    expected |= {"point_velocity"}
                self.assertEqual(set(nodelets(nodes)), expected)

    def test_one_switch_sets_those_of_a_level(self):
        def level(**arguments):
            return set(nodelets(loaded("perception.launch", **arguments)[0]))
        self.assertEqual(level(fusion="none"), level())
        self.assertEqual(level(fusion="low"), level(low_level_fusion=True))
        self.assertEqual(level(fusion="object"), level(object_fusion=True))
        self.assertEqual(level(fusion="track"), level(track_fusion=True))
        self.assertEqual(level(fusion="recommended"), level(track_fusion=True, road_border=True))
        self.assertEqual(level(fusion="low", track_fusion=True),
                         level(low_level_fusion=True, track_fusion=True))

    def test_all_types_are_in_the_package(self):
        classes = ElementTree.parse(PACKAGE / "nodelets.xml").getroot()
        known = {each.get("name") for each in classes.iter("class")}
        for switches, nodes, _ in self.each("perception.launch"):
            with self.subTest(**switches):
                kinds = nodelets(nodes).values()
                ours = {kind for kind in kinds if kind.startswith("datmo_fusion/")}
                self.assertLessEqual(ours, known)

    def test_no_test_has_the_name_of_a_node_that_it_starts(self):
        """A test is also a node of that name: of two nodes with one name
        the master ends the first."""
        for file in sorted((PACKAGE / "test/nodelets").glob("*.test")):
            root = ElementTree.parse(file)
            nodes = {node.get("name") for node in root.iter("node")}
            for include in root.iter("include"):
                started = PACKAGE / include.get("file").split("/", 1)[1]
                nodes |= {node.get("name") for node in ElementTree.parse(started).iter("node")}
            names = {test.get("test-name") for test in root.iter("test")}
            self.assertTrue(names, file)
            self.assertFalse(names & nodes, file)

    def test_the_demos_build_all_their_nodes(self):
        started = {node.get("type") for file in (PACKAGE / "launch").glob("*.launch")
                   for node in ElementTree.parse(file).getroot().iter("node")
                   if node.get("pkg") == "datmo_fusion"}
        compiled = {name for name in started if not (PACKAGE / "tools/launch" / name).is_file()}
        rules = (PACKAGE / "tools/CMakeLists.txt").read_text()
        built = set(re.search(r"add_dependencies\(live ([^)]+)\)", rules)[1].split())
        self.assertIn("load_nodelet", compiled)
        self.assertLessEqual(compiled, built)
        for demo in ("demo", "risk_demo"):
            self.assertRegex((PACKAGE / "scripts" / demo).read_text(), r'scripts/build" .*\blive\b')

    def test_moving_objects_subscribes_to_borders_if_enabled(self):
        for switches, _, parameters in self.each("perception.launch"):
            with self.subTest(**switches):
                self.assertIs(parameters["/moving_objects/road_borders"], switches["road_border"])

    def test_tracker_and_markers_subscribe_to_published_topics(self):
        for switches, nodes, _ in self.each("perception.launch"):
            with self.subTest(**switches):
                source = "objects/fused" if switches["object_fusion"] else "objects"
                self.assertEqual(remapped(nodes["tracker"], "objects"), source)
                self.assertEqual(remapped(nodes["tracker"], "early_objects"), "objects/early")
                self.assertEqual(remapped(nodes["markers"], "objects"), source)
                if switches["object_fusion"]:
                    self.assertEqual(remapped(nodes["object_fusion"], "objects/lidar"), "objects")

    def test_the_tracks_of_the_stack_are_those_of_its_last_stage(self):
        for switches, nodes, _ in self.each("perception.launch"):
            with self.subTest(**switches):
                published = [remapped(nodes["tracker"], "tracks")]
                if switches["track_fusion"]:
                    published.append(remapped(nodes["stereo_tracker"], "tracks"))
                    published.append(remapped(nodes["track_fusion"], "tracks/fused"))
                    self.assertEqual(published[:-1], ["tracks/lidar", "tracks/stereo"])
                self.assertEqual(published[-1], "tracks")
                self.assertEqual(remapped(nodes["markers"], "tracks"), "tracks")

    def test_the_stereo_tracker_tracks_the_cameras_objects(self):
        for switches, nodes, parameters in self.each("perception.launch"):
            if switches["track_fusion"]:
                with self.subTest(**switches):
                    self.assertEqual(remapped(nodes["stereo_tracker"], "objects"),
                                     "objects/stereo")
                    self.assertIs(parameters["/stereo_tracker/scan_view"], False)
                    self.assertNotIn("/tracker/scan_view", parameters)

    def test_each_source_is_drawn_by_itself(self):
        for switches, nodes, _ in self.each("perception.launch"):
            if switches["track_fusion"]:
                with self.subTest(**switches):
                    drawn = {remapped(nodes[name], "markers"): remapped(nodes[name], "tracks")
                             for name in ("markers", "lidar_markers", "stereo_markers")}
                    self.assertEqual(drawn, {"markers": "tracks",
                                             "markers/lidar": "tracks/lidar",
                                             "markers/stereo": "tracks/stereo"})
                    for name, of in (("lidar_markers", "tracker"),
                                     ("stereo_markers", "stereo_tracker")):
                        self.assertEqual(remapped(nodes[name], "objects"),
                                         remapped(nodes[of], "objects"))

    def test_both_levels_use_the_same_points(self):
        nodes, _ = loaded("perception.launch", low_level_fusion=True, object_fusion=True,
                          points2="cloud", right_camera_info="info")
        for name in ("stereo_alignment", "stereo_grid", "stereo_objects"):
            self.assertEqual(remapped(nodes[name], "points2"), "cloud")
            self.assertEqual(remapped(nodes[name], "right/camera_info"), "info")

    def test_a_cloud_takes_the_place_of_the_scan(self):
        nodes, _ = loaded("perception.launch", low_level_fusion=True, cloud="/velodyne_points")
        self.assertEqual(remapped(nodes["cloud_to_scan"], "cloud"), "/velodyne_points")
        for name in ("cloud_to_scan", "grid_slam", "lidar_grid", "stereo_alignment"):
            self.assertEqual(remapped(nodes[name], "scan"), "cloud_scan")
        self.assertEqual(nodelets(nodes)["cloud_to_scan"], "datmo_fusion/cloud_to_scan")

    def test_another_system_may_publish_the_stereo_objects(self):
        for level, members in (("object_fusion", OBJECT_LEVEL),
                                      ("track_fusion", TRACK_LEVEL)):
            with self.subTest(level=level):
                nodes, _ = loaded("perception.launch", **{level: True}, stereo_objects=False)
                self.assertEqual(set(nodelets(nodes)),
                                 ALWAYS | members - {"stereo_objects"})

    def test_risk_adds_one_nodelet(self):
        for borders in (False, True):
            nodes, parameters = loaded("perception.launch", risk=True, road_border=borders,
                                       odometry="/odom")
            self.assertEqual(nodelets(nodes)["risk"], "datmo_fusion/risk")
            self.assertEqual(remapped(nodes["risk"], "odometry"), "/odom")
            self.assertIs(parameters["/risk/road_borders"], borders)

    def test_mono_fuses_the_objects_of_scanner_and_image(self):
        for objects in (False, True):
            with self.subTest(object_fusion=objects):
                nodes, parameters = loaded("perception.launch", mono=True, object_fusion=objects,
                                           camera_image="view", camera_info="view_info")
                expected = ALWAYS | {"mono_classifier", "object_fusion", "camera_view"}
                self.assertEqual(set(nodelets(nodes)), expected | (
                    OBJECT_LEVEL | {"stereo_alignment"} if objects else set()))
                self.assertEqual(remapped(nodes["mono_classifier"], "image"), "view")
                self.assertEqual(remapped(nodes["mono_classifier"], "camera_info"), "view_info")
                self.assertEqual(remapped(nodes["tracker"], "objects"), "objects/fused")
                self.assertIs(parameters["/object_fusion/sources/mono/use"], True)
                self.assertIs(parameters.get("/object_fusion/sources/stereo/use", True), objects)

    def test_a_radar_is_one_more_source_of_objects(self):
        for objects in (False, True):
            with self.subTest(object_fusion=objects):
                nodes, parameters = loaded("perception.launch", radar=True, object_fusion=objects,
                                           radar_scan="/radar_front", odometry="/odom")
                self.assertEqual(set(nodelets(nodes)), ALWAYS | {"radar_objects", "object_fusion"} | (
                    OBJECT_LEVEL | {"stereo_alignment"} if objects else set()))
                self.assertEqual(remapped(nodes["radar_objects"], "radar"), "/radar_front")
                self.assertEqual(remapped(nodes["radar_objects"], "odometry"), "/odom")
                self.assertEqual(remapped(nodes["tracker"], "objects"), "objects/fused")
                self.assertIs(parameters["/object_fusion/sources/radar/use"], True)
                self.assertIs(parameters.get("/object_fusion/sources/stereo/use", True), objects)

    def test_mono_with_grids_is_one_more_grid(self):
        nodes, parameters = loaded("perception.launch", mono=True, low_level_fusion=True,
                                   camera_image="view", camera_info="view_info",
                                   cloud="/velodyne_points")
        self.assertEqual(nodelets(nodes)["mono_grid"], "datmo_fusion/mono_grid")
        for topic, name in (("image", "view"), ("camera_info", "view_info"), ("scan", "cloud_scan")):
            self.assertEqual(remapped(nodes["mono_grid"], topic), name)
        self.assertIs(parameters["/grid_fusion/sources/mono/use"], True)
        without, parameters = loaded("perception.launch", low_level_fusion=True)
        self.assertNotIn("mono_grid", without)
        self.assertNotIn("/grid_fusion/sources/mono/use", parameters)

    def test_map_fusion_takes_the_grids_of_single_sensors(self):
        nodes, parameters = loaded("perception.launch", map_fusion=True, map="/tmp/hall.map",
                                   odometry="/odom", mono=True)
        present = {"lidar_grid", "stereo_grid", "mono_grid", "stereo_alignment", "map_fusion"}
        self.assertLessEqual(present, set(nodelets(nodes)))
        self.assertNotIn("grid_fusion", nodes)
        self.assertIs(parameters["/grid_slam/fused_grid"], False)
        self.assertEqual(remapped(nodes["map_fusion"], "odometry"), "/odom")
        self.assertEqual(parameters["/map_fusion/prior_map"], "/tmp/hall.map")
        self.assertIs(parameters["/map_fusion/sources/mono/use"], True)
        nodes, parameters = loaded("perception.launch", map="/tmp/hall.map")
        self.assertNotIn("map_fusion", nodes)
        self.assertNotIn("/map_fusion/prior_map", parameters)

    def test_there_is_a_thread_for_each_nodelet(self):
        for switches, nodes, parameters in self.each("perception.launch"):
            with self.subTest(**switches):
                self.assertGreaterEqual(parameters["/perception/num_worker_threads"],
                                        len(nodelets(nodes)))

    def test_nothing_of_an_earlier_sensor_set_stays(self):
        for file in ("perception.launch", "part.launch", "stereo_images.launch"):
            for tag in ElementTree.parse(PACKAGE / "launch" / file).getroot().iter("node"):
                if tag.get("name") != "rviz":
                    self.assertEqual(tag.get("clear_params"), "true", tag.get("name"))

    def test_replay_passes_topics_and_configuration_on(self):
        nodes, parameters = loaded("replay.launch", bag="a.bag", rviz=False, odometry="/odom",
                                   config=PACKAGE / "config" / "indoor.yaml")
        self.assertEqual(remapped(nodes["grid_slam"], "odometry"), "/odom")
        self.assertEqual(parameters["/perception/configuration"].strip(),
                         str(PACKAGE / "config" / "indoor.yaml"))

    def test_replay_passes_the_switches_on(self):
        for switches, nodes, _ in self.each("replay.launch", bag="a.bag", rviz=False):
            with self.subTest(**switches):
                alone, _ = loaded("perception.launch", **switches)
                self.assertEqual(nodelets(nodes), nodelets(alone))


if __name__ == "__main__":
    unittest.main()
