"""Made-up recordings of a scanner with motion capture, as mocap_to_bag reads them."""

import math

import numpy as np
import rosbag
from geometry_msgs.msg import Point, PoseStamped, Quaternion
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header

from datmo_tools.stamps import to_ros_time
from datmo_tools.transforms import quaternion_of_yaw

START = 1_500_000_000 * 10**9  # ns
SCAN_PERIOD = 0.08  # s
SCANS = 11
CAPTURE_PERIOD = 0.01  # s


def nanoseconds(seconds):
    """Stamp (ns) at `seconds` after START."""
    return START + round(seconds * 1e9)


def pose_message(seconds, pose):
    """PoseStamped of x, y, yaw."""
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
    """LaserScan of a full turn, counter-clockwise in the order of the message."""
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


def write_recording(path, ego, red, ranges, topics=("/scan", "/ego_pose", "/red_pose")):
    """Writes a recording of 0.8 s.

    ego, red: functions of s that give x, y, yaw, or None where motion capture sees nothing;
    ranges: m, of every scan.
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
