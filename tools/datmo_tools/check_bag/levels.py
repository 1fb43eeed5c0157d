# SPDX-License-Identifier: BSD-3-Clause
"""Checks what a recording has for each level of fusion, and what is missing."""

from typing import NamedTuple

from datmo_tools.check_bag.roles import is_wheel_joints


class Level(NamedTuple):
    """A level of fusion, and what it lacks."""

    name: str
    switch: str  # of run_bag; "" for none
    missing: tuple  # texts; empty: everything is there


def levels(recording, roles):
    """Returns a list of Level."""
    base = _missing_for_scanner(recording, roles)
    camera = _missing_for_camera(recording, roles)
    objects = () if "/objects/stereo" in recording.topics else camera
    tracks = () if "/tracks/stereo" in recording.topics else objects
    return [
        Level("none (the scanner alone)", "", base),
        Level("low (grids)", "--low-level-fusion", base + camera),
        Level("object", "--object-fusion", base + objects),
        Level("track", "--track-fusion", base + tracks),
        Level("mono (classes, with a network)", "--mono", base + _missing_for_mono(recording, roles)),
        Level("road_border", "--road-border", base),
    ]


def _missing_for_scanner(recording, roles):
    missing = ()
    if roles.scan is None:
        wanted = "a planar scan (sensor_msgs/LaserScan or MultiEchoLaserScan)"
        if roles.lidar_clouds:
            wanted += f": make one from {roles.lidar_clouds[0]} with cloud_to_scan"
        missing += (wanted,)
    elif recording.transforms.between(roles.base_frame, roles.scan_frame) is None:
        mount = f"{roles.base_frame} -> {roles.scan_frame}"
        missing += (f"the mount {mount} (tf, or mounts in the yaml)",)
    return missing


def _missing_for_camera(recording, roles):
    if roles.camera_clouds:
        return ()
    if roles.right_image is None:
        if roles.left_image is None and roles.mono_images:
            return ("a second camera, or its points: with one camera, use level mono",)
        return ("a stereo camera: its points, or a pair of images",)
    lacking = [
        image for image in (roles.left_image, roles.right_image)
        if roles.info_beside(recording, image) is None
    ]  # fmt: skip
    return tuple(f"camera_info of {image}" for image in lacking)


def _missing_for_mono(recording, roles):
    images = [name for name in (roles.left_image, *roles.mono_images) if name]
    if not images:
        return ("a camera's images",)
    rectified = [name for name in images if "rect" in name]
    if not rectified:
        return (f"rectified images: image_proc makes them from {images[0]}",)
    if all(roles.info_beside(recording, image) is None for image in rectified):
        return (f"camera_info of {rectified[0]}",)
    return ()


def motion_source(roles, recording):
    """Returns the first value of motion/source that the recording has the topics for."""
    if roles.odometry:
        return "odometry"
    joint_states = any(is_wheel_joints(recording, name) for name in roles.wheels)
    if roles.twist:
        return "imu_and_twist" if roles.imu else "twist"
    if roles.imu:
        return "imu_and_wheels" if joint_states else "imu"
    return "none"
