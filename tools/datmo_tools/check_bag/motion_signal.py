# SPDX-License-Identifier: BSD-3-Clause
"""Heading and distance over time as measured by a sensor of the vehicle's own motion."""

import math

import numpy as np

from datmo_tools import transforms

MAX_DURATION = 1e5  # s: a longer signal has stray stamps


class MotionSignal:
    """Heading, and position if known, over time; each at the sensor's own stamps."""

    def __init__(self, source, stamps, headings, positions):
        """source: topic and field; stamps: s, increasing; headings: rad, unwrapped, or None;
        positions: n x 2, m, in a fixed frame, or None."""
        self.source = source
        self.stamps = stamps
        self.headings = headings
        self.positions = positions

    def turns(self, starts, ends):
        """Returns the turn (rad) between each two times (s)."""
        at = np.interp(ends, self.stamps, self.headings)
        return at - np.interp(starts, self.stamps, self.headings)

    def motions(self, starts, ends):
        """Returns the motion (n x 2, m) between each two times, in the frame of the first pose."""
        first, last = self._positions(starts), self._positions(ends)
        heading = np.interp(starts, self.stamps, self.headings)
        apart = last - first
        cosine, sine = np.cos(heading), np.sin(heading)
        return np.column_stack(
            [cosine * apart[:, 0] + sine * apart[:, 1], cosine * apart[:, 1] - sine * apart[:, 0]]
        )

    def _positions(self, times):
        columns = [np.interp(times, self.stamps, self.positions[:, axis]) for axis in (0, 1)]
        return np.column_stack(columns)

    def covers(self, starts, ends):
        """Returns a mask of the intervals that are within the signal."""
        return (starts >= self.stamps[0]) & (ends <= self.stamps[-1])

    def speeds(self):
        """Returns speeds (m/s) between stamps at least 0.1 s apart; empty without positions."""
        if self.positions is None:
            return np.zeros(0)
        start, end = self.stamps[0], self.stamps[-1]
        if end - start > MAX_DURATION and len(self.stamps) > 3:
            stray = 1 + len(self.stamps) // 100  # at each end
            start, end = self.stamps[stray], self.stamps[-1 - stray]
        if not 0.1 < end - start < MAX_DURATION:
            return np.zeros(0)
        times = np.arange(start, end, 0.1)
        return np.linalg.norm(np.diff(self._positions(times), axis=0), axis=1) / 0.1


def _rising(stamps):
    """Returns indices that sort stamps in increasing order, without duplicates."""
    _, indices = np.unique(stamps, return_index=True)
    return indices


def integrated(source, stamps, speeds, yaw_rates):
    """Returns the MotionSignal of rates (m/s or None, rad/s or None) at stamps (s), or None."""
    order = _rising(stamps)
    stamps = stamps[order]
    if len(stamps) < 3:
        return None
    steps = np.diff(stamps)
    rates = yaw_rates[order] if yaw_rates is not None else np.zeros(len(stamps))
    headings = _sum(steps, rates)
    positions = None
    if speeds is not None:
        along = speeds[order]
        positions = np.column_stack(
            [_sum(steps, along * np.cos(headings)), _sum(steps, along * np.sin(headings))]
        )
    return MotionSignal(source, stamps, headings if yaw_rates is not None else None, positions)


def _sum(steps, rates):
    return np.concatenate([[0.0], np.cumsum(0.5 * steps * (rates[1:] + rates[:-1]))])


class OdometrySamples:
    """Samples of Odometry messages: poses and twists."""

    def __init__(self):
        self._rows = []

    def add(self, message, stamp):
        """Adds an Odometry."""
        pose, twist = message.pose.pose, message.twist.twist
        turn = pose.orientation
        yaw = math.atan2(
            2.0 * (turn.w * turn.z + turn.x * turn.y),
            1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z),
        )
        norm = math.hypot(turn.x, turn.y, turn.z, turn.w)
        self._rows.append(
            (stamp, pose.position.x, pose.position.y, yaw, norm, twist.linear.x, twist.angular.z)
        )

    def table(self):
        """Returns n x 7: stamp, x, y, yaw, norm of the quaternion, speed, yaw rate."""
        return np.array(self._rows, dtype=float).reshape(-1, 7)

    def by_pose(self, source):
        """Returns the MotionSignal of the poses; None if too few."""
        table = self._usable(slice(1, 5))
        if len(table) < 3:
            return None
        return MotionSignal(
            source + " (pose)", table[:, 0], np.unwrap(table[:, 3]), table[:, 1:3]
        )

    def by_twist(self, source):
        """Returns the MotionSignal of the twists; None if too few."""
        table = self._usable(slice(5, 7))
        return integrated(source + " (twist)", table[:, 0], table[:, 5], table[:, 6])

    def _usable(self, columns):
        table = self.table()
        table = table[np.all(np.isfinite(table[:, columns]), axis=1)]
        return table[_rising(table[:, 0])]


class TwistSamples:
    """Samples of TwistStamped messages."""

    def __init__(self):
        self._rows = []

    def add(self, message, stamp):
        """Adds a TwistStamped or TwistWithCovarianceStamped."""
        twist = getattr(message.twist, "twist", message.twist)
        self._rows.append((stamp, twist.linear.x, twist.angular.z))

    def signal(self, source):
        """Returns the MotionSignal; None if too few."""
        table = np.array(self._rows, dtype=float).reshape(-1, 3)
        table = table[np.all(np.isfinite(table), axis=1)]
        return integrated(source, table[:, 0], table[:, 1], table[:, 2])


class ImuSamples:
    """Samples of Imu messages."""

    def __init__(self):
        self._rows = []

    def add(self, message, stamp):
        """Adds an Imu."""
        rate, pull = message.angular_velocity, message.linear_acceleration
        self._rows.append((stamp, rate.x, rate.y, rate.z, pull.x, pull.y, pull.z))

    def table(self):
        """Returns n x 7: stamp, angular velocity, acceleration; finite rows only."""
        table = np.array(self._rows, dtype=float).reshape(-1, 7)
        return table[np.all(np.isfinite(table), axis=1)]

    def up(self):
        """Returns the unit vector opposite to gravity, in the IMU's frame; None without gravity."""
        table = self.table()
        mean = table[:, 4:].mean(axis=0) if len(table) else np.zeros(3)
        length = np.linalg.norm(mean)
        return mean / length if length > 5.0 else None

    def signal(self, source, up=None):
        """Returns the MotionSignal of the turns about `up` (default: z); None if too few."""
        table = self.table()
        axis = np.array([0.0, 0.0, 1.0]) if up is None else up
        return integrated(source, table[:, 0], None, table[:, 1:4] @ axis)


def planar_mount(matrix):
    """Returns (x, y, yaw), upside down, tilt (rad) of a sensor's 4 x 4 transform to the vehicle."""
    upside_down = matrix[2, 2] < 0.0
    tilt = math.acos(min(abs(matrix[2, 2]), 1.0))
    return np.array([matrix[0, 3], matrix[1, 3], transforms.yaw_of(matrix)]), upside_down, tilt


def euler_degrees(matrix):
    """Returns roll, pitch, yaw in degrees of a 4 x 4 transform."""
    return transforms.rotation_of(matrix[:3, :3]).as_euler("xyz", degrees=True)
