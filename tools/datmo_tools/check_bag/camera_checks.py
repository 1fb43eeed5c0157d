# SPDX-License-Identifier: BSD-3-Clause
"""Checks cameras: calibration against images, stereo baseline, rectification; clouds and depth."""

import numpy as np

MIN_BASELINE, MAX_BASELINE = 0.02, 3.0  # m
MAX_PAIR_OFFSET = 0.02  # s between the stamps of a left and a right image
MAX_ROTATION = 1e-3  # rad: rows of rectified images are parallel


def check_cameras(recording, roles, findings):
    """Adds findings on calibrations and image pairs."""
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
                "no_camera_info", image, "has no camera_info in its namespace",
                "Its focal length is unknown: record camera_info too, or calibrate the camera "
                "(camera_calibration).",
            )  # fmt: skip
        return
    info, shape = recording.camera_infos[name][0], recording.images[image]
    if (info.width, info.height) != (shape.width, shape.height):
        findings.error(
            "camera_info_size", name,
            f"is of {info.width} x {info.height} px, the image is {shape.width} x {shape.height}",
            "The calibration was made at another resolution: scale it, or recalibrate.",
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
            f"the principal point is at {info.P[2]:.0f}, {info.P[6]:.0f} px of "
            f"{info.width} x {info.height}",
            "It is outside the image: the calibration is not of this camera.",
        )  # fmt: skip


def _check_constant(name, infos, findings):
    if any(info.P != infos[0].P or info.width != infos[0].width for info in infos):
        findings.warn(
            "camera_info_changes", name, "changes during the recording",
            "The stack uses the newest one. Are there two cameras on this topic?",
        )  # fmt: skip


def _check_pair(recording, roles, findings):
    names = roles.left_image, roles.right_image
    shapes = [recording.images[name] for name in names]
    if (shapes[0].width, shapes[0].height) != (shapes[1].width, shapes[1].height):
        findings.error(
            "pair_size", names[1], "differs in size from the left image",
            "Both must have the same size, as stereo_image_proc requires.",
        )  # fmt: skip
    if "rect" not in names[0].rsplit("/", 1)[-1]:
        findings.note(
            "unrectified", names[0], "images are not rectified",
            "Start with stereo_images:=raw (run_bag does so by itself): they are rectified first.",
        )  # fmt: skip
    offset = pair_offset(recording, roles)
    if offset > MAX_PAIR_OFFSET:
        findings.warn(
            "pair_offset", names[1], f"is {offset:.3f} s apart from the left image (median)",
            "The images of a pair must be exposed at the same time: trigger both cameras together.",
        )  # fmt: skip
    elif offset > 0.0:
        findings.note(
            "pair_stamps", names[1], f"stamps differ from the left image's by {offset:.4f} s",
            "The yaml sets stereo_image_proc/approximate_sync.",
        )  # fmt: skip


def pair_offset(recording, roles):
    """Returns the median time (s) from a left image to the nearest right one; 0 without any."""
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
    """Returns topic and CameraInfo of a stereo pair's right camera; None, None if there is none."""
    name = roles.info_beside(recording, roles.right_image)
    if name is None:
        name = next((item for item in recording.camera_infos if "right" in item), None)
    return name, recording.camera_infos[name][0] if name else None


def baseline(info):
    """Returns the baseline (m) of a right camera's CameraInfo; 0 if its focal length is 0."""
    return -info.P[3] / info.P[0] if info.P[0] else 0.0


def _check_baseline(recording, roles, findings):
    name, info = right_info(recording, roles)
    if info is None:
        findings.warn(
            "no_right_info", (roles.right_image or roles.camera_clouds[0]),
            "the right camera has no camera_info",
            "Focal length and baseline come from it: record /stereo/right/camera_info too, or give "
            "stereo_camera/focal_length and baseline in the yaml.",
        )  # fmt: skip
        return
    if info.P[0] <= 0.0:
        return
    value = baseline(info)
    if value == 0.0:
        findings.error(
            "baseline_zero", name, "P[3] is 0: no baseline, as in a left or single camera",
            "P[3] of the right camera is -focal length * baseline: calibrate them as a pair.",
        )  # fmt: skip
    elif value < 0.0:
        findings.error(
            "baseline_sign", name, f"P[3] is {info.P[3]:.1f}, a baseline of {value:.2f} m",
            "Left and right are swapped, or the sign is wrong: P[3] is -focal length * baseline.",
        )  # fmt: skip
    elif not MIN_BASELINE <= value <= MAX_BASELINE:
        findings.warn(
            "baseline_size", name, f"P[3] and P[0] give a baseline of {value:.3f} m",
            "Is it in meters? Calibrations in millimeters or squares give such numbers.",
        )  # fmt: skip


def _check_mounts(recording, roles, findings):
    name = roles.left_image or (roles.camera_clouds[0] if roles.camera_clouds else None)
    topic = recording.topics[name]
    frame = topic.frame().lstrip("/")
    mount = recording.transforms.between(roles.base_frame, frame)
    if mount is None:
        findings.warn(
            "missing_camera_mount", name,
            f"the mount of {frame or 'the camera'} on {roles.base_frame} is not known",
            "Measure it and set it under mounts in the yaml, or publish it on /tf_static: optical "
            "frames have x right, y down, z forward. Fusion needs it.",
        )  # fmt: skip
    elif mount[:3, 2] @ np.array([0.0, 0.0, 1.0]) > 0.7:
        findings.warn(
            "camera_not_optical", name,
            f"z of {frame} points up, expected an optical frame (x right, y down, z forward)",
            "Set the driver's frame_id to its ..._optical_frame.",
        )  # fmt: skip


def _check_clouds(recording, roles, findings):
    for name in roles.lidar_clouds:
        if roles.scan is None:
            findings.error(
                "only_3d_lidar", name,
                "is from a 3D lidar, and there is no planar scan, which the stack needs",
                "Create one first: cloud_to_scan converts the cloud to a planar scan (a band above "
                "the road).",
            )  # fmt: skip
        else:
            findings.note(
                "3d_lidar", name, "is from a 3D lidar; the planar scan is used",
                "cloud_to_scan can make a planar scan of it, from a band above the road.",
            )  # fmt: skip
    for name in roles.depth_images:
        findings.note(
            "depth_camera", name, "is from a depth camera",
            "Its points (depth_image_proc, point_cloud_xyz) can replace those of a stereo "
            "camera.",
        )  # fmt: skip
