# SPDX-License-Identifier: BSD-3-Clause
"""Checks frames: their names, their tree, and where the sensors are mounted."""

import math

from datmo_tools.check_bag.motion_signal import planar_mount
from datmo_tools.check_bag.transform_table import bare

MAX_TILT = math.radians(5.0)  # like grid_slam/max_tilt
MOUNT_MOVES = 0.02  # m
MOUNT_TURNS = math.radians(1.0)


def check_frames(recording, roles, findings):
    """Adds findings on the frames."""
    tree = recording.transforms
    _check_slashes(recording, findings)
    _check_tree(tree, findings)
    _check_topics(recording, findings)
    if roles.odometry:
        _check_odometry_frames(recording, roles, findings)
    if roles.scan:
        _check_mount(recording, roles, findings)
    if "map" in tree.parents(roles.odom_frame) or "map" in tree.parents(roles.base_frame):
        findings.note(
            "map_in_tf", "/tf",
            f"map -> {roles.odom_frame} from another SLAM or localization is recorded",
            "run_bag ignores it. With rosbag play, filter it out: grid_slam publishes it, too.",
        )  # fmt: skip


def scanner_mount(recording, roles):
    """Returns the 4 x 4 transform from the scanner to the base frame; None if not in tf."""
    if roles.scan_frame and roles.scan_frame == roles.base_frame:
        return recording.transforms.between(roles.base_frame, roles.base_frame)
    return recording.transforms.between(roles.base_frame, roles.scan_frame)


def _check_slashes(recording, findings):
    slashed = set(recording.transforms.slashed)
    for topic in recording.topics.values():
        names = [*topic.frames, *topic.children]
        slashed.update(name for name in names if name.startswith("/"))
    if slashed:
        findings.note(
            "slash_frames", "",
            f"frames with a leading slash, as tf 1 had them: {', '.join(sorted(slashed)[:6])}",
            "The stack strips the slash. Other tf2 programs do not: remove it in the drivers.",
        )  # fmt: skip


def _check_tree(tree, findings):
    for child in tree.children():
        parents = tree.parents(child)
        if len(parents) > 1:
            findings.error(
                "two_parents", child,
                f"the frame {child} has {len(parents)} parents: {', '.join(parents)}",
                "A frame has one parent: the last message wins, and the tree jumps. Stop one of "
                "the publishers, or filter its transforms out of the recording.",
            )  # fmt: skip
    if tree.loops():
        findings.error(
            "frame_loop", "/tf", "the tf tree has a loop",
            "See rosrun tf2_tools view_frames, and stop the publisher that closes the loop.",
        )  # fmt: skip
    for (parent, child), edge in sorted(tree.edges.items()):
        if not edge.valid:
            findings.error(
                "bad_transform", child,
                f"{parent} -> {child} is not finite, or its quaternion is not normalized",
                "tf2 rejects such transforms: correct the publisher.",
            )  # fmt: skip


def _check_topics(recording, findings):
    for topic in recording.topics.values():
        frames = {bare(frame) for frame in topic.frames}
        if len(frames) > 1 and topic.name in (*recording.scans, *recording.odometry):
            findings.warn(
                "frame_changes", topic.name,
                f"its messages are in {len(frames)} frames: {', '.join(sorted(frames))}",
                "Use one topic per sensor: to the stack, a topic is one scanner.",
            )  # fmt: skip
        if "" in frames and topic.name in (*recording.scans, *recording.clouds):
            findings.error(
                "no_frame", topic.name, "header.frame_id is empty",
                "Set the sensor's frame in its driver (usually the parameter frame_id).",
            )  # fmt: skip


def _check_odometry_frames(recording, roles, findings):
    topic = recording.topics[roles.odometry]
    child = topic.children.most_common(1)[0][0] if topic.children else ""
    if not child or not topic.frame():
        findings.error(
            "odometry_frame", topic.name,
            f"frame_id '{topic.frame()}', child_frame_id '{child}', expected two, e.g. odom and "
            "base_link",
            "Set header.frame_id and child_frame_id in the driver.",
        )  # fmt: skip
    elif bare(child) == bare(topic.frame()):
        findings.error(
            "odometry_frame", topic.name, f"{child} in {topic.frame()} is one frame, expected two",
            "child_frame_id is the vehicle's frame, header.frame_id the frame of its pose.",
        )  # fmt: skip
    elif bare(child) != "base_link" or bare(topic.frame()) != "odom":
        findings.note(
            "frame_names", topic.name,
            f"is of {bare(child)} in {bare(topic.frame())}; REP 105: base_link in odom",
            "The yaml sets them in its section frames.",
        )  # fmt: skip


def _check_mount(recording, roles, findings):
    mount = scanner_mount(recording, roles)
    if mount is None:
        _report_missing_mount(recording, roles, findings)
        return
    _, upside_down, tilt = planar_mount(mount)
    if tilt > MAX_TILT:
        findings.error(
            "scanner_tilted", roles.scan,
            f"{roles.scan_frame} is tilted by {math.degrees(tilt):.1f} degrees relative to "
            f"{roles.base_frame}, expected {math.degrees(MAX_TILT):.0f} or less",
            "Correct the transform. A scanner that is really tilted hits the ground.",
        )  # fmt: skip
    if upside_down:
        findings.note(
            "scanner_upside_down", roles.scan,
            f"according to tf {roles.scan_frame} is upside down: its bearings increase clockwise",
            "Nothing to do if it is mounted that way.",
        )  # fmt: skip
    for edge in recording.transforms.path(roles.base_frame, roles.scan_frame):
        if edge.moved > MOUNT_MOVES or edge.turned > MOUNT_TURNS:
            findings.warn(
                "mount_moves", roles.scan,
                f"the mount of {roles.scan_frame} on {roles.base_frame} changes by "
                f"{edge.moved:.2f} m and {math.degrees(edge.turned):.1f} degrees",
                "The stack uses the newest one. A scanner that rotates or nods is not planar.",
            )  # fmt: skip


def _report_missing_mount(recording, roles, findings):
    frames = recording.transforms.frames()
    known = "tf does not have it" if roles.scan_frame not in frames else (
        "tf has both, but does not connect them"
        if roles.base_frame in frames else f"tf does not have {roles.base_frame}"
    )  # fmt: skip
    findings.error(
        "missing_mount", roles.scan,
        f"the mount of {roles.scan_frame or 'the scanner'} on "
        f"{roles.base_frame} is not known: {known}",
        "Measure x, y (m) and yaw (rad) from the rear axle to the scanner, and set them under "
        "mounts in the yaml, where they are 0 now; or publish them on /tf_static: rosrun "
        "tf2_ros static_transform_publisher X Y Z YAW 0 0 "
        f"{roles.base_frame} {roles.scan_frame or 'SCANNER'}",
    )  # fmt: skip
