# SPDX-License-Identifier: BSD-3-Clause
"""Publishes the rectified images of a USB camera (Video4Linux), or of a stereo camera that sends both
images side by side as one.

usage: usb_camera [--size WIDTH HEIGHT] [--rate HZ] [--format FOURCC] [--frame NAME] [--delay S]
                  DEVICE LEFT.yaml [RIGHT.yaml]

DEVICE: /dev/video0. With RIGHT.yaml, the left half of each image is the left camera's. The calibrations
are those of camera_calibration for the raw images; for two cameras, they were calibrated together.

Out: stereo/left/image_rect, stereo/left/camera_info, and the same for right; the status of the device
on /diagnostics. A device that is missing, or silent, is opened again until it is back.
"""

import os
import time
from pathlib import Path

# s; OpenCV reads it when it is loaded, and otherwise waits for ten.
os.environ.setdefault("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "1")

import cv2
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from datmo_tools.camera_topics import CameraTopics
from datmo_tools.command_line import check_positive, new_parser, number, run
from datmo_tools.errors import InputError
from datmo_tools.image_files import Rectifier, read_calibration

RETRY = 1.0  # s, from one attempt to open the device to the next
STATUS_PERIOD = 1.0  # s
MAX_AGE = 1.0  # s, of an image when it is read; the driver's stamp is of no use if it seems to be older
SIDES = ("left", "right")


class Device:
    """An open camera. Raises InputError if it cannot be opened, or sends no image."""

    def __init__(self, values, capture_of=cv2.VideoCapture):
        """values: of arguments_of(); capture_of: opens a device by its name."""
        self._name = str(values.device)
        if not values.device.exists():
            raise InputError(f"{self._name}: not there, expected the device file of a camera (v4l2-ctl --list-devices)")
        self._capture = capture_of(self._name, cv2.CAP_V4L2)
        if not self._capture.isOpened():
            raise InputError(f"{self._name}: cannot be opened, expected a camera that no other program uses")
        self._capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter_fourcc(*values.format))
        if values.size:
            self._capture.set(cv2.CAP_PROP_FRAME_WIDTH, values.size[0])
            self._capture.set(cv2.CAP_PROP_FRAME_HEIGHT, values.size[1])
        self._capture.set(cv2.CAP_PROP_FPS, values.rate)

    def read(self):
        """Waits for the next image; returns it, and its age (s) now."""
        is_there, image = self._capture.read()
        if not is_there:
            raise InputError(f"{self._name}: no image for a second, expected them at the requested rate; opening it again")
        return image, self._age()

    def _age(self):
        """s; 0 if the driver does not say, in the computer's monotonic clock, when it got the image."""
        age = time.monotonic() - 1e-3 * self._capture.get(cv2.CAP_PROP_POS_MSEC)
        return age if 0.0 <= age <= MAX_AGE else 0.0

    def close(self):
        self._capture.release()


def split(image, count):
    """Returns the images of `count` cameras, which are side by side in one. Raises InputError."""
    width = image.shape[1]
    if width % count:
        raise InputError(f"images with {width} columns: expected an even number, two images side by side")
    step = width // count
    return [image[:, i * step:(i + 1) * step] for i in range(count)]


class Cameras:
    """Publishes the cameras of a device, one or two."""

    def __init__(self, values):
        self._values = values
        self._topics = [CameraTopics(side, "image_rect", read_calibration(file))
                        for side, file in zip(SIDES, values.calibrations)]
        self._rectifiers = [Rectifier(topics.calibration) for topics in self._topics]

    def publish(self, image, stamp):
        """Raises InputError for images of another size than their calibration's."""
        parts = split(image, len(self._topics))
        for topics, part in zip(self._topics, parts):
            topics.check(part, self._values.device)
        for topics, rectifier, part in zip(self._topics, self._rectifiers, parts):
            topics.publish(rectifier.rectified(part), stamp, self._values.frame, self._values.device)


class Status:
    """Reports a device's state on /diagnostics, every second."""

    def __init__(self, device):
        self._device = device
        self._publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1)
        self._fault = "not opened yet"
        self._counts = {"images": 0, "faults": 0}
        self._since, self._images_then = time.monotonic(), 0

    def works(self):
        """An image was published."""
        if self._fault and self._counts["faults"]:
            rospy.loginfo("%s: works again", self._device)
        self._fault = ""
        self._counts["images"] += 1

    def fails(self, fault):
        """Once for each fault, until it works again."""
        self._counts["faults"] += 1
        if fault != self._fault:
            rospy.logerr("%s", fault)
        self._fault = fault

    def report(self, now=None):
        """Publishes if a second has passed since the last time."""
        elapsed = (time.monotonic() if now is None else now) - self._since
        if elapsed < STATUS_PERIOD:
            return
        rate = (self._counts["images"] - self._images_then) / elapsed
        self._since, self._images_then = self._since + elapsed, self._counts["images"]
        self._publisher.publish(self.message(rate))

    def message(self, rate):
        """Returns the diagnostic_msgs/DiagnosticArray; rate: Hz, of the images."""
        status = DiagnosticStatus(name=f"{rospy.get_name().lstrip('/')}: camera", hardware_id=str(self._device))
        status.level = DiagnosticStatus.ERROR if self._fault else DiagnosticStatus.OK
        status.message = self._fault or "sends images"
        figures = {**self._counts, "rate [Hz]": f"{rate:.1f}"}
        status.values = [KeyValue(key=key, value=str(value)) for key, value in figures.items()]
        message = DiagnosticArray(status=[status])
        message.header.stamp = rospy.Time.now()
        return message


def serve(values, cameras, status, running, capture_of=cv2.VideoCapture):
    """Publishes images while running(); opens the device again after each fault."""
    device = None
    while running():
        try:
            device = device or Device(values, capture_of)
            image, age = device.read()
            cameras.publish(image, rospy.Time.now() - rospy.Duration(age + values.delay))
            status.works()
        except InputError as error:
            status.fails(str(error))
            if device:
                device.close()
            device = None
            time.sleep(RETRY)
        status.report()
    if device:
        device.close()


def arguments_of(words):
    """Returns the parsed command line. Raises InputError."""
    parser = new_parser("usb_camera", __doc__)
    add = parser.add_argument
    add("--size", type=int, nargs=2, metavar=("WIDTH", "HEIGHT"), help="px, of the images as sent: both side by side; default: the camera's")
    add("--rate", type=number, default=30.0, metavar="HZ", help="requested images per second (default 30)")
    add("--format", default="MJPG", metavar="FOURCC", help="requested format (default MJPG; YUYV is not compressed)")
    add("--frame", default="camera", help="optical frame of the left camera (default camera)")
    add("--delay", type=number, default=0.0, metavar="S", help="from the middle of an exposure to the driver's stamp (default 0)")
    add("device", type=Path, metavar="DEVICE")
    add("calibrations", nargs="+", type=Path, metavar="CALIBRATION.yaml")
    values = parser.parse_args(words)
    check_positive(values, "rate")
    if len(values.format) != 4:
        raise InputError(f"--format {values.format}: expected four characters, such as MJPG or YUYV")
    if len(values.calibrations) > len(SIDES):
        raise InputError(f"{len(values.calibrations)} calibrations: expected that of one camera, or of two")
    return values


def start(words):
    """Runs the node until it is shut down."""
    values = arguments_of(words)
    rospy.init_node("usb_camera")
    serve(values, Cameras(values), Status(values.device), lambda: not rospy.is_shutdown())


def main():
    """Returns the exit code."""
    words = rospy.myargv()[1:]
    return run("usb_camera", lambda: start(words), "image")
