# SPDX-License-Identifier: BSD-3-Clause
"""Where the scanner of a CARMEN log is mounted on the robot."""

import numpy as np

from datmo_tools import transforms
from datmo_tools.errors import InputError

# The scanner's and the robot's pose in a line are rounded, and interpolated to its stamp.
MAX_POSITION_SPREAD = 0.02  # m
MAX_YAW_SPREAD = 0.02  # rad

# CARMEN's settings for the pose of the front laser: ahead, to the left, and turned (m, m, rad).
FRONT_SETTINGS = (
    "robot_frontlaser_offset",
    "robot_frontlaser_side_offset",
    "robot_frontlaser_angular_offset",
)
FRONT_LASERS = ("FLASER", "ROBOTLASER1")


def scanner_mount(path, log, scans):
    """Pose (x, y, yaw) of the scanner in base_link, and a note on it for the user (or None).

    Scans have the scanner's pose beside the robot's. Logs that were worked over hold a corrected
    pose instead, or the robot's; there the settings of the log count. path: of the log, for
    messages; scans: its LaserLines. Raises InputError where the mount is not known.
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
            f"{path}: the laser's pose moves by {spread[:, :2].max():.2f} m on the robot, so that "
            f"it is none of a mount, and no {FRONT_SETTINGS[0]} is set; expected --mount"
        )
    moves = "" if fixed else ", since the lines' laser poses are not those of a fixed mount"
    return setting, f"mount from {FRONT_SETTINGS[0]}{moves}"


def _setting(path, log):
    """Pose by the log's settings; None without any."""
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
