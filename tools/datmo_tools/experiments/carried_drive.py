# SPDX-License-Identifier: BSD-3-Clause
"""Makes recordings in which a vehicle is carried elsewhere, unnoticed by clocks and odometry."""

from datmo_tools import transforms
from datmo_tools.pose_path import planar

ODOMETRY = "/odometry"
TRANSFORMS = "/tf"


class CarriedDrive:
    """Joins the parts of a drive before and after a removed part.

    The stamps move back by the part's duration, and the odometry continues from where it was
    before; the ground truth keeps its poses.
    """

    def __init__(self, duration):
        """duration: of the removed part, a rospy.Duration."""
        self._duration = duration
        self._before = {}  # the last pose before the removed part, by topic
        self._after = {}  # the first one after it

    def pass_before(self, topic, message):
        """Notes a message before the removed part."""
        odometry = _odometry_of(topic, message)
        if odometry is not None:
            self._before[topic] = _pose_of(odometry)

    def move(self, topic, message):
        """Changes a message after the removed part in place."""
        odometry = _odometry_of(topic, message)
        if odometry is not None:
            pose = _pose_of(odometry)
            since = transforms.relative(self._after.setdefault(topic, pose), pose)
            _set_pose(odometry, transforms.compose(self._before.get(topic, pose), since))
        for stamped in message.transforms if topic == TRANSFORMS else [message]:
            stamped.header.stamp -= self._duration


def _odometry_of(topic, message):
    """Returns the geometry_msgs/Pose or Transform measured by odometry; None in other messages."""
    if topic == ODOMETRY:
        return message.pose.pose
    return message.transforms[0].transform if topic == TRANSFORMS else None


def _parts(odometry):
    """Returns position or translation, and rotation, of a pose or transform."""
    if hasattr(odometry, "translation"):
        return odometry.translation, odometry.rotation
    return odometry.position, odometry.orientation


def _pose_of(odometry):
    """Returns x, y (m) and yaw (rad)."""
    if hasattr(odometry, "position"):
        return planar(odometry)
    matrix = transforms.rigid_of(odometry)
    return (*matrix[:2, 3], transforms.yaw_of(matrix))


def _set_pose(odometry, pose):
    position, rotation = _parts(odometry)
    position.x, position.y = pose[:2]
    rotation.x, rotation.y, rotation.z, rotation.w = transforms.quaternion_of_yaw(pose[2])
