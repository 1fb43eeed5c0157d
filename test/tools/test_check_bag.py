#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_bag finds each fault of stamps, motion and frames, and none in a recording without."""

import contextlib
import io
import math
import os
import re
import subprocess
import unittest

import simulated_recording as simulated
from check_bag_case import Tool, each, odometry_of, of_topic, ranges, shifted, without
from geometry_msgs.msg import TwistStamped

from datmo_tools import transforms
from datmo_tools.check_bag.main import main


class CleanRecording(Tool):
    def test_no_finding_worse_than_a_note(self):
        kinds, out, _ = self.run_tool(simulated.recording(), code=0)
        self.assertEqual({k for k, severity in kinds.items() if severity != "note"}, set(), out)

    def test_lines_to_start_with(self):
        _, out, content = self.run_tool(simulated.recording())
        self.assertIn(f"rosrun datmo_fusion run_bag {self.bag} result.bag --config {self.yaml}", out)
        self.assertIn(f"roslaunch datmo_fusion replay.launch bag:={self.bag}", out)
        self.assertNotIn("mounts", content)
        self.assertNotIn("frames", content)

    def test_noise_is_measured_at_rest(self):
        _, _, content = self.run_tool(simulated.recording())
        self.assertAlmostEqual(content["scanner"]["range_sigma"], simulated.RANGE_NOISE,
                               delta=0.005)  # fmt: skip


class Stamps(Tool):
    def test_gap(self):
        items = [item for item in simulated.recording()
                 if item.topic != "/scan" or not 6.0 < item.recorded < 7.0]  # fmt: skip
        self.assert_finds("stamp_gap", items)

    def test_out_of_order(self):
        items = simulated.recording()
        scans = of_topic(items, "/scan")
        for first, second in ((scans[30], scans[31]), (scans[60], scans[61])):
            a, b = first.message.header, second.message.header
            a.stamp, b.stamp = b.stamp, a.stamp
        self.assert_finds("stamp_order", items)

    def test_jump_back(self):
        items = simulated.recording()
        for item in of_topic(items, "/scan")[70:]:
            stamp = item.message.header.stamp.to_nsec() - 3 * 10**9
            item.message.header.stamp = simulated.to_ros_time(stamp)
        self.assert_finds("stamp_jump_back", items, "error")

    def test_repeated(self):
        items = simulated.recording()
        scans = of_topic(items, "/scan")
        scans[40].message.header.stamp = scans[39].message.header.stamp
        self.assert_finds("stamp_repeated", items)

    def test_no_stamp(self):
        def clear(message):
            message.header.stamp = simulated.to_ros_time(0)

        self.assert_finds("no_stamp", each(simulated.recording(), "/imu", clear), "error")

    def test_half_rate(self):
        scans = of_topic(simulated.recording(), "/scan")[::2]
        items = without(simulated.recording(), "/scan") + scans
        self.assert_finds("rate_below_scan_time", items)

    def test_every_fifth_scan_lost(self):
        scans = [s for i, s in enumerate(of_topic(simulated.recording(), "/scan")) if i % 5]
        self.assert_finds("messages_lost", without(simulated.recording(), "/scan") + scans)

    def test_low_rate(self):
        scans = of_topic(simulated.recording(), "/scan")[::4]
        for item in scans:
            item.message.scan_time = 0.4
        self.assert_finds("low_rate", without(simulated.recording(), "/scan") + scans)

    def test_record_time_of_another_clock(self):
        items = [item._replace(recorded=item.recorded + 2.0) if item.topic == "/scan" else item
                 for item in simulated.recording()]  # fmt: skip
        kinds = self.assert_finds("record_time", items)
        self.assertIn("clocks_differ", kinds)

    def test_clock_offset_seen_by_motion_alone(self):
        """Header and record of the odometry are both 0.2 s late."""
        items = shifted(simulated.recording(), "/odometry", 0.2)
        items = [item._replace(recorded=item.recorded + 0.2) if item.topic == "/odometry" else item
                 for item in items]  # fmt: skip
        kinds = self.assert_finds("clock_offset", items)
        self.assertNotIn("record_time", kinds)

    def test_imu_clock(self):
        kinds, out, _ = self.run_tool(shifted(simulated.recording(), "/imu", -0.15))
        self.assertEqual(kinds.get("clock_offset"), "warning", out)
        self.assertIn("/imu: /imu is 0.15 s earlier than the scans", out)


