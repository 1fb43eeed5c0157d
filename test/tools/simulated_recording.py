# SPDX-License-Identifier: BSD-3-Clause
"""A made-up recording of a car in a street: scanner, odometry, IMU, stereo camera, all correct.

A test takes its messages, makes one fault, and writes them as a bag.
"""

import math
import pickle
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import rosbag
from geometry_msgs.msg import Point, Quaternion, TransformStamped, Vector3
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, Imu, LaserScan
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from datmo_tools import transforms
from datmo_tools.stamps import to_ros_time

START = 1_600_000_000 * 10**9  # ns
DURATION = 10.0  # s
STANDING = 2.0  # s, at the beginning
LATENCY = 0.01  # s, from the stamp to the record
SCAN_PERIOD, ODOMETRY_PERIOD, IMU_PERIOD, IMAGE_PERIOD = 0.1, 0.02, 0.02, 0.1  # s
BEAMS = 271
RANGE_MAX, RANGE_NOISE = 60.0, 0.03  # m
MOUNT = np.array([1.5, 0.0, 0.0])  # of the scanner: x, y (m), yaw (rad)
WIDTH, HEIGHT, FOCAL_LENGTH, BASELINE = 64, 48, 50.0, 0.5  # px, px, px, m
TIME_STEP = 0.005  # s, of the simulation


class Item(NamedTuple):
    """One message of the recording."""

    recorded: float  # s since START
    topic: str
    message: Any


def motion_at(seconds):
    """Returns speed (m/s) and yaw rate (rad/s): the car is at rest, starts, and drives in curves."""
    if seconds < STANDING:
        return 0.0, 0.0
    moving = seconds - STANDING
    return min(2.5 * moving, 5.0), 0.45 * math.sin(2.0 * math.pi * moving / 3.7)


@lru_cache(maxsize=None)
def _path():
    poses = [np.array([5.0, 0.0, 0.0])]
    for step in range(int((DURATION + 1.0) / TIME_STEP)):
        speed, yaw_rate = motion_at((step + 0.5) * TIME_STEP)
        poses.append(transforms.compose(poses[-1], transforms.arc(speed, yaw_rate, TIME_STEP)))
    return np.array(poses)


def pose_at(seconds):
    """Returns x, y, yaw of base_link at a time."""
    return _path()[min(max(round(seconds / TIME_STEP), 0), len(_path()) - 1)]


def _box(x, y, length, width):
    corners = np.array([[x, y], [x + length, y], [x + length, y + width], [x, y + width]])
    return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)


@lru_cache(maxsize=None)
def _walls():
    """Returns n x 2 x 2: houses with gaps on both sides, and parked cars;
    closed behind, open ahead."""
    boxes = [_box(-30.0, -20.0, 1.0, 40.0), _box(120.0, -20.0, 1.0, 40.0)]
    for index in range(14):
        x = -28.0 + 11.0 * index
        boxes.append(_box(x, 9.0 + 1.5 * (index % 3), 7.0 + index % 2, 6.0))
        boxes.append(_box(x + 4.0, -16.0 - 1.2 * (index % 2), 8.0, 6.0))
    boxes += [_box(x, -7.0, 4.2, 1.7) for x in (2.0, 14.0, 21.0, 40.0, 55.0)]
    return np.concatenate(boxes)


