#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""kitti_to_bag on a made-up drive: contents of the bag, determinism."""

import math
import unittest

import numpy as np
import rosbag
import tiny_drive
from kitti_bag_case import Conversion

from datmo_fusion.msg import Object


class Contents(Conversion):
    def test_scan(self):
        self.run_tool()
        scans = self.messages("/scan")
        self.assertEqual(len(scans), tiny_drive.FRAMES)
        scan = scans[1]
        self.assertEqual(scan.header.frame_id, "scanner")
        self.assertAlmostEqual(scan.angle_min, math.radians(80.0), places=6)
        self.assertAlmostEqual(scan.angle_max, math.radians(-80.0), places=6)
        self.assertAlmostEqual(scan.angle_increment, math.radians(-2.0), places=6)
        self.assertEqual((scan.range_min, scan.range_max, len(scan.ranges)), (1.0, 50.0, 81))
        self.assertAlmostEqual(scan.ranges[40], 10.0, places=5)
        self.assertEqual(sum(math.isfinite(distance) for distance in scan.ranges), 1)
        self.assertTrue(math.isnan(scan.ranges[0]), "the cloud has no point there at all")

    def test_beams_have_their_own_times(self):
        """A turn takes 0.1 s, 160 of 360 degrees take 44.4 ms, and the middle is at the stamp."""
        self.run_tool()
        with rosbag.Bag(str(self.bag)) as bag:
            _, scan, recorded = list(bag.read_messages(["/scan"]))[1]
        self.assertAlmostEqual(
            scan.header.stamp.to_nsec(), 1317042272_100000000 - 22222222, delta=1000
        )
        self.assertAlmostEqual(80 * scan.time_increment, 0.1 * 160 / 360, places=7)
        self.assertAlmostEqual(scan.scan_time, 0.1, places=7)
        self.assertEqual(recorded.to_nsec(), 1317042272_100000000 + 22222222)
        stamp = self.messages("/ground_truth/objects")[1].header.stamp
        self.assertEqual(stamp.to_nsec(), 1317042272_100000000)

    def test_scan_options(self):
        self.run_tool("--scan-resolution", "1", "--scan-range", "11", "40", "--scan-fov", "90")
        scan = self.messages("/scan")[0]
        self.assertEqual((len(scan.ranges), scan.range_min, scan.range_max), (91, 11.0, 40.0))
        self.assertFalse(any(math.isfinite(distance) for distance in scan.ranges))
        self.run_tool("--scan-band", "0.6", "1")  # the point is 0.5 m above the road
        ranges = self.messages("/scan")[0].ranges
        self.assertFalse(any(math.isfinite(distance) for distance in ranges))

    def test_truth(self):
        self.run_tool()
        pose = self.messages("/ground_truth/pose")[3]
        self.assertEqual(
            (pose.header.frame_id, pose.child_frame_id), ("map", "base_link_ground_truth")
        )
        self.assertAlmostEqual(pose.pose.pose.position.x, 3.0, places=6)
        self.assertEqual(pose.twist.twist.linear.x, 10.0)
        arrays = self.messages("/ground_truth/objects")
        self.assertEqual(
            [array.header.stamp.nsecs for array in arrays],
            [frame * 100_000_000 for frame in range(tiny_drive.FRAMES)],
        )
        van = arrays[2].objects[0]
        self.assertAlmostEqual(van.pose.position.x, 2.0 + 0.8 + 12.0, places=6)
        self.assertAlmostEqual(van.pose.position.z, 1.0, places=6)
        self.assertEqual(
            (van.label, van.classification, van.moving), ("Van", Object.CLASS_VEHICLE, True)
        )
        self.assertAlmostEqual(van.velocity.x, 10.0, places=5)
        self.assertEqual((van.size.x, van.size.y, van.size.z), (4.0, 2.0, 2.0))
        self.assertEqual((van.lidar_beams, van.visible_to, van.occlusion), (1, ["scanner"], 0.5))

    def test_gps_position(self):
        """The same drive with a speed of 20 m/s: only the velocity's position follows it."""
        for frame in range(tiny_drive.FRAMES):
            line = tiny_drive.oxts_line(frame, speed=20.0)
            (self.drive / "oxts" / "data" / f"{frame:010d}.txt").write_text(line)
        for source, x in (("velocity", 6.0), ("gps", 3.0)):
            self.run_tool("--true-position", source)
            self.assertAlmostEqual(
                self.messages("/ground_truth/pose")[3].pose.pose.position.x, x, places=5
            )

    def test_odometry_and_its_transform(self):
        self.run_tool("--odometry-scale-error", "0.1", "--odometry-yaw-bias", "1")
        odometry = self.messages("/odometry")[3]
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("odom", "base_link"))
        self.assertAlmostEqual(odometry.twist.twist.linear.x, 11.0)
        self.assertAlmostEqual(odometry.twist.twist.angular.z, math.radians(1.0))
        self.assertAlmostEqual(odometry.pose.pose.position.x, 3.3, places=4)
        self.assertGreater(odometry.twist.covariance[0], 0.0)
        self.assertGreater(odometry.pose.covariance[0], 0.0)
        transform = self.messages("/tf")[3].transforms[0]
        self.assertEqual(
            (transform.header.frame_id, transform.child_frame_id), ("odom", "base_link")
        )
        self.assertEqual(transform.transform.translation.x, odometry.pose.pose.position.x)
        self.assertEqual(transform.transform.rotation.z, odometry.pose.pose.orientation.z)

    def test_mounts(self):
        self.run_tool()
        with rosbag.Bag(str(self.bag)) as bag:
            topic, message, _, header = next(
                bag.read_messages(["/tf_static"], return_connection_header=True)
            )
            first = next(bag.read_messages()).topic
        self.assertEqual((header["latching"], first), (b"1", "/tf_static"))
        mounts = {item.child_frame_id: item.transform.translation for item in message.transforms}
        positions = {
            frame: (round(at.x, 6), round(at.y, 6), round(at.z, 6)) for frame, at in mounts.items()
        }
        self.assertEqual(
            positions,
            {
                "scanner": (0.8, 0.0, 0.6),
                "velodyne": (0.8, 0.0, 1.73),
                "imu": (0.0, 0.0, 0.93),
                "stereo_left_optical": (0.8, 0.0, 1.73),
                "stereo_right_optical": (0.8, -0.5, 1.73),
            },
        )
        left = next(
            item for item in message.transforms if item.child_frame_id == "stereo_left_optical"
        )
        rotation = left.transform.rotation  # optical axes: x to the right, y down, z ahead
        np.testing.assert_allclose(
            [rotation.x, rotation.y, rotation.z, rotation.w], [-0.5, 0.5, -0.5, 0.5]
        )

    def test_points_and_images_on_request(self):
        self.run_tool()
        self.assertEqual(self.messages("/points") + self.messages("/stereo/left/image_rect"), [])
        self.run_tool("--points", "--images")
        cloud = self.messages("/points")[0]
        self.assertEqual(
            (cloud.header.frame_id, cloud.width, cloud.point_step), ("velodyne", 1, 16)
        )
        self.assertEqual([field.name for field in cloud.fields], ["x", "y", "z", "intensity"])
        np.testing.assert_allclose(
            np.frombuffer(cloud.data, "<f4"), [10.0, 0.0, -1.23, 0.5], rtol=1e-6
        )
        image = self.messages("/stereo/right/image_rect")[2]
        self.assertEqual(
            (image.encoding, image.width, image.height, image.step), ("mono8", 8, 4, 8)
        )
        self.assertEqual(list(image.data), [0] + [22] * 31)
        right = self.messages("/stereo/right/camera_info")[2]
        self.assertEqual(
            (right.header.stamp, right.header.frame_id), (image.header.stamp, "stereo_left_optical")
        )
        self.assertEqual(right.P[3], -10.0 * 0.5)
        self.assertEqual(right.K, (10.0, 0.0, 4.0, 0.0, 10.0, 2.0, 0.0, 0.0, 1.0))
        self.assertEqual(self.messages("/stereo/left/camera_info")[0].P[3], 0.0)

    def test_labels_instead_of_tracklets(self):
        path = self.root / "labels.txt"
        path.write_text("0 7 Pedestrian 0 0 0 1 2 3 4 1.8 0.6 2.0 0.0 1.5 11.0 0.0\n")
        self.run_tool("--labels", str(path))
        arrays = self.messages("/ground_truth/objects")
        self.assertEqual([len(array.objects) for array in arrays], [1, 0, 0, 0])
        self.assertEqual(
            (arrays[0].objects[0].id, arrays[0].objects[0].classification),
            (7, Object.CLASS_PEDESTRIAN),
        )

    def write_unusable_cloud(self, frame):
        cloud = np.full(4, np.nan, "<f4")
        cloud.tofile(self.drive / "velodyne_points" / "data" / f"{frame:010d}.bin")

    def test_an_unusable_cloud_has_no_scan(self):
        self.write_unusable_cloud(1)
        self.run_tool()
        self.assertEqual(len(self.messages("/scan")), tiny_drive.FRAMES - 1)
        self.assertEqual(len(self.messages("/ground_truth/objects")), tiny_drive.FRAMES)

    def test_a_drive_of_unusable_clouds_is_refused(self):
        for frame in range(tiny_drive.FRAMES):
            self.write_unusable_cloud(frame)
        said = self.run_tool(expected_code=1)
        self.assertIn("no cloud of the drive gives a scan", said)
        self.assertFalse(self.bag.exists())

    def test_part_of_a_drive_starts_at_its_own_origin(self):
        self.run_tool("--start", "1", "--end", "3")
        self.assertEqual(len(self.messages("/scan")), 2)
        self.assertAlmostEqual(self.messages("/ground_truth/pose")[0].pose.pose.position.x, 0.0)
        van = self.messages("/ground_truth/objects")[0].objects[0]
        self.assertAlmostEqual(van.pose.position.x, 12.8, places=6)

    def test_drive_without_labels(self):
        (self.drive / "tracklet_labels.xml").unlink()
        self.run_tool()
        self.assertEqual(self.messages("/ground_truth/objects"), [])
        self.assertEqual(len(self.messages("/scan")), 4)

    def test_missing_scans_on_request(self):
        (self.drive / "velodyne_points" / "data" / "0000000001.bin").unlink()
        self.run_tool("--allow-missing-scans")
        self.assertEqual(
            [array.header.stamp.nsecs for array in self.messages("/ground_truth/objects")],
            [0, 200_000_000, 300_000_000],
        )
        self.assertEqual(len(self.messages("/scan")), 3)
        self.assertEqual(len(self.messages("/odometry")), 4)


class Determinism(Conversion):
    NOISE = ("--odometry-speed-noise", "0.2", "--odometry-yaw-noise", "1", "--images")

    def bytes_of(self, *options):
        self.run_tool(*self.NOISE, *options)
        return self.bag.read_bytes()

    def test_same_seed_same_bytes(self):
        self.assertEqual(self.bytes_of("--seed", "5"), self.bytes_of("--seed", "5"))

    def test_other_seed_other_bytes(self):
        self.assertNotEqual(self.bytes_of("--seed", "5"), self.bytes_of("--seed", "6"))


if __name__ == "__main__":
    unittest.main()
