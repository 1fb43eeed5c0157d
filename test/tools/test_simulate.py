#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The simulator as a program: exit codes, messages, and bags that are identical byte for byte."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag

SIMULATE = os.environ["DATMO_FUSION_SIMULATE"]
FIXTURES = Path(__file__).resolve().parents[2] / "rosbag_fixtures"
SCENE = FIXTURES / "scenes" / "intersection.yaml"


class Simulate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bag = self.folder / "out.bag"

    def run_tool(self, *arguments):
        return subprocess.run([SIMULATE, *map(str, arguments)], stderr=subprocess.PIPE,
                              stdout=subprocess.PIPE, universal_newlines=True)

    def simulate(self, *options):
        done = self.run_tool(SCENE, self.bag, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return self.bag.read_bytes()

    def assert_refused(self, *arguments, expected):
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 1)
        for part in expected:
            self.assertIn(part, done.stderr)
        self.assertEqual([path.suffix for path in self.folder.iterdir()
                          if path.suffix != ".yaml"], [])

    def test_committed_bag_is_what_the_scene_makes(self):
        self.assertTrue(self.simulate() == (FIXTURES / "intersection.bag").read_bytes(),
                        "make it again as rosbag_fixtures/README.md says")

    def test_same_seed_same_bytes_and_other_seed_others(self):
        short = ["--set", "duration=2", "--seed"]
        first = self.simulate(*short, 5)
        self.assertTrue(first == self.simulate(*short, 5))
        self.assertFalse(first == self.simulate(*short, 6))

    def test_one_echo_is_a_laser_scan_at_the_given_resolution(self):
        self.simulate("--set", "duration=1", "--set", "scanner/echoes=1",
                      "--set", "scanner/beam_spacing=1.0")
        with rosbag.Bag(str(self.bag)) as bag:
            scans = [message for _, message, _ in bag.read_messages("/scan")]
        self.assertEqual(len(scans), 17)
        self.assertEqual(len(scans[0].ranges), 161)

    def test_unknown_option_and_bad_value(self):
        self.assert_refused(SCENE, self.bag, "--set", "scanner/range_noize=1",
                            expected=["intersection.yaml", "scanner/range_noize", "range_noise"])
        self.assert_refused(SCENE, self.bag, "--set", "scanner/range_noise=-1",
                            expected=["intersection.yaml", "scanner/range_noise = -1",
                                      "expected a number from 0"])
        self.assert_refused(SCENE, self.bag, "--seed", "x", expected=["seed = 'x'"])

    def test_bad_scene(self):
        scene = self.folder / "bad.yaml"
        scene.write_text("roads: 3\nego: {}\n")
        self.assert_refused(scene, self.bag, expected=["bad.yaml: roads: expected a list"])
        self.assert_refused(self.folder / "none.yaml", self.bag, expected=["none.yaml"])

    def test_bag_that_cannot_be_written(self):
        self.assert_refused(SCENE, self.folder / "none" / "out.bag", expected=["none/out.bag"])

    def test_scene_is_not_overwritten(self):
        scene = self.folder / "scene.yaml"
        scene.write_text("ego: {}\n")
        self.assert_refused(scene, self.folder / "." / "scene.yaml", expected=["scene.yaml"])
        self.assertEqual(scene.read_text(), "ego: {}\n")

    def test_folders(self):
        self.assert_refused(self.folder, self.bag, expected=[f"{self.folder}: expected a yaml"])
        self.assert_refused(SCENE, self.folder, expected=[f"{self.folder}: is a folder"])

    def test_key_that_is_not_a_name(self):
        scene = self.folder / "bad.yaml"
        scene.write_text("ego: {}\n? [a]\n: b\n")
        self.assert_refused(scene, self.bag, expected=["bad.yaml: a key in line 2"])

    def test_wrong_usage(self):
        self.assert_refused(SCENE, expected=["1 files are given: expected SCENE.yaml OUT.bag"])
        self.assert_refused(SCENE, self.bag, "--fast", expected=["--fast"])


class Contract(unittest.TestCase):
    """Properties of the committed bag that its users rely on."""

    @classmethod
    def setUpClass(cls):
        cls.messages = {}
        with rosbag.Bag(str(FIXTURES / "intersection.bag")) as bag:
            for topic, message, time in bag.read_messages():
                cls.messages.setdefault(topic, []).append((message, time))
            cls.latched = [c.header for c in bag._get_connections()
                           if c.topic == "/tf_static"][0].get("latching")

    def test_topics(self):
        self.assertEqual(sorted(self.messages), [
            "/echoes", "/ground_truth/objects", "/ground_truth/pose",
            "/ground_truth/road_borders", "/odometry", "/tf", "/tf_static"])
        self.assertEqual(self.latched, b"1")

    def test_record_times_are_stamps(self):
        for topic in ("/echoes", "/ground_truth/objects", "/ground_truth/pose", "/odometry"):
            for message, time in self.messages[topic]:
                self.assertEqual(message.header.stamp, time)

    def test_truth_has_the_scans_stamps(self):
        stamps = [time for _, time in self.messages["/echoes"]]
        for topic in ("/ground_truth/objects", "/ground_truth/pose"):
            self.assertEqual([time for _, time in self.messages[topic]], stamps)

    def test_map_starts_at_the_vehicle(self):
        pose = self.messages["/ground_truth/pose"][0][0].pose.pose
        self.assertEqual((pose.position.x, pose.position.y, pose.orientation.w), (0.0, 0.0, 1.0))

    def test_velocity_is_the_change_of_position(self):
        # Up to 5 cm per scan in a turn, and only if an object keeps its motion.
        last = {}
        checked = 0
        for message, time in self.messages["/ground_truth/objects"]:
            for item in message.objects:
                position = (item.pose.position.x, item.pose.position.y)
                if item.id in last and (time - last[item.id][1]).to_sec() < 0.07:
                    seconds = (time - last[item.id][1]).to_sec()
                    before = last[item.id][0]
                    self.assertAlmostEqual(position[0], before[0] + seconds * item.velocity.x,
                                           delta=0.05)
                    self.assertAlmostEqual(position[1], before[1] + seconds * item.velocity.y,
                                           delta=0.05)
                    checked += item.moving
                last[item.id] = (position, time)
        self.assertGreater(checked, 500)

    def test_echoes_are_ordered_and_in_range(self):
        for message, _ in self.messages["/echoes"]:
            self.assertEqual(len(message.ranges), 81)
            for beam in message.ranges:
                echoes = list(beam.echoes)
                self.assertEqual(echoes, sorted(echoes))
                for echo in echoes:
                    self.assertTrue(message.range_min <= echo <= message.range_max)


