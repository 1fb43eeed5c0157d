# SPDX-License-Identifier: BSD-3-Clause
"""Messages of objects shared by the tests of tools that read lists of objects."""

from datmo_tools import transforms
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3

from datmo_fusion.msg import Object

CAR_SIZE = (4.0, 1.8)  # m


def object_at(x, y, yaw=0.0, size=CAR_SIZE, classification=Object.CLASS_VEHICLE, delay=0.0,
              variance=0.01, side_variance=(0.0, 0.0, 0.0, 0.0)):  # fmt: skip
    """An object with its center at x, y (m); variance: of both, m^2."""
    position = Pose(Point(x, y, 0.0), Quaternion(*transforms.quaternion_of_yaw(yaw)))
    return Object(
        pose=position, size=Vector3(size[0], size[1], 1.5), classification=classification,
        position_covariance=[variance, 0.0, 0.0, variance], side_variance=list(side_variance),
        delay=delay, sensors=["test"],
    )  # fmt: skip
