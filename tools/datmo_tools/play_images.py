# SPDX-License-Identifier: BSD-3-Clause
"""Publishes images of one camera or a stereo pair, from folders or video files, as a driver would.

usage: play_images [--rate HZ] [--loop] [--frame NAME] [--raw] LEFT LEFT.yaml [RIGHT RIGHT.yaml]

Out: stereo/left/image_rect (with --raw image_raw), stereo/left/camera_info, and the same for right.
The images of both cameras are paired by their order, and stamped with the time of publication.
"""

from pathlib import Path

import rospy

from datmo_tools.camera_topics import CameraTopics
from datmo_tools.command_line import check_positive, new_parser, number, run
from datmo_tools.errors import InputError
from datmo_tools.image_files import Images, check_size, read_calibration


class Camera:
    """One camera's files and its topics."""

    def __init__(self, path, calibration, side, topic):
        self.images = Images(path)
        first = next((image for image in self.images if image is not None), None)
        if first is None:
            raise InputError(f"{path}: no readable image, expected 8 bit, gray or color")
        self._topics = CameraTopics(side, topic, read_calibration(calibration))
        check_size(first, self._topics.calibration, path)

    def publish(self, image, stamp, frame):
        self._topics.publish(image, stamp, frame, self.images.path)


def arguments_of(words):
    parser = new_parser("play_images", __doc__)
    parser.add_argument("--rate", type=number, default=12.0, metavar="HZ", help="images per second (default 12)")
    parser.add_argument("--loop", action="store_true", help="repeat")
    parser.add_argument("--frame", default="camera", help="optical frame of the left camera (default camera)")
    parser.add_argument("--raw", action="store_true", help="the images are not rectified")
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    values = parser.parse_args(words)
    check_positive(values, "rate")
    if len(values.files) not in (2, 4):
        raise InputError(f"{len(values.files)} files: expected images and calibration of one camera or of two")
    return values


def _play_once(cameras, values, rate):
    for images in zip(*(camera.images for camera in cameras)):
        if rospy.is_shutdown():
            return
        if all(image is not None for image in images):
            stamp = rospy.Time.now()
            for camera, image in zip(cameras, images):
                camera.publish(image, stamp, values.frame)
        rate.sleep()


def play(words):
    values = arguments_of(words)
    topic = "image_raw" if values.raw else "image_rect"
    rospy.init_node("play_images")
    cameras = [Camera(images, calibration, side, topic)
               for images, calibration, side in zip(values.files[::2], values.files[1::2], ("left", "right"))]
    rate = rospy.Rate(values.rate)
    _play_once(cameras, values, rate)
    while values.loop and not rospy.is_shutdown():
        _play_once(cameras, values, rate)
    for camera in cameras:
        if camera.images.skipped:
            rospy.logwarn("%s: %d files that are not 8 bit images were skipped", camera.images.path, camera.images.skipped)


def main():
    """Returns the exit code."""
    words = rospy.myargv()[1:]
    return run("play_images", lambda: play(words), "image")
