# SPDX-License-Identifier: BSD-3-Clause
"""Checks which sensors a recording has, and what replaces those that are missing."""

from datmo_tools.bag_input import OTHER_VERSION_ADVICE, other_version
from datmo_tools.check_bag.levels import motion_source
from datmo_tools.check_bag.yaml_text import imu_frame_without_mount

MOTION_TEXTS = {
    "twist": "the speeds of {twist} (geometry_msgs/TwistStamped) are used instead",
    "imu_and_twist": "the yaw rate of {imu} and the speed of {twist} are used instead",
    "imu_and_wheels": "the yaw rate of {imu} and the wheels of {wheels} are used instead",
    "imu": "the yaw rate of {imu} is used, the speed comes from the scans",
}


def check_presence(recording, roles, findings):
    """Adds findings on sensors that are missing altogether."""
    if not recording.topics:
        findings.error("empty", "", "the recording has no messages", "Record again.")
        return
    _check_scan(recording, roles, findings)
    _check_motion(recording, roles, findings)
    for name, why in recording.undecoded.items():
        findings.error(
            "undecodable", name, f"a message cannot be decoded ({why})",
            "The recording is damaged, or was written with another message definition.",
        )  # fmt: skip
    for name, datatype in recording.other_versions.items():
        findings.warn(
            "other_version", name, f"is {other_version(datatype)}: it cannot be read",
            f"{OTHER_VERSION_ADVICE}.",
        )  # fmt: skip


def _check_scan(recording, roles, findings):
    if roles.scan is None and not roles.lidar_clouds:
        findings.error(
            "no_scan", "", "no planar scan (sensor_msgs/LaserScan or MultiEchoLaserScan)",
            "The stack needs one: record the scanner's topic.",
        )  # fmt: skip
    if len(roles.scans) > 1:
        findings.note(
            "several_scanners", roles.scan,
            f"{len(roles.scans)} scanners: {', '.join(roles.scans)}; {roles.scan} is used",
            "--scan selects another one. The stack uses one scanner.",
        )  # fmt: skip
    if len(roles.odometries) > 1:
        findings.note(
            "several_odometries", roles.odometry,
            f"{len(roles.odometries)} odometries: {', '.join(roles.odometries)}; {roles.odometry} "
            "is used", "--odometry selects another one.",
        )  # fmt: skip


def _check_motion(recording, roles, findings):
    source = motion_source(roles, recording)
    if source == "odometry":
        return
    if source == "none":
        findings.warn(
            "no_odometry", "", "no odometry (nav_msgs/Odometry), twist or IMU",
            "It runs without one (motion/source: none in the yaml), but in corridors and fast "
            "turns the pose is lost sooner: record the wheels' odometry.",
        )  # fmt: skip
    else:
        text = MOTION_TEXTS[source].format(
            twist=roles.twist, imu=roles.imu, wheels=", ".join(roles.wheels)
        )
        findings.warn(
            "no_odometry", "", f"no odometry (nav_msgs/Odometry): {text}",
            "The yaml is set accordingly (motion/source).",
        )  # fmt: skip
    frame = imu_frame_without_mount(recording, roles)
    if frame:
        findings.warn(
            "missing_imu_mount", roles.imu,
            f"the mount of {frame} on {roles.base_frame} is not known",
            "The yaml has roll and pitch from gravity under mounts; a yaw rate needs no more.",
        )  # fmt: skip
    unread = [
        name for name in roles.wheels if recording.topics[name].type != "sensor_msgs/JointState"
    ]  # fmt: skip
    if unread:
        findings.note(
            "wheel_speeds", unread[0],
            "looks like wheel speeds, of an unsupported type "
            f"({recording.topics[unread[0]].type})",
            "Publish it as sensor_msgs/JointState (velocity, rad/s) or TwistStamped to use it.",
        )  # fmt: skip
