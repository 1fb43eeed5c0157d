# SPDX-License-Identifier: BSD-3-Clause
"""What is kept of the messages of a recording: numbers, never whole images or clouds."""

import math
from typing import NamedTuple

import numpy as np


class ScanSample(NamedTuple):
    """One planar scan."""

    stamp: float  # s since the start of the recording, from its header
    index: int  # of the message on its topic
    angle_min: float  # rad
    angle_max: float  # rad
    angle_increment: float  # rad
    time_increment: float  # s
    scan_time: float  # s
    range_min: float  # m
    range_max: float  # m
    ranges: np.ndarray  # m, as recorded

    @property
    def bearings(self):
        """Returns the bearing (rad) of each beam."""
        return self.angle_min + self.angle_increment * np.arange(len(self.ranges))

    @property
    def sweep(self):
        """Returns the time (s) from the first beam to the last; 0 if the scan does not state it."""
        sweep = self.time_increment * max(len(self.ranges) - 1, 0)
        return sweep if math.isfinite(sweep) and sweep > 0.0 else 0.0

    @property
    def hits(self):
        """Returns a mask of the beams that returned."""
        return (
            np.isfinite(self.ranges)
            & (self.ranges >= self.range_min)
            & (self.ranges < self.range_max)
            & (self.ranges > 0.0)
        )


class CloudSample(NamedTuple):
    """The first cloud of a topic."""

    frame: str
    width: int
    height: int
    fields: tuple  # names
    points: np.ndarray  # n x 3, m, finite ones only, subsampled


class JointSample(NamedTuple):
    """One message of joint states."""

    names: tuple
    has_position: bool
    has_velocity: bool


class ImageShape(NamedTuple):
    """The first image of a topic."""

    frame: str
    width: int  # px
    height: int  # px
    encoding: str


def scan_sample(message, stamp, index):
    """Returns the ScanSample of a LaserScan, or of a MultiEchoLaserScan's nearest valid echoes."""
    ranges = message.ranges
    if ranges and hasattr(ranges[0], "echoes"):
        ranges = [_nearest(beam.echoes, message) for beam in ranges]
    return ScanSample(
        stamp,
        index,
        message.angle_min,
        message.angle_max,
        message.angle_increment,
        message.time_increment,
        message.scan_time,
        message.range_min,
        message.range_max,
        np.asarray(ranges, dtype=np.float32).astype(float),
    )


def _nearest(echoes, message):
    valid = [echo for echo in echoes if message.range_min <= echo < message.range_max]
    return min(valid) if valid else math.inf


def cloud_sample(message, max_points=20000):
    """Returns the CloudSample of a PointCloud2; without points unless x, y, z are three floats."""
    fields = {field.name: field for field in message.fields}
    points = np.zeros((0, 3))
    if all(name in fields and fields[name].datatype == 7 for name in "xyz"):
        points = _points(message, [fields[name].offset for name in "xyz"])
    points = points[np.all(np.isfinite(points), axis=1)]
    points = points[:: max(1, len(points) // max_points)]
    return CloudSample(
        message.header.frame_id, message.width, message.height, tuple(fields), points
    )


def _points(message, offsets):
    order = ">" if message.is_bigendian else "<"
    layout = np.dtype(
        {
            "names": ["x", "y", "z"],
            "formats": [order + "f4"] * 3,
            "offsets": offsets,
            "itemsize": message.point_step,
        }
    )
    count = min(message.width * message.height, len(message.data) // max(message.point_step, 1))
    values = np.frombuffer(message.data, dtype=layout, count=count)
    return np.column_stack([values["x"], values["y"], values["z"]]).astype(float)


def joint_sample(message):
    """Returns the JointSample of a JointState."""
    return JointSample(tuple(message.name), bool(message.position), bool(message.velocity))


def image_shape(message):
    """Returns the ImageShape of an Image."""
    return ImageShape(message.header.frame_id, message.width, message.height, message.encoding)
