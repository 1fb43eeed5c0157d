#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate classes on a drive of one second, with a camera: figures, and crops of the mistakes."""

import base64
import re
import unittest

import cv2
import numpy as np
import rosbag
from datmo_tools import bag_messages, transforms
from datmo_tools.errors import InputError
from datmo_tools.evaluate.box_crops import COLOR, Box, crop
from datmo_tools.evaluate.camera_images import Camera, CameraImage
from geometry_msgs.msg import Vector3

from datmo_fusion.msg import Object, ObjectArray
from border_run_samples import AXES, CAMERA, write_images
from evaluate_case import EvaluateCase
from object_samples import object_at
from track_samples import car, track, write_run

VEHICLE, PEDESTRIAN = Object.CLASS_VEHICLE, Object.CLASS_PEDESTRIAN
SIZE = (4.0, 2.0, 1.5)  # m
SPEED = 10.0  # m/s
WRONG_FRAME = 3
DATA = re.compile(r'src="data:image/png;base64,([^"]+)"')


def classified(at, said):
    """Function of the frame: the Track of `at`, with the class and probability of said(frame)."""

    def item(frame):
        found = at(frame)
        found.size = Vector3(*SIZE)
        found.classification, found.class_probability = said(frame)
        return found

    return item


def pictures(page):
    """Returns the pictures (BGR) in a page."""
    data = [np.frombuffer(base64.b64decode(item), dtype=np.uint8) for item in DATA.findall(page)]
    return [cv2.imdecode(item, cv2.IMREAD_COLOR) for item in data]


def drawn(picture):
    """Returns where a picture has the color of edges (bool array)."""
    return np.all(np.abs(picture[:, :, ::-1].astype(int) - COLOR) < 40, axis=2)


class Tool(EvaluateCase):
    """A car 20 m ahead is called a pedestrian once; a track of nothing, to the left and less far, is
    called a vehicle, more confidently."""

    def setUp(self):
        super().setUp()
        self.run_bag, self.drive = self.folder / "run<i>.bag", self.folder / "drive.bag"
        right = classified(track(7, 20.0, 0.0, SPEED), lambda frame:
                           (PEDESTRIAN, 0.7) if frame == WRONG_FRAME else (VEHICLE, 0.9))  # fmt: skip
        false = classified(track(9, 15.0, 4.0, 2.0), lambda frame: (VEHICLE, 0.8 + 0.01 * frame))
        write_run(self.run_bag, {"/tracks": [right, false]}, [car(1, 20.0, 0.0, SPEED)])

    def classes(self, *words, code=0):
        words = ("--set", "truth/min_time_seen=0", *words)
        out, errors, result = self.evaluate("classes", self.run_bag, *words, code=code)
        page = self.folder / "classes.html"
        return out, errors, result and result["runs"][0], page.read_text() if result else ""

    def test_figures(self):
        out, _, run, _ = self.classes()
        self.assertEqual(run["classes"]["right"], 10)
        self.assertEqual(run["objects"]["1"],
                         {"class": "vehicle", "tracks": [7], "frames": 11, "right": 10, "silent": 0})  # fmt: skip
        near, far = run["confusion"][1], run["confusion"][2]
        self.assertEqual((near["vehicle"]["vehicle"], near["vehicle"]["pedestrian"]), (0, 0))
        self.assertEqual((far["vehicle"]["vehicle"], far["vehicle"]["pedestrian"]), (9, 1))
        self.assertEqual(near["nothing"]["vehicle"], 11)
        self.assertEqual([item["count"] for item in run["calibration"]], [1, 21])
        rows = [line.split() for line in out.splitlines()]
        self.assertIn(["vehicle", "90.9", "11", "0"], rows)
        self.assertIn(["1", "vehicle", "7", "11", "90.9", "0"], rows)

    def test_a_wrong_class_is_worse_than_a_track_of_nothing(self):
        _, _, run, page = self.classes()
        self.assertEqual([(item["said"], item["true"], item["track"], item["true_object"])
                          for item in run["mistakes"]],
                         [("pedestrian", "vehicle", 7, 1), ("vehicle", "nothing", 9, None)])  # fmt: skip
        wrong, nothing = run["mistakes"]
        self.assertAlmostEqual(wrong["range_m"], 23.0)
        self.assertAlmostEqual(nothing["probability"], 0.9, places=5)
        self.assertEqual(pictures(page), [])
        self.assertEqual(len(self.classes("--mistakes", "1")[2]["mistakes"]), 1)

    def test_mistakes_are_shown_in_the_image_of_their_time(self):
        """100 px of focal length: the track lies across, its side of 4 m at 22 m is 18.2 px wide."""
        write_images(self.drive, delay=0)
        out, _, _, page = self.classes("--images", self.drive)
        self.assertIn("pedestrian (70.0 %), true: vehicle, 23.0 m, 1000.300 s, track 7, object 1", page)
        self.assertNotIn("<i>", page)
        wrong, nothing = pictures(page)
        self.assertEqual(tuple(wrong[0, 0]), (WRONG_FRAME,) * 3)
        self.assertEqual(tuple(nothing[0, 0]), (10,) * 3)
        columns = np.flatnonzero(drawn(wrong).any(axis=0))
        scale = wrong.shape[0] / 64.0
        self.assertAlmostEqual(np.ptp(columns) / scale, 18.2, delta=1.0)
        self.assertAlmostEqual(columns.mean(), wrong.shape[1] / 2, delta=scale)
        self.assertIn("on the page", out)

    def test_a_mistake_without_an_image_is_reported(self):
        write_images(self.drive, count=1, delay=0)
        out, _, _, page = self.classes("--images", self.drive)
        self.assertEqual(out.count("no image with camera_info within 0.2 s"), 2)
        self.assertEqual(pictures(page), [])

    def test_a_mistake_in_an_unusable_image_is_reported(self):
        write_images(self.drive, delay=0, encoding="16UC1")
        out, _, _, page = self.classes("--images", self.drive)
        self.assertEqual(out.count("an image is 16UC1, expected one of mono8"), 2)
        self.assertEqual(pictures(page), [])

    def test_a_cut_image_is_reported(self):
        whole = self.folder / "whole.bag"
        write_images(whole, delay=0)
        with rosbag.Bag(str(whole)) as source, rosbag.Bag(str(self.drive), "w") as target:
            for i, (topic, message, time) in enumerate(source.read_messages()):
                if topic.endswith("image_rect") and i < 12:
                    message.data = message.data[:-1]
                target.write(topic, message, time)
        out, _, _, page = self.classes("--images", self.drive)
        self.assertEqual(out.count("an image of 100 x 80 has 7999 bytes in rows of 100"), 1)
        self.assertEqual(len(pictures(page)), 1)

    def test_bad_input(self):
        self.assertIn("nothing on /stereo/left/image_rect", self.classes("--images", self.run_bag, code=1)[1])
        self.assertIn("no such file", self.classes("--images", self.folder / "none.bag", code=1)[1])


