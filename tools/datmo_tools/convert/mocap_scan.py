# SPDX-License-Identifier: BSD-3-Clause
"""Converts a recorded scan: beams in order of time, with corrected times and ranges."""

import math

import numpy as np
from sensor_msgs.msg import LaserScan

from datmo_tools.bag_messages import SCANNER, header


def usable(message):
    """Whether a recorded LaserScan has beams and an angle between them."""
    return len(message.ranges) > 1 and message.angle_increment != 0.0


def converted(message, stamp, sweep_time, options):
    """Converts a recorded LaserScan; the result is stamped with its first beam's time (ns).

    sweep_time: s from the first beam to the last; options: those of mocap_bag. Readings outside the
    recorded limits become +inf: no return.
    """
    ranges = np.array(message.ranges, dtype=float)
    valid = (ranges >= message.range_min) & (ranges < message.range_max)
    ranges[~valid] = math.inf
    ranges[valid] = corrected(ranges[valid], options.range_errors)
    last = len(ranges) - 1
    first_bearing, step = message.angle_min, message.angle_increment
    if options.clockwise:
        ranges = ranges[::-1]
        first_bearing, step = message.angle_min + last * step, -step
    return LaserScan(
        header=header(stamp, SCANNER),
        angle_min=first_bearing,
        angle_max=first_bearing + last * step,
        angle_increment=step,
        time_increment=sweep_time / last,
        scan_time=sweep_time,
        range_min=message.range_min,
        range_max=float(corrected(message.range_max, options.range_errors)),
        ranges=ranges.astype(np.float32).tolist(),
    )


def corrected(ranges, range_errors):
    """Corrects range(s) (m) that are short; outside the table, its ends are used.

    range_errors: increasing pairs (range, error), m, one or more.
    """
    at, short = zip(*range_errors)
    return ranges + np.interp(ranges, at, short)


def end_points(scan):
    """Returns the end points (n x 2, m) of a converted scan, in its frame."""
    ranges = np.array(scan.ranges)
    bearings = scan.angle_min + np.arange(len(ranges)) * scan.angle_increment
    hit = np.isfinite(ranges)
    directions = np.column_stack([np.cos(bearings[hit]), np.sin(bearings[hit])])
    return ranges[hit, None] * directions