class Motion(Tool):
    def test_odometry_missing(self):
        items = without(simulated.recording(), "/odometry", "/tf")
        kinds, _, content = self.run_tool(items)
        self.assertEqual(kinds["no_odometry"], "warning")
        self.assertEqual(content["motion"]["source"], "imu")

    def test_imu_on_its_side_instead_of_odometry(self):
        """Its y axis points up: it is rolled by 90 degrees."""
        def turn(message):
            rate, pull = message.angular_velocity, message.linear_acceleration
            rate.y, rate.z, pull.y, pull.z = rate.z, 0.0, 9.81, 0.0

        items = without(each(simulated.recording(), "/imu", turn), "/odometry", "/tf")
        kinds, out, content = self.run_tool(items)
        self.assertEqual(kinds["missing_imu_mount"], "warning")
        self.assertAlmostEqual(content["mounts"]["imu"]["roll"], 0.5 * math.pi, delta=0.01)
        self.assertNotIn("yaw_sign", kinds, out)

    def test_no_source_of_motion(self):
        _, _, content = self.run_tool(without(simulated.recording(), "/odometry", "/tf", "/imu"))
        self.assertEqual(content["motion"]["source"], "none")

    def test_twist_and_imu_instead_of_odometry(self):
        items = simulated.recording()
        for item in of_topic(items, "/odometry"):
            twist = TwistStamped(header=item.message.header, twist=item.message.twist.twist)
            items.append(simulated.Item(item.recorded, "/speed", twist))
        _, out, content = self.run_tool(without(items, "/odometry"))
        self.assertEqual(content["motion"]["source"], "imu_and_twist")
        self.assertIn("twist:=/speed", out)

    def test_scale(self):
        kinds, out, _ = self.run_tool(odometry_of(simulated.recording(), speed_scale=1.2))
        self.assertEqual(kinds.get("odometry_scale"), "warning", out)
        self.assertIn("0.83 times", out)

    def test_yaw_scale(self):
        self.assert_finds("yaw_scale", odometry_of(simulated.recording(), yaw_scale=1.3))

    def test_yaw_of_the_wrong_sign(self):
        self.assert_finds("yaw_sign", odometry_of(simulated.recording(), yaw_scale=-1.0), "error")

    def test_speed_of_the_wrong_sign(self):
        items = odometry_of(simulated.recording(), speed_scale=-1.0)
        self.assert_finds("speed_sign", items, "error")

    def test_delay(self):
        kinds, out, _ = self.run_tool(odometry_of(simulated.recording(), delay=0.12))
        self.assertEqual(kinds.get("clock_offset"), "warning", out)
        self.assertIn("0.12 s later", out)

    def test_twist_always_zero(self):
        def stop(message):
            message.twist.twist.linear.x = message.twist.twist.angular.z = 0.0

        kinds, _, content = self.run_tool(each(simulated.recording(), "/odometry", stop))
        self.assertEqual(kinds["no_twist"], "note")
        self.assertTrue(content["motion"]["odometry_pose"])

    def test_mirrored_scan(self):
        items = ranges(simulated.recording(), lambda values: values[::-1])
        self.assert_finds("yaw_sign", items, "error")

    def test_mount_turned(self):
        items = without(simulated.recording(), "/tf_static")
        turned = transforms.quaternion_of_yaw(0.3)
        for child, turn in (("laser", turned), ("camera", (-0.5, 0.5, -0.5, 0.5))):
            message = simulated.transform(0.0, "base_link", child, (1.5, 0.0, 0.4), turn)
            items.append(simulated.Item(0.0, "/tf_static", message))
        kinds, out, _ = self.run_tool(items)
        self.assertEqual(kinds.get("mount_yaw"), "warning", out)
        right = float(re.search(r"should be (\S+) rad", out).group(1))
        self.assertAlmostEqual(right, 0.0, delta=0.05)


