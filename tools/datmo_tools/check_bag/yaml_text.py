"""The first yaml of a robot: what differs from the defaults, and why."""

import yaml

from datmo_tools.check_bag.motion_signal import euler_degrees

HEADER = """\
# First parameters of the robot of {bag}, by check_bag.
# Only what differs from the defaults; all parameters and defaults: rosrun datmo_fusion list_parameters.
"""


def yaml_text(bag, sections, remarks):
    """Text of the yaml file. remarks: section -> why it is so, above the section."""
    parts = [HEADER.format(bag=bag)]
    for name, section in sections.items():
        lines = "".join(f"# {line}\n" for line in remarks.get(name, ()))
        body = yaml.safe_dump({name: section}, sort_keys=False, default_flow_style=False)
        parts.append(lines + body)
    return "\n".join(parts)


def frames_section(roles):
    """Section frames: names that differ from REP 105."""
    section = {}
    if roles.odom_frame != "odom":
        section["odom"] = roles.odom_frame
    if roles.base_frame != "base_link":
        section["base"] = roles.base_frame
    return section


def mounts_section(recording, roles):
    """Section mounts: frames without a way to the base frame, at 0 until they are measured."""
    frames = [roles.scan_frame] if roles.scan else []
    return {
        frame: {"x": 0.0, "y": 0.0, "z": 0.0, "yaw": 0.0}
        for frame in frames
        if frame and frame != roles.base_frame
        and recording.transforms.between(roles.base_frame, frame) is None
    }  # fmt: skip


def mount_text(matrix):
    """A mount in words."""
    x, y, z = matrix[:3, 3]
    roll, pitch, yaw = euler_degrees(matrix)
    return f"x {x:.3f}, y {y:.3f}, z {z:.3f} m, roll {roll:.1f}, pitch {pitch:.1f}, yaw {yaw:.1f} deg"
