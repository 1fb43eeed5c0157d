# SPDX-License-Identifier: BSD-3-Clause
"""Writes the initial yaml of a robot: what differs from the defaults, and why."""

import math

import yaml

from datmo_tools.check_bag.levels import motion_source
from datmo_tools.check_bag.motion_signal import euler_degrees
from datmo_tools.check_bag.transform_table import bare
from datmo_tools.text_table import one_line

HEADER = """\
# Initial parameters for the robot of {bag}, by check_bag.
# Only what differs from the defaults; all parameters and defaults: rosrun datmo_fusion list_parameters.
"""

AT_BASE = {"x": 0.0, "y": 0.0, "z": 0.0}  # m
LOOKS_AHEAD = {"yaw": -1.5708, "pitch": 0.0, "roll": -1.5708}  # rad, of an optical frame


def yaml_text(bag, sections, remarks):
    """Returns the text of the yaml file. remarks: section -> comment lines above the section."""
    parts = [HEADER.format(bag=one_line(bag))]
    for name, section in sections.items():
        lines = "".join(f"# {one_line(line)}\n" for line in remarks.get(name, ()))
        body = yaml.safe_dump({name: section}, sort_keys=False, default_flow_style=False)
        parts.append(lines + body)
    return "\n".join(parts)


def frames_section(roles):
    """Returns the section frames: names that differ from REP 105."""
    section = {}
    if roles.odom_frame != "odom":
        section["odom"] = roles.odom_frame
    if roles.base_frame != "base_link":
        section["base"] = roles.base_frame
    return section


def mounts_section(recording, roles):
    """Returns the section mounts: frames not connected to the base, at 0 until measured."""
    section = {}
    if _lacks_mount(recording, roles, roles.scan_frame):
        section[roles.scan_frame] = dict(AT_BASE, yaw=0.0)
    for name in (roles.left_image, *roles.camera_clouds[:1]):
        frame = bare(recording.topics[name].frame()) if name else ""
        if _lacks_mount(recording, roles, frame):
            section[frame] = {**AT_BASE, **LOOKS_AHEAD}
    frame = imu_frame_without_mount(recording, roles)
    if frame:
        section[frame] = _tilt(recording.imus[roles.imu].up())
    return section


def imu_frame_without_mount(recording, roles):
    """Returns the frame of the IMU that is the motion source if it has no mount, otherwise ""."""
    if not roles.imu or "imu" not in motion_source(roles, recording).split("_"):
        return ""
    frame = bare(recording.topics[roles.imu].frame())
    return frame if _lacks_mount(recording, roles, frame) else ""


def _tilt(up):
    """Returns the mount of an IMU by `up`: unit vector opposite to gravity in its frame, or None.

    A yaw rate needs neither its position nor its yaw.
    """
    if up is None:
        return {"roll": 0.0, "pitch": 0.0}
    roll, pitch = math.atan2(up[1], up[2]), -math.asin(min(max(up[0], -1.0), 1.0))
    return {"roll": round(roll, 3), "pitch": round(pitch, 3)}


def _lacks_mount(recording, roles, frame):
    is_mounted = recording.transforms.between(roles.base_frame, frame) is not None
    return bool(frame) and frame != roles.base_frame and not is_mounted


def mount_text(matrix):
    """Describes a mount in words."""
    x, y, z = matrix[:3, 3]
    roll, pitch, yaw = euler_degrees(matrix)
    return f"x {x:.3f}, y {y:.3f}, z {z:.3f} m, roll {roll:.1f}, pitch {pitch:.1f}, yaw {yaw:.1f} deg"
