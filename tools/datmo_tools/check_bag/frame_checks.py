# SPDX-License-Identifier: BSD-3-Clause
"""Frames: their names, their tree, and where the sensors are mounted."""

import math

from datmo_tools.check_bag.motion_signal import planar_mount
from datmo_tools.check_bag.transform_table import bare

MAX_TILT = math.radians(5.0)  # as grid_slam/max_tilt
MOUNT_MOVES = 0.02  # m
MOUNT_TURNS = math.radians(1.0)


def check_frames(recording, roles, findings):
    """Adds what is wrong with the frames."""
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
            f"map -> {roles.odom_frame} of another SLAM or localization is recorded",
            "run_bag leaves it out. With rosbag play, filter it: grid_slam publishes it as well.",
        )  # fmt: skip


def scanner_mount(recording, roles):
    """4 x 4 transform of the scanner's points to the base frame; None where tf does not say."""
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
            "The stack takes the slash off. Other tf2 programs do not: take it off in the drivers.",
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
            "frame_loop", "/tf", "the tree of frames has a loop",
            "Look at it with rosrun tf2_tools view_frames, and stop the publisher that closes it.",
        )  # fmt: skip
    for (parent, child), edge in sorted(tree.edges.items()):
        if not edge.valid:
            findings.error(
                "bad_transform", child,
                f"{parent} -> {child} is not finite, or its quaternion is not of length 1",
                "tf2 refuses such transforms: correct the publisher.",
            )  # fmt: skip


def _check_topics(recording, findings):
    for topic in recording.topics.values():
        frames = {bare(frame) for frame in topic.frames}
        if len(frames) > 1 and topic.name in (*recording.scans, *recording.odometry):
            findings.warn(
                "frame_changes", topic.name,
                f"its messages are in {len(frames)} frames: {', '.join(sorted(frames))}",
                "One topic a sensor: the stack takes a topic for one scanner.",
            )  # fmt: skip
        if "" in frames and topic.name in (*recording.scans, *recording.clouds):
            findings.error(
                "no_frame", topic.name, "header.frame_id is empty",
                "Name the sensor's frame in its driver (parameter frame_id in most).",
            )  # fmt: skip


def _check_odometry_frames(recording, roles, findings):
    topic = recording.topics[roles.odometry]
    child = topic.children.most_common(1)[0][0] if topic.children else ""
    if not child or not topic.frame():
        findings.error(
            "odometry_frame", topic.name,
            f"is in '{topic.frame()}', child_frame_id '{child}', expected two frames as odom and "
            "base_link",
            "Fill header.frame_id and child_frame_id in the driver.",
        )  # fmt: skip
    elif bare(child) == bare(topic.frame()):
        findings.error(
            "odometry_frame", topic.name, f"is of {child} in {topic.frame()}: one frame",
            "child_frame_id is the vehicle, header.frame_id the frame in which it is.",
        )  # fmt: skip
    elif bare(child) != "base_link" or bare(topic.frame()) != "odom":
        findings.note(
            "frame_names", topic.name,
            f"is of {bare(child)} in {bare(topic.frame())}, where REP 105 has base_link in odom",
            "The yaml names them in its section frames.",
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
            f"{roles.scan_frame} is tilted by {math.degrees(tilt):.1f} degrees against "
            f"{roles.base_frame}, expected {math.degrees(MAX_TILT):.0f} or less",
            "Correct the transform. A scanner that is really tilted meets the ground.",
        )  # fmt: skip
    if upside_down:
        findings.note(
            "scanner_upside_down", roles.scan,
            f"by tf {roles.scan_frame} hangs upside down: its bearings count to the right",
            "Nothing to do if it does hang so.",
        )  # fmt: skip
    for edge in recording.transforms.path(roles.base_frame, roles.scan_frame):
        if edge.moved > MOUNT_MOVES or edge.turned > MOUNT_TURNS:
            findings.warn(
                "mount_moves", roles.scan,
                f"the mount of {roles.scan_frame} on {roles.base_frame} changes by "
                f"{edge.moved:.2f} m and {math.degrees(edge.turned):.1f} degrees",
                "The stack takes the newest one. A scanner that turns or nods is no planar one.",
            )  # fmt: skip


def _report_missing_mount(recording, roles, findings):
    frames = recording.transforms.frames()
    known = "tf does not have it at all" if roles.scan_frame not in frames else (
        "tf has both, but does not connect them"
        if roles.base_frame in frames else f"tf does not have {roles.base_frame}"
    )  # fmt: skip
    findings.error(
        "missing_mount", roles.scan,
        f"nothing says where {roles.scan_frame or 'the scanner'} is mounted on "
        f"{roles.base_frame}: {known}",
        "Measure x, y (m) and yaw (rad) from the rear axle to the scanner, and put them under "
        "mounts in the yaml, where 0 stands now; or publish them on /tf_static: rosrun "
        "tf2_ros static_transform_publisher X Y Z YAW 0 0 "
        f"{roles.base_frame} {roles.scan_frame or 'SCANNER'}",
    )  # fmt: skip
