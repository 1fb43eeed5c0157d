#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every file of a KITTI raw drive: what is read from it, and the error for a broken one."""

import math
import tempfile
import unittest

import numpy as np
import tiny_drive
from datmo_tools import transforms
from datmo_tools.errors import InputError
from datmo_tools.convert.kitti_calibration import read_calibration
from datmo_tools.convert.kitti_labels import read_labels
from datmo_tools.convert.kitti_raw import Drive
from datmo_tools.convert.kitti_tracklets import read_tracklets


class TinyDrive(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = tiny_drive.make_drive(temporary.name)

    def assert_named(self, path, expected, function, *arguments):
        """Expects that `function` raises InputError with the path and with what was expected."""
        with self.assertRaises(InputError) as context:
            function(*arguments)
        self.assertIn(str(path), str(context.exception))
        self.assertIn(expected, str(context.exception))


class Calibration(TinyDrive):
    def test_mounts(self):
        calibration = read_calibration(self.folder.parent)
        np.testing.assert_allclose(calibration.base_from_velodyne[:3, 3], [0.8, 0.0, 1.73])
        np.testing.assert_allclose(calibration.base_from_imu[:3, 3], [0.0, 0.0, 0.93])
        ahead = transforms.apply(calibration.left_from_velodyne, np.array([[5.0, 1.0, 2.0]]))
        np.testing.assert_allclose(ahead, [[-1.0, -2.0, 5.0]])

    def test_cameras(self):
        calibration = read_calibration(self.folder.parent)
        self.assertEqual((calibration.left.width, calibration.left.height), (8, 4))
        self.assertAlmostEqual(calibration.baseline, 0.5)

    def test_rectification_follows_the_camera(self):
        path = self.folder.parent / "calib_cam_to_cam.txt"
        path.write_text(
            path.read_text().replace(
                "R_rect_00: 1 0 0 0 1 0 0 0 1", "R_rect_00: 0 -1 0 1 0 0 0 0 1"
            )
        )
        calibration = read_calibration(self.folder.parent)
        ahead = transforms.apply(calibration.left_from_velodyne, np.array([[5.0, 1.0, 2.0]]))
        np.testing.assert_allclose(ahead, [[2.0, -1.0, 5.0]])

    def test_missing_file(self):
        path = self.folder.parent / "calib_velo_to_cam.txt"
        path.unlink()
        self.assert_named(path, "expected a calibration file", read_calibration, self.folder.parent)

    def test_missing_key_and_short_line(self):
        path = self.folder.parent / "calib_imu_to_velo.txt"
        path.write_text("R: 1 0 0 0 1 0 0 0 1\n")
        self.assert_named(
            path, "key T is missing, expected 3", read_calibration, self.folder.parent
        )
        path.write_text("R: 1 0 0 0 1 0 0 0 1\nT: 1 2\n")
        self.assert_named(path, "T has 2 numbers, expected 3", read_calibration, self.folder.parent)
        path.write_text("R: 1 0 0 0 1 0 0 0 1\nT: 1 2 x\n")
        self.assert_named(path, "expected 3 numbers", read_calibration, self.folder.parent)


class RawDrive(TinyDrive):
    def test_frames(self):
        drive = Drive(self.folder)
        self.assertEqual(drive.frames, 4)
        self.assertEqual(drive.scan_stamps[1] - drive.scan_stamps[0], 100_000_000)
        self.assertEqual(drive.scan_stamps[0], 1317042272 * 10**9)
        self.assertEqual(drive.oxts(2).forward_speed, 10.0)
        np.testing.assert_allclose(drive.cloud(0), [[10.0, 0.0, -1.23, 0.5]], rtol=1e-6)
        self.assertEqual(drive.image(1, 3, 8, 4)[1, 1], 23)

    def test_no_folder(self):
        self.assert_named(
            self.folder / "no",
            "expected the folder of a KITTI raw drive",
            Drive,
            self.folder / "no",
        )

    def test_oxts(self):
        path = self.folder / "oxts" / "data" / "0000000001.txt"
        for text, expected in (
            ("1 2 3", "3 fields, expected 30"),
            ("x " * 30, "expected 30 numbers"),
            ("nan " * 30, "not a finite number"),
        ):
            path.write_text(text)
            self.assert_named(path, expected, Drive(self.folder).oxts, 1)

    def test_truncated_cloud(self):
        path = self.folder / "velodyne_points" / "data" / "0000000002.bin"
        for size in (0, 15, 17):
            path.write_bytes(b"\0" * size)
            self.assert_named(
                path, f"{size} bytes, expected a multiple of 16", Drive(self.folder).cloud, 2
            )

    def test_images(self):
        drive = Drive(self.folder)
        path = self.folder / "image_00" / "data" / "0000000000.png"
        self.assert_named(path, "8 x 4, expected a gray PNG of 9 x 4", drive.image, 0, 0, 9, 4)
        path.write_bytes(path.read_bytes()[:20])
        self.assert_named(path, "cannot be read", drive.image, 0, 0, 8, 4)
        path.unlink()
        self.assert_named(path, "missing", drive.image, 0, 0, 8, 4)
        self.assert_named(
            self.folder / "image_00", "3 files .png, expected 4", drive.image_stamps, 0
        )

    def test_stamps(self):
        path = self.folder / "oxts" / "timestamps.txt"
        good = path.read_text()
        path.write_text("yesterday\n")
        self.assert_named(f"{path}:1", "expected YYYY-MM-DD", Drive, self.folder)
        path.write_text("".join(reversed(good.splitlines(keepends=True))))
        self.assert_named(path, "do not increase", Drive, self.folder)
        path.write_text("\n")
        self.assert_named(path, "empty", Drive, self.folder)
        path.write_text(good.splitlines()[0])
        self.assert_named(path.parent, "4 files .txt, expected 1", Drive, self.folder)


class Tracklets(TinyDrive):
    def test_box_rests_on_its_middle(self):
        van = read_tracklets(self.folder / "tracklet_labels.xml")[0]
        self.assertEqual((van.label, van.length, van.width, van.height), ("Van", 4.0, 2.0, 2.0))
        self.assertEqual(sorted(van.boxes), [0, 1, 2, 3])
        box = van.boxes[2]
        np.testing.assert_allclose([box.x, box.y, box.z, box.yaw], [12.0, 0.0, -0.73, 0.0])
        self.assertEqual(box.occlusion, 0.5)

    def test_broken(self):
        path = self.folder / "tracklet_labels.xml"
        good = path.read_text()
        for text, expected in (
            (good[:200], "expected KITTI's tracklet XML"),
            (good.replace("<count>1<", "<count>2<"), "1 tracklets, expected 2"),
            (good.replace("<tx>12.0</tx>", "", 1), "tracklet 0, pose 0: <tx> is None"),
            (good.replace("<w>2</w>", "<w>nan</w>"), "expected a finite number"),
        ):
            path.write_text(text)
            self.assert_named(path, expected, read_tracklets, path)


class Labels(TinyDrive):
    LINE = "1 7 Cyclist 0 2 -1.5 1 2 3 4 1.8 0.6 2.0 -3.0 1.5 10.0 0.0\n"

    def setUp(self):
        super().setUp()
        self.path = self.folder / "labels.txt"
        self.left_from_velodyne = read_calibration(self.folder.parent).left_from_velodyne

    def read(self):
        return read_labels(self.path, self.left_from_velodyne)

    def test_camera_box_in_the_velodyne_frame(self):
        """Bottom center 3 m left of, 1.5 m below, 10 m ahead of the camera, heading right."""
        self.path.write_text(
            "0 -1 DontCare -1 -1 -10 1 2 3 4 -1000 -1000 -1000 -10 -1 -1 -1\n" + self.LINE
        )
        objects = self.read()
        self.assertEqual(len(objects), 1)
        cyclist = objects[0]
        self.assertEqual((cyclist.number, cyclist.label), (7, "Cyclist"))
        self.assertEqual((cyclist.length, cyclist.width, cyclist.height), (2.0, 0.6, 1.8))
        box = cyclist.boxes[1]
        np.testing.assert_allclose(
            [box.x, box.y, box.z, box.yaw], [10.0, 3.0, -0.6, -math.pi / 2], atol=1e-12
        )
        self.assertEqual(box.occlusion, 1.0)

    def test_heading_ahead(self):
        self.path.write_text(self.LINE.replace(" 0.0\n", f" {-math.pi / 2}\n"))
        self.assertAlmostEqual(self.read()[0].boxes[1].yaw, 0.0)

    def test_broken(self):
        for text, expected in (
            ("0 0 Car 0\n", "4 fields, expected 17"),
            (self.LINE.replace("10.0", "far"), "expected KITTI's 17 fields"),
            (self.LINE.replace("10.0", "inf"), "not finite"),
        ):
            self.path.write_text(self.LINE + text)
            self.assert_named(f"{self.path}:2", expected, self.read)
        self.path.unlink()
        self.assert_named(self.path, "expected a label_02 file", self.read)


if __name__ == "__main__":
    unittest.main()
