#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""clouds_to_scans: a bag with clouds of a 3D lidar in, one with planar scans out."""

import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag
import rospy
from datmo_tools.convert import kitti_messages
from datmo_tools.bag_messages import transform
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

PROGRAM = os.environ.get("DATMO_FUSION_CLOUDS_TO_SCANS", "clouds_to_scans")
CLOUDS = 3
PERIOD = 100_000_000  # ns
START = 100_000_000_000  # ns
HEIGHT = 1.73  # m, of the lidar

# A scan of 91 beams, 2 degrees apart, to the right; the lidar turns in 0.1 s and looks ahead at the
# stamp.
CONFIG = f"""\
cloud_to_scan:
  beam_spacing: {math.radians(2.0)}
  field_of_view: {math.pi}
  sweep: {{duration: 0.1, clockwise: true, first_bearing: {math.pi}, stamp_share: 0.5}}
"""


def cloud():
    """A flat road, and a wall 10 m ahead of the lidar, 4 m wide and 2 m high (n x 4, m)."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(3, 25, 0.4), np.arange(-9, 9, 0.4)))
    road = np.column_stack([x, y, np.full(len(x), -HEIGHT)])
    # All directions are seen, far above the band.
    bearing = np.radians(np.arange(-95.0, 95.0, 0.5))
    sky = np.column_stack([20 * np.cos(bearing), 20 * np.sin(bearing), np.full(len(bearing), 2.0)])
    across, up = (
        axis.ravel() for axis in np.meshgrid(np.arange(-2, 2, 0.05), np.arange(-1.7, 0.3, 0.2))
    )
    wall = np.column_stack([np.full(len(across), 10.0), across, up])
    points = np.vstack([road, sky, wall])
    return np.column_stack([points, np.zeros(len(points))]).astype(np.float32)


class CloudsToScans(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.input, self.output = self.folder / "in.bag", self.folder / "out.bag"
        self.config = self.folder / "set.yaml"
        self.config.write_text(CONFIG)

    def write(self, points=None, mount=True, topic="/cloud"):
        points = cloud() if points is None else points
        with rosbag.Bag(str(self.input), "w") as bag:
            for i in range(CLOUDS):
                stamp = START + i * PERIOD
                time = rospy.Time(0, 0) + rospy.Duration(stamp // 10**9, stamp % 10**9)
                bag.write("/odometry", Odometry(), time)
                bag.write(topic, kitti_messages.point_cloud(stamp, points), time)
            if mount:  # after the clouds: its position in a bag does not matter
                velodyne = np.eye(4)
                velodyne[:3, 3] = (0.8, 0.0, HEIGHT)
                message = transform(START, "base_link", "velodyne", velodyne, (0, 0, 0, 1))
                bag.write("/tf_static", TFMessage([message]), time)

    def run_program(self, *words, expected_code=0):
        given = words or (str(self.input), str(self.output), "--config", str(self.config))
        done = subprocess.run(
            [PROGRAM, *given], capture_output=True, encoding="utf-8", check=False
        )
        self.assertEqual(done.returncode, expected_code, done.stderr)
        self.assertEqual(self.output.exists(), expected_code == 0 and "--help" not in given)
        return done.stdout + done.stderr

    def messages(self, topic):
        with rosbag.Bag(str(self.output)) as bag:
            return [(message, time) for _, message, time in bag.read_messages([topic])]

    def test_scans_take_the_place_of_clouds(self):
        self.write()
        self.assertIn("3 scans, 0 clouds dropped", self.run_program())
        self.assertEqual(len(self.messages("/scan")), CLOUDS)
        self.assertEqual(len(self.messages("/odometry")), CLOUDS)
        self.assertEqual(self.messages("/cloud"), [])
        scan, _ = self.messages("/scan")[0]
        self.assertEqual(len(scan.ranges), 91)
        self.assertAlmostEqual(scan.ranges[45], 10.0, places=3)
        for beam, bearing in ((40, 10.0), (50, -10.0)):  # a beam has the nearest point in it
            expected = 10.0 / math.cos(math.radians(bearing))
            self.assertAlmostEqual(scan.ranges[beam], expected, delta=0.05)
        self.assertTrue(all(math.isinf(scan.ranges[beam]) for beam in (10, 30, 60, 80)))

    def test_every_beam_has_its_own_time(self):
        """Half a turn, 50 ms, about the stamp; recorded when the last beam is there."""
        self.write()
        self.run_program()
        scan, recorded = self.messages("/scan")[1]
        stamp = START + PERIOD
        self.assertAlmostEqual(scan.header.stamp.to_nsec(), stamp - 25_000_000, delta=1000)
        self.assertAlmostEqual(90 * scan.time_increment, 0.05, places=6)
        self.assertAlmostEqual(recorded.to_nsec(), stamp + 25_000_000, delta=1000)

    def test_the_mount_is_written(self):
        self.write()
        self.run_program()
        mounts = {
            mount.child_frame_id: mount.transform.translation
            for message, _ in self.messages("/tf_static")
            for mount in message.transforms
        }
        scanner = mounts["cloud_scan"]
        self.assertAlmostEqual(scanner.x, 0.8, places=6)
        self.assertAlmostEqual(scanner.z, 0.6, places=6)

    def test_other_topics_and_clouds_kept(self):
        self.write(topic="/points")
        words = (str(self.input), str(self.output), "--config", str(self.config))
        self.assertIn("no PointCloud2 on /cloud", self.run_program(*words, expected_code=1))
        self.run_program(*words, "cloud:=points", "scan:=/front", "--keep-clouds")
        self.assertEqual(len(self.messages("/front")), CLOUDS)
        self.assertEqual(len(self.messages("/points")), CLOUDS)

    def test_the_same_input_gives_the_same_scans(self):
        self.write()
        self.run_program()
        first = [message.ranges for message, _ in self.messages("/scan")]
        self.run_program()
        self.assertEqual(first, [message.ranges for message, _ in self.messages("/scan")])

    def test_nothing_usable(self):
        self.write(mount=False)
        self.assertIn("none of 3 clouds", self.run_program(expected_code=2))
        self.write(points=np.full((5, 4), np.nan, np.float32))
        self.assertIn("none of 3 clouds", self.run_program(expected_code=2))

    def test_wrong_command_lines(self):
        self.write()
        good = [str(self.input), str(self.output), "--config", str(self.config)]
        for words, said in (
            (good[:2], "2 bags are given: expected IN.bag OUT.bag --config"),
            ([*good, "--fast"], "--fast"),
            ([good[0], good[0], *good[2:]], "the output must not be the input"),
            ([str(self.folder / "no.bag"), *good[1:]], "no.bag"),
            ([*good[:3], str(self.folder / "no.yaml")], "no.yaml"),
        ):
            self.assertIn(said, self.run_program(*words, expected_code=1))
        self.config.write_text("cloud_to_scan: {beam_spacign: 0.1}")
        self.assertIn("beam_spacing", self.run_program(expected_code=1))
        self.assertIn("usage", self.run_program("--help"))


if __name__ == "__main__":
    unittest.main()
