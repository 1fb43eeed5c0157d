# SPDX-License-Identifier: BSD-3-Clause
"""Determines where the scanner of a CARMEN log is mounted on the robot."""

import numpy as np

from datmo_tools import transforms
from datmo_tools.errors import InputError

# The poses of scanner and robot in a line are rounded, and interpolated to its stamp.
MAX_POSITION_SPREAD = 0.02  # m
MAX_YAW_SPREAD = 0.02  # rad

# CARMEN's parameters for the pose of the front laser: forward, left, and rotation (m, m, rad).
FRONT_SETTINGS = (
    "robot_frontlaser_offset",
    "robot_frontlaser_side_offset",
    "robot_frontlaser_angular_offset",
)
FRONT_LASERS = ("FLASER", "ROBOTLASER1")


def scanner_mount(path, log, scans):
    """Returns the pose (x, y, yaw) of the scanner in base_link, and a note for the user (or None).

    Scan lines have the scanner's pose and the robot's. Processed logs have a corrected pose
    instead, or the robot's; then the log's parameters are used. path: of the log, for messages;
    scans: its LaserLines. Raises InputError if the mount is not known.
    """
    mounts = np.array([transforms.relative(scan.robot_pose, scan.laser_pose) for scan in scans])
    setting = _setting(path, log)
    spread = np.abs(mounts - mounts[0])
    spread[:, 2] = np.abs(transforms.normalize_angle(mounts[:, 2] - mounts[0, 2]))
    limits = (MAX_POSITION_SPREAD, MAX_POSITION_SPREAD, MAX_YAW_SPREAD)
    fixed = np.all(spread.max(axis=0) <= limits)
    if fixed and (setting is None or np.any(mounts[0] != 0.0) or not np.any(setting)):
        return mounts[0], None
    if setting is None:
        raise InputError(
            f"{path}: the laser's pose on the robot varies by {spread[:, :2].max():.2f} m, so it "
            f"is not a mount's, and {FRONT_SETTINGS[0]} is not set; expected --mount"
        )
    moves = "" if fixed else ", as the laser poses of the lines are not those of a fixed mount"
    return setting, f"mount from {FRONT_SETTINGS[0]}{moves}"


def _setting(path, log):
    """Returns the pose from the log's parameters; None if there are none."""
    if log.laser not in FRONT_LASERS or FRONT_SETTINGS[0] not in log.parameters:
        return None
    texts = [log.parameters.get(name, "0") for name in FRONT_SETTINGS]
    try:
        pose = np.array(texts, dtype=float)
    except ValueError as error:
        raise InputError(f"{path}: {', '.join(FRONT_SETTINGS)}: {error}") from error
    if not np.all(np.isfinite(pose)):
        raise InputError(f"{path}: {', '.join(FRONT_SETTINGS)}: {texts}, expected finite numbers")
    return pose
