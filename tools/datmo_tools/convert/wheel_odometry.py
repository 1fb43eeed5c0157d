# SPDX-License-Identifier: BSD-3-Clause
"""Computes a small car's odometry from its wheel speeds and its IMU's yaw rate."""

from typing import NamedTuple

import numpy as np

from datmo_tools.bag_input import opened
from datmo_tools.convert import odometry
from datmo_tools.convert.odometry import OdometryErrors
from datmo_tools.errors import InputError
from datmo_tools.pose_path import read_messages

WHEELS = ("FL", "FR", "BL", "BR")

# The IMU's bias is estimated from at least this many samples at which no wheel turned.
MIN_STANDING = 20

MIN_GRAVITY = 5.0  # m/s^2, of the mean acceleration: about half of gravity

# Standard deviations of the rates: encoders that count ticks, and an IMU on a vibrating car.
ERRORS = OdometryErrors(speed_noise=0.1, yaw_rate_noise=0.05)


class _Recorded(NamedTuple):
    stamps: np.ndarray  # ns, rising
    values: np.ndarray  # n x k


def has_topics(recording, *topics):
    """Whether a readable bag has all of these topics. Raises InputError if it is not a bag."""
    with opened(recording) as bag:
        return set(topics) <= set(bag.get_type_and_topic_info().topics)


def read_odometry(recording, wheels_topic, imu_topic, wheel_radius):
    """Returns a list of OdometrySample at the IMU's stamps.

    The speed is the median of the wheels' latest speeds (fields FL, FR, BL, BR, rad/s), which is
    robust to an encoder that counts double; the yaw rate is the rotation about the vertical, by
    gravity, however the IMU is mounted, minus its mean while no wheel turns. Raises InputError if a
    topic has another type or is empty.
    """
    wheels = _read_wheels(recording, wheels_topic)
    imu = _read_imu(recording, imu_topic)
    turning = np.median(wheels.values, axis=1)
    last = np.searchsorted(wheels.stamps, imu.stamps, side="right") - 1
    turning = np.where(last >= 0, turning[last], 0.0)
    yaw_rates = _yaw_rates(imu.values, standing=turning == 0.0)
    speeds = wheel_radius * turning
    return odometry.integrate(imu.stamps.tolist(), speeds, yaw_rates, ERRORS)


def _yaw_rates(measured, standing):
    """Returns the turn rate about the vertical (n, rad/s); measured: n x 6, gyro, acceleration."""
    gravity = np.mean(measured[:, 3:], axis=0)
    strength = np.linalg.norm(gravity)
    if not strength > MIN_GRAVITY:
        raise InputError(
            f"accelerations of the IMU: mean {strength:.2f} m/s^2, expected gravity (more than "
            f"{MIN_GRAVITY}): the vertical is not known"
        )
    rates = measured[:, :3] @ (gravity / strength)
    bias = np.mean(rates[standing]) if np.count_nonzero(standing) >= MIN_STANDING else 0.0
    return rates - bias


def _read_wheels(recording, topic):
    """Returns wheel speeds with their record times: the message has no stamp."""
    by_stamp = {}
    with opened(recording) as bag:
        for _, message, time in bag.read_messages([topic]):
            values = [getattr(message, wheel, np.nan) for wheel in WHEELS]
            if not np.all(np.isfinite(values)):
                raise InputError(
                    f"{recording}: {topic}: expected finite numbers {', '.join(WHEELS)}"
                )
            by_stamp[time.to_nsec()] = values
    return _recorded(recording, topic, by_stamp)


def _read_imu(recording, topic):
    by_stamp = {}
    for message, kind in read_messages(recording, topic):
        if kind != "sensor_msgs/Imu":
            raise InputError(f"{recording}: {topic} is {kind}, expected sensor_msgs/Imu")
        turn, push = message.angular_velocity, message.linear_acceleration
        values = [turn.x, turn.y, turn.z, push.x, push.y, push.z]
        if not np.all(np.isfinite(values)):
            raise InputError(f"{recording}: {topic}: {values}, expected finite numbers")
        by_stamp[message.header.stamp.to_nsec()] = values
    return _recorded(recording, topic, by_stamp)


def _recorded(recording, topic, by_stamp):
    if not by_stamp:
        raise InputError(f"{recording}: no message on {topic}, expected some")
    stamps = sorted(by_stamp)
    return _Recorded(np.array(stamps), np.array([by_stamp[stamp] for stamp in stamps], dtype=float))
