# SPDX-License-Identifier: BSD-3-Clause
"""Made-up recordings of a scanner with motion capture, as mocap_to_bag reads them."""

import math

import numpy as np
import rosbag
from genpy.dynamic import generate_dynamic
from geometry_msgs.msg import Point, PoseStamped, Quaternion, Vector3
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Header

from datmo_tools.stamps import to_ros_time
from datmo_tools.transforms import quaternion_of_yaw

START = 1_500_000_000 * 10**9  # ns
SCAN_PERIOD = 0.08  # s
SCANS = 11
CAPTURE_PERIOD = 0.01  # s

# The message of a package that need not be installed.
Encoder = generate_dynamic("barc/Encoder", "float32 FL\nfloat32 FR\nfloat32 BL\nfloat32 BR\n")[
    "barc/Encoder"
]


def nanoseconds(seconds):
    """Returns the stamp (ns) at `seconds` after START."""
    return START + round(seconds * 1e9)


def pose_message(seconds, pose):
    """Returns a PoseStamped of x, y, yaw."""
    return PoseStamped(
        header=Header(stamp=to_ros_time(nanoseconds(seconds)), frame_id="room"),
        pose=_pose(pose),
    )


def _pose(pose):
    message = PoseStamped().pose
    message.position = Point(pose[0], pose[1], 0.1)
    message.orientation = Quaternion(*quaternion_of_yaw(pose[2]))
    return message


def scan_message(seconds, ranges):
    """Returns a LaserScan of a full turn, counter-clockwise in the order of the message."""
    step = 2.0 * math.pi / len(ranges)
    return LaserScan(
        header=Header(stamp=to_ros_time(nanoseconds(seconds)), frame_id="laser"),
        angle_min=-math.pi + step,
        angle_max=math.pi,
        angle_increment=step,
        time_increment=1e-7,
        range_min=0.15,
        range_max=8.0,
        ranges=ranges,
    )


def imu_message(seconds, vertical, yaw_rate):
    """Returns an Imu that turns about `vertical` (unit vector in its frame)
    and measures gravity along it."""
    message = Imu(header=Header(stamp=to_ros_time(nanoseconds(seconds)), frame_id="imu"))
    message.angular_velocity = Vector3(*(yaw_rate * np.array(vertical)))
    message.linear_acceleration = Vector3(*(9.81 * np.array(vertical)))
    return message


def write_drive_sensors(bag, rates, vertical=(0.0, 0.0, 1.0), yaw_rate_bias=0.0):
    """Adds wheel speeds and an IMU to an open bag, 100 times in a second.

    rates: function of s that gives the wheels' speed and the yaw rate (rad/s).
    """
    for seconds in np.arange(0.0, SCANS * SCAN_PERIOD, 0.01):
        turning, yaw_rate = rates(seconds)
        stamp = to_ros_time(nanoseconds(seconds))
        bag.write("/wheel_speeds", Encoder(turning, turning, turning, 2.0 * turning), stamp)
        bag.write("/imu/data", imu_message(seconds, vertical, yaw_rate + yaw_rate_bias), stamp)


def write_recording(
    path, ego, red, ranges, topics=("/scan", "/ego_pose", "/red_pose"), drive_sensors=None
):
    """Writes a recording of 0.9 s.

    ego, red: functions of s that give x, y, yaw, or None where motion capture sees nothing;
    ranges: m, of every scan; drive_sensors: keyword arguments of write_drive_sensors, or None.
    """
    items = [
        (index * SCAN_PERIOD, "/scan", scan_message(index * SCAN_PERIOD, ranges))
        for index in range(SCANS)
    ]
    for seconds in np.arange(-0.1, SCANS * SCAN_PERIOD, CAPTURE_PERIOD):
        for topic, body in (("/ego_pose", ego), ("/red_pose", red)):
            if body(seconds) is not None:
                items.append((seconds, topic, pose_message(seconds, body(seconds))))
    with rosbag.Bag(str(path), "w") as bag:
        for seconds, topic, message in sorted(items, key=lambda item: item[0]):
            if topic in topics:
                bag.write(topic, message, to_ros_time(nanoseconds(seconds)))
        if drive_sensors is not None:
            write_drive_sensors(bag, **drive_sensors)