class Frames(Tool):
    def test_missing_mount(self):
        kinds, _, content = self.run_tool(without(simulated.recording(), "/tf_static"), code=1)
        self.assertEqual(kinds["missing_mount"], "error")
        self.assertEqual(content["mounts"]["laser"]["x"], 0.0)

    def test_missing_mount_of_the_camera(self):
        items = without(simulated.recording(), "/tf_static")
        message = simulated.transform(0.0, "base_link", "laser", (1.5, 0.0, 0.4))
        kinds, _, content = self.run_tool([*items, simulated.Item(0.0, "/tf_static", message)])
        self.assertEqual(kinds["missing_camera_mount"], "warning")
        self.assertEqual(list(content["mounts"]), ["camera"])

    def test_wrong_frame_of_the_scan(self):
        def rename(message):
            message.header.frame_id = "front_laser"

        self.assert_finds("missing_mount", each(simulated.recording(), "/scan", rename), "error")

    def test_slashes(self):
        def rename(message):
            message.header.frame_id = "/odom"
            message.child_frame_id = "/base_link"

        items = each(simulated.recording(), "/odometry", rename)
        kinds = self.assert_finds("slash_frames", items, "note")
        self.assertNotIn("missing_mount", kinds)

    def test_other_names(self):
        def rename(message):
            message.header.frame_id, message.child_frame_id = "wheel_odom", "base_footprint"

        items = each(without(simulated.recording(), "/tf", "/tf_static"), "/odometry", rename)
        message = simulated.transform(0.0, "base_footprint", "laser", (1.5, 0.0, 0.4))
        _, _, content = self.run_tool([*items, simulated.Item(0.0, "/tf_static", message)])
        self.assertEqual(content["frames"], {"odom": "wheel_odom", "base": "base_footprint"})

    def test_two_parents(self):
        message = simulated.transform(1.0, "chassis", "laser", (0.0, 0.0, 0.0))
        items = [*simulated.recording(), simulated.Item(1.0, "/tf", message)]
        self.assert_finds("two_parents", items, "error")

    def test_loop(self):
        message = simulated.transform(1.0, "laser", "odom", (0.0, 0.0, 0.0))
        items = [*simulated.recording(), simulated.Item(1.0, "/tf", message)]
        self.assert_finds("frame_loop", items, "error")

    def test_odometry_without_child(self):
        def clear(message):
            message.child_frame_id = ""

        self.assert_finds("odometry_frame", each(simulated.recording(), "/odometry", clear), "error")

    def test_tilted(self):
        half = math.radians(6.0)
        tilt = (0.0, math.sin(half), 0.0, math.cos(half))
        message = simulated.transform(0.0, "base_link", "laser", (1.5, 0.0, 0.4), tilt)
        items = without(simulated.recording(), "/tf_static")
        self.assert_finds("scanner_tilted", [*items, simulated.Item(0.0, "/tf_static", message)],
                          "error")  # fmt: skip


class WrittenYaml(Tool):
    """run_bag accepts the yaml, whatever sections it has."""

    def assert_runs(self, items, *topics):
        self.run_tool(items)
        words = [os.environ["DATMO_FUSION_RUN_BAG"], self.bag, self.folder / "result.bag",
                 "--config", self.yaml, "--quiet", *topics]  # fmt: skip
        done = subprocess.run([str(word) for word in words], stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 0, done.stderr.decode())

    def test_street_with_a_camera(self):
        self.assert_runs(simulated.recording())

    def test_short_reach_imu_and_no_mounts(self):
        def cut(message):
            message.range_max = 8.0

        items = without(simulated.recording(), "/odometry", "/tf", "/tf_static")
        self.assert_runs(each(items, "/scan", cut))


class Unreadable(Tool):
    def test_ends_with_2(self):
        for content in (b"", b"no bag at all", b"#ROSBAG V2.0\n"):
            self.bag.write_bytes(content)
            errors = io.StringIO()
            with contextlib.redirect_stderr(errors):
                self.assertEqual(main([str(self.bag)]), 2)
            self.assertIn(str(self.bag), errors.getvalue())
            self.assertEqual(len(errors.getvalue().splitlines()), 1)

    def test_missing_topic(self):
        simulated.write(self.bag, simulated.recording())
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(main([str(self.bag), "--no-yaml", "--scan", "/rear"]), 1)
        self.assertIn("/rear: no LaserScan", errors.getvalue())

    def test_no_such_file(self):
        with contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(main([str(self.bag)]), 2)


if __name__ == "__main__":
    unittest.main()
