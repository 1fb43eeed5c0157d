# SPDX-License-Identifier: BSD-3-Clause
"""Publishes images of a camera, with its calibration, as a driver does."""

import rospy
from sensor_msgs.msg import CameraInfo, Image

from datmo_tools.image_files import check_size

QUEUE = 5  # images, a few tenths of a second


def image_message(image, stamp, frame):
    """Returns a sensor_msgs/Image of a numpy array."""
    message = Image(height=image.shape[0], width=image.shape[1], is_bigendian=0)
    message.header.stamp, message.header.frame_id = stamp, frame
    message.encoding = "mono8" if image.ndim == 2 else "bgr8"
    message.step = image.shape[1] * (1 if image.ndim == 2 else 3)
    message.data = image.tobytes()
    return message


def info_message(calibration, stamp, frame):
    """Returns a sensor_msgs/CameraInfo of a calibration (read_calibration)."""
    message = CameraInfo(**calibration)
    message.header.stamp, message.header.frame_id = stamp, frame
    return message


class CameraTopics:
    """The two topics of one camera: stereo/SIDE/TOPIC and stereo/SIDE/camera_info."""

    def __init__(self, side, topic, calibration):
        """calibration: as read_calibration() returns it."""
        self.calibration = calibration
        self._image = rospy.Publisher(f"stereo/{side}/{topic}", Image, queue_size=QUEUE)
        self._info = rospy.Publisher(f"stereo/{side}/camera_info", CameraInfo, queue_size=QUEUE)

    def check(self, image, source):
        """Raises InputError, which names the source, unless the image has the calibration's size."""
        check_size(image, self.calibration, source)

    def publish(self, image, stamp, frame, source):
        """Raises InputError like check()."""
        self.check(image, source)
        self._image.publish(image_message(image, stamp, frame))
        self._info.publish(info_message(self.calibration, stamp, frame))
