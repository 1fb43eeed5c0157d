# SPDX-License-Identifier: BSD-3-Clause
"""Stamps: ns since 1970 as integers in the tools, rospy's time in the messages."""

from decimal import Decimal, InvalidOperation

import genpy

NANOSECONDS = 10**9
LATEST = 2**32 * NANOSECONDS  # ROS has 32 bits for the seconds


def to_ros_time(stamp):
    """Returns the genpy.Time of `stamp` (ns)."""
    return genpy.Time(stamp // NANOSECONDS, stamp % NANOSECONDS)


def parse_seconds(text):
    """Returns the stamp (ns) of a decimal number of seconds since 1970, without rounding error.

    Raises ValueError if `text` is not a positive number that a ROS time can hold.
    """
    try:
        stamp = int(Decimal(text) * NANOSECONDS)
    except (InvalidOperation, OverflowError, ValueError) as error:
        raise ValueError(f"'{text}' is not a number of seconds") from error
    if not 0 < stamp < LATEST:
        raise ValueError(f"{text} s is not a time after 1970 that a ROS stamp can hold")
    return stamp