class Objects(EvaluateCase):
    def test_mistakes_of_single_measurements_are_shown(self):
        """A parked car is called a pedestrian in every scan: one mistake."""
        run, drive = self.folder / "run.bag", self.folder / "drive.bag"
        write_run(run, {}, [car(4, 20.0, 0.0)])
        with rosbag.Bag(str(run), "a") as bag:
            for i in range(3):
                stamp = 1000 * 10**9 + i * 10**8
                item = object_at(20.0, 0.0, classification=PEDESTRIAN)
                item.class_probability = 0.6
                message = ObjectArray(header=bag_messages.header(stamp, "base_link"), objects=[item])
                bag.write("/objects", message, message.header.stamp)
        write_images(drive, delay=0)
        _, _, result = self.evaluate("objects", run, "--images", drive)
        (mistake,) = result["topics"]["/objects"]["mistakes"]
        self.assertEqual((mistake["said"], mistake["true"], mistake["true_object"]), ("pedestrian", "vehicle", 4))
        self.assertEqual(len(pictures((self.folder / "objects.html").read_text())), 1)


class Crop(unittest.TestCase):
    IMAGE = CameraImage(0, np.zeros((CAMERA.height, CAMERA.width), dtype=np.uint8), Camera(
        transforms.inverse(transforms.rigid(AXES, [0.0, 0.0, 1.5])), CAMERA.projection))  # fmt: skip

    def crop(self, x, y, size=SIZE):
        return crop(self.IMAGE, Box(np.array([x, y, 0.0]), size, np.zeros(2)).seen_from(np.zeros(3)))

    def test_color_images_stay_in_color(self):
        red = np.zeros((CAMERA.height, CAMERA.width, 3), dtype=np.uint8)
        red[:, :, 0] = 200
        points = Box(np.array([20.0, 0.0, 0.0]), SIZE, np.zeros(2)).seen_from(np.zeros(3))
        (picture,) = pictures(f'src="{crop(self.IMAGE._replace(pixels=red), points)}"')
        self.assertEqual(tuple(picture[0, 0]), (0, 0, 200))

    def test_a_box_out_of_view_is_refused(self):
        with self.assertRaisesRegex(InputError, "not ahead of the camera"):
            self.crop(-20.0, 0.0)
        with self.assertRaisesRegex(InputError, "outside the image"):
            self.crop(20.0, 40.0)

    def test_a_box_beside_the_camera_is_cut(self):
        self.assertTrue(self.crop(2.0, 1.5).startswith("data:image/png"))

    def test_a_point_has_a_picture_too(self):
        self.assertTrue(self.crop(20.0, 0.0, (0.0, 0.0, 0.0)).startswith("data:image/png"))


if __name__ == "__main__":
    unittest.main()
