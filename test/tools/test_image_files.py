#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Images and calibrations from files, and the messages that are made of them."""

import tempfile
import unittest
from pathlib import Path

import cv2
import numpy as np
import rospy
import yaml

from datmo_tools.camera_topics import image_message, info_message
from datmo_tools.errors import InputError
from datmo_tools.image_files import Images, check_size, read_calibration
from datmo_tools.play_images import arguments_of

MATRIX = [400.0, 0.0, 4.0, 0.0, 400.0, 3.0, 0.0, 0.0, 1.0]
CALIBRATION = {
    "image_width": 8, "image_height": 6, "camera_name": "left", "distortion_model": "plumb_bob",
    "camera_matrix": {"rows": 3, "cols": 3, "data": MATRIX},
    "distortion_coefficients": {"rows": 1, "cols": 5, "data": [0.1, 0, 0, 0, 0]},
    "rectification_matrix": {"rows": 3, "cols": 3, "data": [1, 0, 0, 0, 1, 0, 0, 0, 1]},
    "projection_matrix": {"rows": 3, "cols": 4,
                          "data": [400, 0, 4, -120, 0, 400, 3, 0, 0, 0, 1, 0]}}


class ImageFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write_image(self, name, value, color=False):
        shape = (6, 8, 3) if color else (6, 8)
        cv2.imwrite(str(self.folder / name), np.full(shape, value, np.uint8))

    def calibration(self, **changes):
        file = self.folder / "camera.yaml"
        file.write_text(yaml.safe_dump({**CALIBRATION, **changes}))
        return file

    def test_a_folder_is_played_by_name(self):
        for name, value in (("b.png", 2), ("a.png", 1), ("c.png", 3)):
            self.write_image(name, value)
        (self.folder / "notes.txt").write_text("no image")
        images = Images(self.folder)
        self.assertEqual([int(image[0, 0]) for image in images], [1, 2, 3])
        self.assertEqual([int(image[0, 0]) for image in images], [1, 2, 3], "and again")

    def test_a_broken_file_is_skipped_and_counted(self):
        self.write_image("a.png", 1)
        (self.folder / "b.png").write_bytes(b"half an image")
        images = Images(self.folder)
        self.assertEqual([image is None for image in images], [False, True])
        self.assertEqual(images.skipped, 1)

    def test_a_video_is_played(self):
        file = self.folder / "drive.avi"
        writer = cv2.VideoWriter(str(file), cv2.VideoWriter_fourcc(*"MJPG"), 10.0, (64, 48))
        for value in (10, 100, 200):
            writer.write(np.full((48, 64, 3), value, np.uint8))
        writer.release()
        values = [float(image.mean()) for image in Images(file)]
        self.assertEqual(len(values), 3)
        for value, expected in zip(values, (10, 100, 200)):
            self.assertAlmostEqual(value, expected, delta=5.0)

    def test_an_invalid_source_is_reported(self):
        with self.assertRaisesRegex(InputError, "no image in it"):
            Images(self.folder)
        with self.assertRaisesRegex(InputError, "expected a folder of images or a video file"):
            Images(self.folder / "missing")
        (self.folder / "text.avi").write_text("no video")
        with self.assertRaisesRegex(InputError, "not a video that OpenCV can read"):
            Images(self.folder / "text.avi")

    def test_a_calibration_becomes_camera_info(self):
        info = info_message(read_calibration(self.calibration()), rospy.Time(3), "left")
        self.assertEqual((info.width, info.height), (8, 6))
        self.assertEqual(info.K, MATRIX)
        self.assertEqual(info.P[3], -120.0)
        self.assertEqual(info.D[0], 0.1)
        self.assertEqual((info.header.stamp, info.header.frame_id), (rospy.Time(3), "left"))

    def test_an_incomplete_calibration_is_reported(self):
        with self.assertRaisesRegex(InputError, "projection_matrix: expected data with 12 numbers"):
            read_calibration(self.calibration(projection_matrix={"data": [1.0]}))
        with self.assertRaisesRegex(InputError, "image_width"):
            read_calibration(self.calibration(image_width="wide"))
        with self.assertRaisesRegex(InputError, "expected a yaml file that can be read"):
            read_calibration(self.folder / "missing.yaml")

    def test_images_of_another_size_are_refused(self):
        calibration = read_calibration(self.calibration())
        check_size(np.zeros((6, 8), np.uint8), calibration, "a")
        with self.assertRaisesRegex(InputError, "images of 6 x 8: expected 8 x 6"):
            check_size(np.zeros((8, 6), np.uint8), calibration, "a")

    def test_images_become_messages(self):
        gray = image_message(np.full((6, 8), 7, np.uint8), rospy.Time(3), "left")
        self.assertEqual((gray.encoding, gray.step, len(gray.data)), ("mono8", 8, 48))
        color = image_message(np.full((6, 8, 3), 7, np.uint8), rospy.Time(3), "left")
        self.assertEqual((color.encoding, color.step, len(color.data)), ("bgr8", 24, 144))

    def test_one_camera_or_two(self):
        self.assertEqual(len(arguments_of(["a", "b", "c", "d"]).files), 4)
        with self.assertRaises(InputError):
            arguments_of(["a", "b", "c"])


if __name__ == "__main__":
    unittest.main()
