#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A USB camera's images, its faults and its status, with a device that is played by the test."""

import time
import unittest
from unittest import mock

import cv2
import numpy as np
import rospy
from diagnostic_msgs.msg import DiagnosticStatus

from datmo_tools import usb_camera
from datmo_tools.errors import InputError
from datmo_tools.image_files import Rectifier
from datmo_tools.usb_camera import Cameras, Device, Status, arguments_of, serve, split

CALIBRATION = {"width": 40, "height": 30, "distortion_model": "plumb_bob", "D": [0.0] * 5,
               "K": [50.0, 0, 20, 0, 50.0, 15, 0, 0, 1], "R": [1.0, 0, 0, 0, 1, 0, 0, 0, 1],
               "P": [50.0, 0, 20, 0, 0, 50.0, 15, 0, 0, 0, 1, 0]}  # fmt: skip
DEVICE = "/dev/null"  # is there
VALUES = arguments_of([DEVICE, "left.yaml"])


class Capture:
    """What cv2.VideoCapture is to Device. images: None is a read that fails."""

    def __init__(self, images=(), age=0.1, is_open=True):
        self.images, self.age, self.is_open, self.settings = list(images), age, is_open, {}
        self.released = False

    def isOpened(self):
        return self.is_open

    def set(self, key, value):
        self.settings[key] = value

    def get(self, key):
        assert key == cv2.CAP_PROP_POS_MSEC
        return 1e3 * (time.monotonic() - self.age)

    def read(self):
        image = self.images.pop(0) if self.images else None
        return image is not None, image

    def release(self):
        self.released = True


def image(value=7, width=40):
    return np.full((30, width, 3), value, np.uint8)


