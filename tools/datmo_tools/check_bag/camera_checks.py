# SPDX-License-Identifier: BSD-3-Clause
"""Cameras: calibration against images, the stereo baseline, rectification; clouds and depth."""

import numpy as np

MIN_BASELINE, MAX_BASELINE = 0.02, 3.0  # m
MAX_PAIR_OFFSET = 0.02  # s between the stamps of a left and a right image
MAX_ROTATION = 1e-3  # rad: rows of rectified images are parallel


def check_cameras(recording, roles, findings):
    """Adds what is wrong with calibrations and image pairs."""
    for image in recording.images:
        _check_info(recording, roles, image, findings)
    for name, infos in recording.camera_infos.items():
        _check_numbers(name, infos[0], findings)
        _check_constant(name, infos, findings)
    if roles.right_image:
        _check_pair(recording, roles, findings)
    if roles.right_image or roles.camera_clouds:
        _check_baseline(recording, roles, findings)
        _check_mounts(recording, roles, findings)
    _check_clouds(recording, roles, findings)


def _check_info(recording, roles, image, findings):
    name = roles.info_beside(recording, image)
    if name is None:
        if image in (roles.left_image, roles.right_image) or image in roles.depth_images:
            findings.warn(
                "no_camera_info", image, "there is no camera_info beside it",
                "Nothing knows its focal length: record camera_info too, or calibrate the camera "
                "(camera_calibration).",
            )  # fmt: skip
        return
    info, shape = recording.camera_infos[name][0], recording.images[image]
    if (info.width, info.height) != (shape.width, shape.height):
        findings.error(
            "camera_info_size", name,
            f"is of {info.width} x {info.height} px, the image of {shape.width} x {shape.height}",
            "The calibration is of another resolution: scale it, or calibrate again.",
        )  # fmt: skip


def _check_numbers(name, info, findings):
    values = np.array([*info.K, *info.P])
    if not np.all(np.isfinite(values)) or info.K[0] <= 0.0 or info.P[0] <= 0.0:
        findings.error(
            "camera_info_zero", name,
            f"is not calibrated: focal length {info.K[0]:.1f} px in K, {info.P[0]:.1f} px in P",
            "Calibrate the camera (camera_calibration), and let its driver load the file.",
        )  # fmt: skip
        return
    if not (0.0 < info.P[2] < info.width and 0.0 < info.P[6] < info.height):
        findings.warn(
            "principal_point", name,
            f"the optical axis meets the image at {info.P[2]:.0f}, {info.P[6]:.0f} px of "
            f"{info.width} x {info.height}",
            "Outside the image it is no calibration of this camera.",
        )  # fmt: skip


def _check_constant(name, infos, findings):
    if any(info.P != infos[0].P or info.width != infos[0].width for info in infos):
        findings.warn(
            "camera_info_changes", name, "changes while it is recorded",
            "The stack takes the newest one. Two cameras on one topic?",
        )  # fmt: skip


def _check_pair(recording, roles, findings):
    names = roles.left_image, roles.right_image
    shapes = [recording.images[name] for name in names]
    if (shapes[0].width, shapes[0].height) != (shapes[1].width, shapes[1].height):
        findings.error(
            "pair_size", names[1], "is of another size than the left image",
            "Both must be of one size, as stereo_image_proc wants them.",
        )  # fmt: skip
    if "rect" not in names[0].rsplit("/", 1)[-1]:
        findings.note(
            "unrectified", names[0], "images are as the camera made them",
            "Start with stereo_images:=raw (run_bag does so by itself): they are rectified first.",
        )  # fmt: skip
    offset = pair_offset(recording, roles)
    if offset > MAX_PAIR_OFFSET:
        findings.warn(
            "pair_offset", names[1], f"is {offset:.3f} s from the left image (median)",
            "A stereo pair is exposed at one time: trigger both cameras together.",
        )  # fmt: skip
    elif offset > 0.0:
        findings.note(
            "pair_stamps", names[1], f"stamps differ from the left image's by {offset:.4f} s",
            "The yaml says stereo_image_proc/approximate_sync.",
        )  # fmt: skip


