"""Stamps: ns since 1970 as integers in the tools, rospy's time in the messages."""

import genpy

NANOSECONDS = 10**9


def to_ros_time(stamp):
    """genpy.Time of `stamp` (ns)."""
    return genpy.Time(stamp // NANOSECONDS, stamp % NANOSECONDS)