def _ranges(pose, bearings):
    """Returns distances (m) from the scanner at `pose` to the nearest
    wall along bearings; inf: none."""
    angles = pose[2] + bearings
    directions = np.column_stack([np.cos(angles), np.sin(angles)])[:, None, :]
    begin, end = _walls()[None, :, 0], _walls()[None, :, 1]
    along, apart = end - begin, begin - pose[:2]
    cross = directions[..., 0] * along[..., 1] - directions[..., 1] * along[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (apart[..., 0] * along[..., 1] - apart[..., 1] * along[..., 0]) / cross
        share = (apart[..., 0] * directions[..., 1] - apart[..., 1] * directions[..., 0]) / cross
    distance[~((distance > 0.0) & (share >= 0.0) & (share <= 1.0))] = math.inf
    return distance.min(axis=1)


def ros_time(seconds):
    """Returns the genpy.Time of this many seconds after START."""
    return to_ros_time(START + round(seconds * 1e9))


def _header(seconds, frame):
    return Header(stamp=ros_time(seconds), frame_id=frame)


def _scan(seconds, random):
    field = math.radians(BEAMS - 1)
    bearings = np.linspace(-0.5 * field, 0.5 * field, BEAMS)
    ranges = _ranges(transforms.compose(pose_at(seconds), MOUNT), bearings)
    ranges = ranges + random.normal(0.0, RANGE_NOISE, BEAMS)
    ranges[ranges >= RANGE_MAX] = math.inf
    return LaserScan(
        header=_header(seconds, "laser"),
        angle_min=-0.5 * field,
        angle_max=0.5 * field,
        angle_increment=math.radians(1.0),
        time_increment=1e-9,
        scan_time=SCAN_PERIOD,
        range_min=0.1,
        range_max=RANGE_MAX,
        ranges=ranges.tolist(),
    )


def odometry(seconds, pose, speed, yaw_rate):
    """Returns the odometry of base_link in odom."""
    message = Odometry(header=_header(seconds, "odom"), child_frame_id="base_link")
    message.pose.pose.position = Point(pose[0], pose[1], 0.0)
    message.pose.pose.orientation = Quaternion(*transforms.quaternion_of_yaw(pose[2]))
    message.twist.twist.linear.x = speed
    message.twist.twist.angular.z = yaw_rate
    return message


def _imu(seconds):
    message = Imu(header=_header(seconds, "imu"))
    message.angular_velocity = Vector3(0.0, 0.0, motion_at(seconds)[1])
    message.linear_acceleration = Vector3(0.0, 0.0, 9.81)
    return message


def transform(seconds, parent, child, translation, quaternion=(0.0, 0.0, 0.0, 1.0)):
    """Returns a TFMessage of one transform."""
    item = TransformStamped(header=_header(seconds, parent), child_frame_id=child)
    item.transform.translation = Vector3(*translation)
    item.transform.rotation = Quaternion(*quaternion)
    return TFMessage([item])


def _camera_info(seconds, shift):
    info = CameraInfo(header=_header(seconds, "camera"), width=WIDTH, height=HEIGHT)
    center = 0.5 * WIDTH, 0.5 * HEIGHT
    info.K = [FOCAL_LENGTH, 0.0, center[0], 0.0, FOCAL_LENGTH, center[1], 0.0, 0.0, 1.0]
    info.P = [FOCAL_LENGTH, 0.0, center[0], shift, 0.0, FOCAL_LENGTH, center[1], 0.0,
              0.0, 0.0, 1.0, 0.0]  # fmt: skip
    return info


def _image(seconds):
    return Image(header=_header(seconds, "camera"), width=WIDTH, height=HEIGHT, encoding="mono8",
                 step=WIDTH, data=bytes(WIDTH * HEIGHT))  # fmt: skip


def _times(period):
    return np.arange(0.0, DURATION, period) + 0.05


@lru_cache(maxsize=None)
def _items():
    random = np.random.default_rng(1)
    items = [
        Item(0.0, "/tf_static", transform(0.0, "base_link", "laser", [*MOUNT[:2], 0.4])),
        Item(0.0, "/tf_static",
             transform(0.0, "base_link", "camera", (1.0, 0.25, 1.2), (-0.5, 0.5, -0.5, 0.5))),
    ]  # fmt: skip
    for time in _times(SCAN_PERIOD):
        items.append(Item(time + LATENCY, "/scan", _scan(time, random)))
    for time in _times(ODOMETRY_PERIOD):
        pose = pose_at(time)
        items.append(Item(time + LATENCY, "/odometry", odometry(time, pose, *motion_at(time))))
        moved = transform(time, "odom", "base_link", (*pose[:2], 0.0),
                          transforms.quaternion_of_yaw(pose[2]))  # fmt: skip
        items.append(Item(time + LATENCY, "/tf", moved))
    items += [Item(time + LATENCY, "/imu", _imu(time)) for time in _times(IMU_PERIOD)]
    for time in _times(IMAGE_PERIOD):
        for side, shift in (("left", 0.0), ("right", -FOCAL_LENGTH * BASELINE)):
            name = f"/stereo/{side}/"
            items.append(Item(time + LATENCY, name + "image_rect", _image(time)))
            items.append(Item(time + LATENCY, name + "camera_info", _camera_info(time, shift)))
    return items


@lru_cache(maxsize=None)
def _pickled_items():
    return pickle.dumps(_items())


def recording():
    """Returns a list of Item: a recording without faults, as a copy that may be changed."""
    return pickle.loads(_pickled_items())  # a tenth of deepcopy's time


def write(path, items):
    """Writes the bag `path` (Path)."""
    with rosbag.Bag(str(path), "w") as bag:
        for item in sorted(items, key=lambda item: item.recorded):
            bag.write(item.topic, item.message, ros_time(item.recorded))
