#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_bag finds each fault of scans and cameras, and what joints measure."""

import math
import unittest

import numpy as np
import simulated_recording as simulated
from check_bag_case import Tool, each, masked, of_topic, ranges, shifted, without
from geometry_msgs.msg import AccelWithCovarianceStamped
from old_objects import old_types
from sensor_msgs.msg import JointState, PointCloud2, PointField

from datmo_fusion.msg import ObjectArray


class Scans(Tool):
    def test_nan_for_no_return(self):
        def change(values):
            values[::4] = math.nan
            return values

        self.assert_finds("nan_ranges", ranges(simulated.recording(), change))

    def test_zero_for_no_return(self):
        def change(values):
            values[::4] = 0.0
            return values

        self.assert_finds("zero_ranges", ranges(simulated.recording(), change))

    def test_largest_value_for_no_return(self):
        def change(values):
            values[~(values < 30.0)] = 30.0
            return values

        self.assert_finds("range_max", ranges(simulated.recording(), change))

    def test_dead_beams(self):
        items = ranges(simulated.recording(), lambda values: masked(values, 100, 150, math.nan))
        self.assert_finds("dead_beams", items)

    def test_own_returns(self):
        items = ranges(simulated.recording(), lambda values: masked(values, 0, 12, 0.6))
        self.assert_finds("own_returns", items)

    def test_short_reach(self):
        def cut(message):
            message.range_max = 8.0
            values = np.array(message.ranges)
            message.ranges = np.where(values < 8.0, values, math.inf).tolist()

        items = each(simulated.recording(), "/scan", cut)
        kinds, _, content = self.run_tool(items)
        self.assertEqual(kinds["reach_below_window"], "warning")
        self.assertLess(content["grid_slam"]["map"]["length"], 60.0)

    def test_count_of_beams(self):
        def cut(message):
            message.ranges = message.ranges[:-20]

        self.assert_finds("beam_count", each(simulated.recording(), "/scan", cut), "error")

    def test_range_limits(self):
        def clear(message):
            message.range_max = 0.0

        self.assert_finds("range_limits", each(simulated.recording(), "/scan", clear), "error")

    def test_time_increment(self):
        def slow(message):
            message.time_increment = 0.01

        self.assert_finds("time_increment", each(simulated.recording(), "/scan", slow))

    def test_no_scan(self):
        self.assert_finds("no_scan", without(simulated.recording(), "/scan"), "error")

    def test_cloud_of_a_3d_lidar_alone(self):
        cloud = PointCloud2(height=1, width=0, point_step=16, is_dense=True)
        cloud.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1)
                        for i, name in enumerate(("x", "y", "z", "intensity"))]  # fmt: skip
        cloud.header.frame_id, cloud.header.stamp = "velodyne", simulated.ros_time(1.0)
        items = without(simulated.recording(), "/scan")
        items.append(simulated.Item(1.0, "/velodyne_points", cloud))
        simulated.write(self.bag, items)
        kinds, out, _ = self.run_tool(items, code=1)
        self.assertEqual(kinds["only_3d_lidar"], "error")
        self.assertIn("cloud_to_scan", out)


class Joints(Tool):
    def test_joints_with_velocities_are_wheels(self):
        items = without(simulated.recording(), "/odometry", "/tf")
        for item in of_topic(items, "/imu"):
            joints = JointState(header=item.message.header, velocity=[1.0])
            items.append(simulated.Item(item.recorded, "/wheels", joints))
        _, out, content = self.run_tool(items)
        self.assertEqual(content["motion"]["source"], "imu_and_wheels")
        self.assertIn("joint_states:=/wheels", out)
        self.assertNotIn("steering:=", out)

    def test_steering_and_acceleration_are_no_wheels(self):
        items = without(simulated.recording(), "/odometry", "/tf")
        for item in of_topic(items, "/imu"):
            joints = JointState(header=item.message.header, name=["steer"], position=[0.1])
            items.append(simulated.Item(item.recorded, "/front/joint_states", joints))
            along = AccelWithCovarianceStamped(header=item.message.header)
            items.append(simulated.Item(item.recorded, "/accel/filtered", along))
        kinds, out, content = self.run_tool(items)
        self.assertEqual(content["motion"]["source"], "imu")
        self.assertNotIn("wheel_speeds", kinds)
        for line in ("run_bag", "replay.launch"):
            command = next(each for each in out.splitlines() if f"datmo_fusion {line}" in each)
            self.assertIn("steering:=/front/joint_states acceleration:=/accel/filtered", command)


class Cameras(Tool):
    RIGHT = "/stereo/right/camera_info"

    def test_one_camera_names_what_the_scanner_sees(self):
        alone = without(simulated.recording(), self.RIGHT, "/stereo/right/image_rect")
        _, out, _ = self.run_tool(alone)
        self.assertRegex(out, r"mono \(classes, with a network\) +ready")
        self.assertRegex(out, r"object +missing: .*use level mono")

    def test_one_camera_with_missing_messages(self):
        alone = without(simulated.recording(), self.RIGHT, "/stereo/right/image_rect")
        _, out, _ = self.run_tool(without(alone, "/stereo/left/camera_info"))
        self.assertRegex(out, r"mono \(classes, with a network\) +missing: camera_info of /stereo")
        _, out, _ = self.run_tool(without(alone, "/stereo/left/image_rect"))
        self.assertRegex(out, r"mono \(classes, with a network\) +missing: a camera's images")
        raw = [item._replace(topic=item.topic.replace("image_rect", "image_raw")) for item in alone]
        _, out, _ = self.run_tool(raw)
        self.assertRegex(out, r"mono \(classes, with a network\) +missing: rectified images")

    def test_not_calibrated(self):
        def clear(message):
            message.K, message.P = [0.0] * 9, [0.0] * 12

        self.assert_finds("camera_info_zero", each(simulated.recording(), self.RIGHT, clear), "error")

    def test_of_another_size(self):
        def grow(message):
            message.width *= 2

        self.assert_finds("camera_info_size", each(simulated.recording(), self.RIGHT, grow), "error")

    def test_no_baseline(self):
        def clear(message):
            message.P = [*message.P[:3], 0.0, *message.P[4:]]

        self.assert_finds("baseline_zero", each(simulated.recording(), self.RIGHT, clear), "error")

    def test_exchanged(self):
        def turn(message):
            message.P = [*message.P[:3], -message.P[3], *message.P[4:]]

        self.assert_finds("baseline_sign", each(simulated.recording(), self.RIGHT, turn), "error")

    def test_no_camera_info(self):
        self.assert_finds("no_camera_info", without(simulated.recording(), self.RIGHT))

    def test_apart(self):
        items = shifted(simulated.recording(), "/stereo/right/image_rect", 0.04)
        _, _, content = self.run_tool(items)
        self.assert_finds("pair_offset", items)
        self.assertTrue(content["stereo_image_proc"]["approximate_sync"])


class Definitions(Tool):
    def test_messages_of_another_version_are_named(self):
        old = old_types(ObjectArray)[ObjectArray._type]()
        items = simulated.recording()
        items.append(simulated.Item(1.0, "/old_objects", old))
        items.append(simulated.Item(1.0, "/objects", ObjectArray()))
        _, out, _ = self.run_tool(items, code=0)
        self.assertIn("/old_objects: is another version of datmo_fusion/ObjectArray", out)
        self.assertEqual(out.count("is another version"), 1, out)


if __name__ == "__main__":
    unittest.main()
