# SPDX-License-Identifier: BSD-3-Clause
"""Messages and frames of the stack's data contract that all converters write."""

import numpy as np
from geometry_msgs.msg import Point, Quaternion, TransformStamped, Vector3
from nav_msgs.msg import Odometry
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from datmo_tools import transforms
from datmo_tools.stamps import to_ros_time

MAP, ODOM, BASE, SCANNER = "map", "odom", "base_link", "scanner"

# rad^2 and m^2, variance of what is not measured: large, as infinity breaks matrix computations.
NOT_MEASURED = 1e6


def header(stamp, frame):
    """Header at `stamp` (ns); its sequence number stays 0, so equal content gives equal bytes."""
    return Header(stamp=to_ros_time(stamp), frame_id=frame)


def odometry(sample):
    """Returns the Odometry of an OdometrySample: pose in odom, rates in base_link."""
    message = planar_odometry(sample.stamp, ODOM, BASE, sample.pose, sample.speed, sample.yaw_rate)
    pose_covariance = np.diag([0.0, 0.0, NOT_MEASURED, NOT_MEASURED, NOT_MEASURED, 0.0])
    planar = np.ix_([0, 1, 5], [0, 1, 5])
    pose_covariance[planar] = sample.pose_covariance
    message.pose.covariance = pose_covariance.ravel().tolist()
    message.twist.covariance = (
        np.diag(
            [
                sample.speed_variance,
                NOT_MEASURED,
                NOT_MEASURED,
                NOT_MEASURED,
                NOT_MEASURED,
                sample.yaw_rate_variance,
            ]
        )
        .ravel()
        .tolist()
    )
    return message


def odometry_transform(sample):
    """Returns the TFMessage odom -> base_link of an OdometrySample."""
    return TFMessage([planar_transform(sample.stamp, ODOM, BASE, sample.pose)])


def planar_odometry(stamp, frame, child, pose, speed, yaw_rate):
    """Returns an Odometry of `child` at the planar `pose` in `frame`, without covariances."""
    message = Odometry(header=header(stamp, frame), child_frame_id=child)
    message.pose.pose.position = Point(pose[0], pose[1], 0.0)
    message.pose.pose.orientation = Quaternion(*transforms.quaternion_of_yaw(pose[2]))
    message.twist.twist.linear.x = speed
    message.twist.twist.angular.z = yaw_rate
    return message


def planar_transform(stamp, parent, child, pose):
    """Returns the TransformStamped of a planar `pose` (x, y, yaw) in `parent`."""
    matrix = transforms.rigid(np.eye(3), [pose[0], pose[1], 0.0])
    return transform(stamp, parent, child, matrix, transforms.quaternion_of_yaw(pose[2]))


def transform(stamp, parent, child, matrix, quaternion):
    """Returns the TransformStamped of a 4 x 4 `matrix`'s translation and a `quaternion` (xyzw)."""
    message = TransformStamped(header=header(stamp, parent), child_frame_id=child)
    message.transform.translation = Vector3(*matrix[:3, 3])
    message.transform.rotation = Quaternion(*quaternion)
    return message