class UsbCamera(unittest.TestCase):
    def setUp(self):
        rospy.rostime.set_rostime_initialized(True)
        rospy.rostime._set_rostime(rospy.Time(50))
        self.addCleanup(rospy.rostime._set_rostime, rospy.Time(0))
        for name, value in (("camera_topics.rospy.Publisher", mock.MagicMock()),
                            ("usb_camera.rospy.Publisher", mock.MagicMock()),
                            ("usb_camera.read_calibration", lambda file: CALIBRATION),
                            ("usb_camera.RETRY", 0.0)):
            patch = mock.patch(f"datmo_tools.{name}", value)
            patch.start()
            self.addCleanup(patch.stop)

    def serve(self, captures, rounds, cameras=None):
        """Returns the cameras (a mock that notes images) and the status after that many rounds."""
        cameras, status = cameras or mock.MagicMock(), Status(DEVICE)
        left = iter([True] * rounds + [False])
        captures = iter(captures)
        serve(VALUES, cameras, status, lambda: next(left), lambda *_: next(captures))
        return cameras, status

    def test_images_have_the_time_at_which_the_driver_got_them(self):
        cameras, status = self.serve([Capture([image(1), image(2)], age=0.25)], 2)
        stamps = [call.args[1].to_sec() for call in cameras.publish.call_args_list]
        self.assertEqual(len(stamps), 2)
        for stamp in stamps:
            self.assertAlmostEqual(stamp, 49.75, delta=0.1)
        self.assertEqual(status.message(30.0).status[0].level, DiagnosticStatus.OK)

    def test_a_known_delay_is_taken_off(self):
        values = arguments_of(["--delay", "0.5", DEVICE, "left.yaml"])
        cameras = mock.MagicMock()
        left = iter([True, False])
        serve(values, cameras, Status(DEVICE), lambda: next(left), lambda *_: Capture([image()], age=0.25))
        self.assertAlmostEqual(cameras.publish.call_args.args[1].to_sec(), 49.25, delta=0.1)

    def test_a_wrong_image_of_the_right_camera_keeps_the_left_one_back(self):
        published = []
        with mock.patch("datmo_tools.camera_topics.CameraTopics.publish", lambda *arguments: published.append(arguments)):
            with mock.patch("datmo_tools.usb_camera.read_calibration",
                            lambda file: {**CALIBRATION, "width": 50} if file.stem == "r" else CALIBRATION):
                cameras = Cameras(arguments_of([DEVICE, "l.yaml", "r.yaml"]))
            with self.assertRaisesRegex(InputError, "expected 50 x 30"):
                cameras.publish(np.hstack([image(), image()]), rospy.Time(3))
        self.assertEqual(published, [])

    def test_a_clock_that_is_not_the_computers_is_not_used(self):
        for age in (-1e6, 1e6):
            cameras, _ = self.serve([Capture([image()], age=age)], 1)
            self.assertEqual(cameras.publish.call_args.args[1], rospy.Time(50))

    def test_a_device_is_set_up_as_asked(self):
        capture = Capture([image()])
        Device(arguments_of(["--size", "1280", "480", "--rate", "15", "--format", "YUYV", DEVICE, "a.yaml"]),
               lambda name, backend: capture if (name, backend) == (DEVICE, cv2.CAP_V4L2) else None)  # fmt: skip
        self.assertEqual(capture.settings[cv2.CAP_PROP_FRAME_WIDTH], 1280)
        self.assertEqual(capture.settings[cv2.CAP_PROP_FRAME_HEIGHT], 480)
        self.assertEqual(capture.settings[cv2.CAP_PROP_FPS], 15)
        self.assertEqual(capture.settings[cv2.CAP_PROP_FOURCC], cv2.VideoWriter_fourcc(*"YUYV"))

    def test_a_silent_or_missing_device_is_opened_again(self):
        silent, missing, back = Capture([image(), None]), Capture(is_open=False), Capture([image(), image()])
        cameras, status = self.serve([silent, missing], 3)
        self.assertTrue(silent.released)
        found = status.message(0.0).status[0]
        self.assertEqual(found.level, DiagnosticStatus.ERROR)
        self.assertIn(f"{DEVICE}: cannot be opened", found.message)
        cameras, status = self.serve([Capture([image(), None]), Capture(is_open=False), back], 5)
        self.assertEqual(cameras.publish.call_count, 3)
        found = status.message(12.5).status[0]
        self.assertEqual(found.level, DiagnosticStatus.OK)
        self.assertEqual({item.key: item.value for item in found.values},
                         {"images": "3", "faults": "2", "rate [Hz]": "12.5"})  # fmt: skip

    def test_a_camera_that_is_not_plugged_in_is_waited_for(self):
        values = arguments_of(["/dev/no_camera", "a.yaml"])
        with self.assertRaisesRegex(InputError, "/dev/no_camera: not there"):
            Device(values, lambda *_: self.fail("opened"))

    def test_images_of_another_size_are_a_fault(self):
        cameras = Cameras(VALUES)
        _, status = self.serve([Capture([image(width=50)])], 1, cameras)
        self.assertIn("images of 50 x 30: expected 40 x 30", status.message(0.0).status[0].message)

    def test_two_images_side_by_side_are_those_of_two_cameras(self):
        both = np.hstack([image(10), image(20)])
        left, right = split(both, 2)
        self.assertEqual((left.shape, right.shape), ((30, 40, 3), (30, 40, 3)))
        self.assertEqual((left.max(), right.min()), (10, 20))
        with self.assertRaisesRegex(InputError, "even number"):
            split(both[:, :-1], 2)
        published = []
        with mock.patch("datmo_tools.camera_topics.CameraTopics.publish",
                        lambda topics, part, stamp, frame, source: published.append((part.mean(), stamp, frame))):
            Cameras(arguments_of([DEVICE, "l.yaml", "r.yaml"])).publish(both, rospy.Time(3))
        self.assertEqual(published, [(10.0, rospy.Time(3), "camera"), (20.0, rospy.Time(3), "camera")])

    def test_the_rate_is_that_since_the_last_report(self):
        status = Status(DEVICE)
        start = status._since
        for _ in range(6):
            status.works()
        status.report(start + 0.5)
        self.assertEqual(status._publisher.publish.call_count, 0)
        status.report(start + 2.0)
        values = status._publisher.publish.call_args.args[0].status[0].values
        self.assertIn(("rate [Hz]", "3.0"), [(item.key, item.value) for item in values])

    def test_the_command_line_is_checked(self):
        for words, message in ((["--format", "JPEG2", "d", "a"], "four characters"), (["--rate", "0", "d", "a"], "--rate"),
                               (["d", "a", "b", "c"], "3 calibrations")):
            with self.assertRaisesRegex(InputError, message):
                arguments_of(words)
        self.assertEqual(usb_camera.arguments_of(["d", "a", "b"]).format, "MJPG")


class Rectification(unittest.TestCase):
    def test_a_lens_that_distorts_is_straightened(self):
        calibration = {**CALIBRATION, "D": [-0.8, 0.1, 0.0, 0.0, 0.0]}
        raw = np.zeros((30, 40), np.uint8)
        raw[5:8, 33:36] = 255  # around a point at (34, 6)
        rectified = Rectifier(calibration).rectified(raw)
        intrinsics = np.reshape(calibration["K"], (3, 3))
        expected = cv2.undistortPoints(np.array([[[34.0, 6.0]]]), intrinsics, np.array(calibration["D"]), P=intrinsics)[0, 0]
        rows, columns = np.nonzero(rectified > 127)
        self.assertGreater(np.hypot(*(expected - (34.0, 6.0))), 1.0, "else it could be the raw image")
        self.assertLess(np.hypot(columns.mean() - expected[0], rows.mean() - expected[1]), 0.7)

    def test_an_unknown_lens_is_refused(self):
        with self.assertRaisesRegex(InputError, "distortion_model equidistant"):
            Rectifier({**CALIBRATION, "distortion_model": "equidistant"})
        with self.assertRaisesRegex(InputError, "3 distortion_coefficients: expected 0, 4, 5, 8"):
            Rectifier({**CALIBRATION, "D": [0.0] * 3})


if __name__ == "__main__":
    unittest.main()