def pair_offset(recording, roles):
    """s, median between a left image and the nearest right one; 0 without such a pair."""
    if not roles.right_image:
        return 0.0
    names = roles.left_image, roles.right_image
    left, right = (np.sort(recording.topics[name].stamps) for name in names)
    if len(left) < 3 or len(right) < 3:
        return 0.0
    after = np.searchsorted(right, left)
    neighbors = [np.clip(after + step, 0, len(right) - 1) for step in (-1, 0)]
    apart = np.min([np.abs(left - right[index]) for index in neighbors], axis=0)
    return float(np.median(apart))


def right_info(recording, roles):
    """Topic and CameraInfo of the right camera of a stereo pair; None, None without."""
    name = roles.info_beside(recording, roles.right_image)
    if name is None:
        name = next((item for item in recording.camera_infos if "right" in item), None)
    return name, recording.camera_infos[name][0] if name else None


def baseline(info):
    """m, of a right camera's CameraInfo; 0 where its focal length is 0."""
    return -info.P[3] / info.P[0] if info.P[0] else 0.0


def _check_baseline(recording, roles, findings):
    name, info = right_info(recording, roles)
    if info is None:
        findings.warn(
            "no_right_info", (roles.right_image or roles.camera_clouds[0]),
            "there is no camera_info of the right camera",
            "From it come focal length and baseline: record /stereo/right/camera_info too, or give "
            "stereo_camera/focal_length and baseline in the yaml.",
        )  # fmt: skip
        return
    if info.P[0] <= 0.0:
        return
    value = baseline(info)
    if value == 0.0:
        findings.error(
            "baseline_zero", name, "P[3] is 0: no baseline, as of a left or a single camera",
            "P[3] of the right camera is -focal length * baseline: calibrate both as a pair.",
        )  # fmt: skip
    elif value < 0.0:
        findings.error(
            "baseline_sign", name, f"P[3] is {info.P[3]:.1f}, which is a baseline of {value:.2f} m",
            "Left and right are exchanged, or the sign is: P[3] is -focal length * baseline.",
        )  # fmt: skip
    elif not MIN_BASELINE <= value <= MAX_BASELINE:
        findings.warn(
            "baseline_size", name, f"the baseline is {value:.3f} m by P[3] and P[0]",
            "In meters? Calibrations in millimeters or squares make such numbers.",
        )  # fmt: skip


def _check_mounts(recording, roles, findings):
    name = roles.left_image or (roles.camera_clouds[0] if roles.camera_clouds else None)
    topic = recording.topics[name]
    frame = topic.frame().lstrip("/")
    mount = recording.transforms.between(roles.base_frame, frame)
    if mount is None:
        findings.warn(
            "missing_camera_mount", name,
            f"nothing says where {frame or 'the camera'} is mounted on {roles.base_frame}",
            "Measure it, and put it under mounts in the yaml, or on /tf_static: x to the right, y "
            "down, z ahead in the optical frame. Fusion needs it.",
        )  # fmt: skip
    elif mount[:3, 2] @ np.array([0.0, 0.0, 1.0]) > 0.7:
        findings.warn(
            "camera_not_optical", name,
            f"z of {frame} points up: that is no optical frame (x right, y down, z ahead)",
            "Let the driver use its ..._optical_frame.",
        )  # fmt: skip


def _check_clouds(recording, roles, findings):
    for name in roles.lidar_clouds:
        if roles.scan is None:
            findings.error(
                "only_3d_lidar", name,
                "is of a 3D lidar, and there is no planar scan: the stack works on planar scans",
                "Make one first: cloud_to_scan turns the cloud into the planar scan (a band above "
                "the road).",
            )  # fmt: skip
        else:
            findings.note(
                "3d_lidar", name, "is of a 3D lidar; the planar scan is used",
                "cloud_to_scan makes a planar scan of it, of a band above the road.",
            )  # fmt: skip
    for name in roles.depth_images:
        findings.note(
            "depth_camera", name, "is of a depth camera",
            "Its points (depth_image_proc, point_cloud_xyz) can stand for those of a stereo "
            "camera.",
        )  # fmt: skip