class Stereo(unittest.TestCase):
    """Writes a bag with the stereo camera and the true echoes beside one without."""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.without = cls.simulated(Path(folder) / "without.bag")
            cls.messages = cls.simulated(
                Path(folder) / "with.bag", "--set", "stereo/enabled=true",
                "--set", "ground_truth/echoes=true")

    @staticmethod
    def simulated(bag, *options):
        """Returns a dictionary topic -> list of (message, record time)."""
        subprocess.run([SIMULATE, SCENE, bag, "--quiet", "--set", "duration=2", *options],
                       check=True)
        messages = {}
        with rosbag.Bag(str(bag)) as opened:
            for topic, message, time in opened.read_messages():
                messages.setdefault(topic, []).append((message, time))
        return messages

    def test_further_topics(self):
        self.assertEqual(sorted(set(self.messages) - set(self.without)), [
            "/ground_truth/echoes", "/stereo/left/camera_info", "/stereo/point_velocities",
            "/stereo/points2", "/stereo/right/camera_info"])

    def test_other_sensors_measure_the_same(self):
        for topic in ("/echoes", "/odometry", "/tf", "/ground_truth/pose"):
            self.assertEqual(self.messages[topic], self.without[topic], topic)

    def test_points(self):
        clouds = self.messages["/stereo/points2"]
        self.assertEqual(len(clouds), 24)
        for cloud, time in clouds:
            self.assertAlmostEqual((time - cloud.header.stamp).to_sec(), 0.05)
            self.assertEqual(cloud.header.frame_id, "stereo_left_optical")
            self.assertEqual([field.name for field in cloud.fields], ["x", "y", "z"])
            self.assertEqual((cloud.height, cloud.point_step), (1, 12))
            points = np.frombuffer(cloud.data, np.float32).reshape(-1, 3)
            self.assertEqual(len(points), cloud.width)
            self.assertGreater(len(points), 20000)
            self.assertTrue(np.all((points[:, 2] > 2.999) & (points[:, 2] < 60.001)))

    def test_points_with_velocity_precede_the_points(self):
        clouds = self.messages["/stereo/point_velocities"]
        self.assertEqual([(message.header.stamp, time) for message, time in clouds],
                         [(message.header.stamp, time)
                          for message, time in self.messages["/stereo/points2"]])
        self.assertEqual(clouds[0][0].width, 0)
        for cloud, _ in clouds[1:]:
            self.assertEqual(cloud.header.frame_id, "base_link")
            self.assertGreater(cloud.width, 50)

    def test_camera_infos_have_the_geometry(self):
        for (left, _), (right, _), (cloud, _) in zip(*(self.messages[topic] for topic in (
                "/stereo/left/camera_info", "/stereo/right/camera_info", "/stereo/points2"))):
            self.assertEqual(left.header, right.header)
            self.assertEqual((left.header.stamp, left.header.frame_id),
                             (cloud.header.stamp, cloud.header.frame_id))
            self.assertEqual((left.P[0], left.P[3]), (380.0, 0.0))
            self.assertAlmostEqual(right.P[3], -380.0 * 0.34)

    def test_mount(self):
        (mounts, _), = self.messages["/tf_static"]
        camera, = [mount for mount in mounts.transforms
                   if mount.child_frame_id == "stereo_left_optical"]
        self.assertEqual(camera.header.frame_id, "base_link")
        position, turn = camera.transform.translation, camera.transform.rotation
        self.assertEqual((position.x, position.y, position.z), (1.8, 0.17, 1.3))
        self.assertEqual((turn.x, turn.y, turn.z, turn.w), (-0.5, 0.5, -0.5, 0.5))

    def test_truth_names_the_camera(self):
        seen = [item for message, _ in self.messages["/ground_truth/objects"]
                for item in message.objects if "stereo" in item.visible_to]
        self.assertGreater(len(seen), 100)

    def test_true_echoes_accompany_the_scans(self):
        pairs = list(zip(self.messages["/echoes"], self.messages["/ground_truth/echoes"]))
        self.assertEqual(len(pairs), len(self.messages["/ground_truth/echoes"]))
        for (scan, _), (truth, _) in pairs:
            self.assertEqual((truth.header.stamp, truth.header.frame_id),
                             (scan.header.stamp, scan.header.frame_id))
            for beam, surface, true_range in zip(scan.ranges, truth.surfaces, truth.ranges):
                self.assertEqual(surface == truth.NOTHING, not beam.echoes)
                if beam.echoes:
                    self.assertAlmostEqual(beam.echoes[0], true_range, delta=1.0)


if __name__ == "__main__":
    unittest.main()
