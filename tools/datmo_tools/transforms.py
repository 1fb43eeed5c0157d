# SPDX-License-Identifier: BSD-3-Clause
"""Rigid transforms in space (4 x 4 matrices) and in the plane (x, y, yaw)."""

import math

import numpy as np
from scipy.spatial.transform import Rotation


def normalize_angle(angle):
    """Normalizes angle(s) (rad) to [-pi, pi)."""
    return (np.asarray(angle) + math.pi) % (2.0 * math.pi) - math.pi


def rigid(rotation, translation):
    """Returns the 4 x 4 transform of a 3 x 3 rotation and a translation (3, m)."""
    transform = np.eye(4)
    transform[:3, :3] = rotation
    transform[:3, 3] = translation
    return transform


def inverse(transform):
    """Returns the inverse of a rigid 4 x 4 transform."""
    rotation = transform[:3, :3].T
    return rigid(rotation, -rotation @ transform[:3, 3])


def apply(transform, points):
    """Transforms `points` (n x 3) by a 4 x 4 transform."""
    return points @ transform[:3, :3].T + transform[:3, 3]


def yaw_of(transform):
    """Returns the heading (rad) of the transform's x axis in the target's xy plane."""
    return math.atan2(transform[1, 0], transform[0, 0])


def rigid_of(pose):
    """Returns the 4 x 4 transform of a geometry_msgs/Transform whose quaternion is not 0."""
    shift, turn = pose.translation, pose.rotation
    rotation = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w])
    return rigid(rotation.apply(np.eye(3)).T, [shift.x, shift.y, shift.z])


def quaternion_of_yaw(yaw):
    """Returns the quaternion (x, y, z, w) of a rotation by `yaw` (rad) about z."""
    return (0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))


def rotation_of(matrix):
    """Returns scipy's Rotation of a 3 x 3 matrix."""
    # Before scipy 1.4 (Ubuntu 20.04 has an older one) it was called a direction cosine matrix.
    make = getattr(Rotation, "from_matrix", None) or getattr(Rotation, "from_dcm")
    return make(matrix)


def quaternion_of(rotation):
    """Returns the quaternion (x, y, z, w), w >= 0, of a 3 x 3 rotation."""
    quaternion = rotation_of(rotation).as_quat()
    return tuple(quaternion if quaternion[3] >= 0.0 else -quaternion)


def compose(pose, local):
    """Transforms planar pose(s) `local` (..., 3: x, y, yaw) from `pose` (3) to its parent."""
    local = np.asarray(local, dtype=float)
    cosine, sine = math.cos(pose[2]), math.sin(pose[2])
    x = pose[0] + cosine * local[..., 0] - sine * local[..., 1]
    y = pose[1] + sine * local[..., 0] + cosine * local[..., 1]
    return np.stack([x, y, normalize_angle(pose[2] + local[..., 2])], axis=-1)


def relative(origin, pose):
    """Returns planar pose(s) `pose` (..., 3) relative to a planar `origin` (3) in the same
    frame."""
    pose = np.asarray(pose, dtype=float)
    cosine, sine = math.cos(origin[2]), math.sin(origin[2])
    dx, dy = pose[..., 0] - origin[0], pose[..., 1] - origin[1]
    yaw = normalize_angle(pose[..., 2] - origin[2])
    return np.stack([cosine * dx + sine * dy, -sine * dx + cosine * dy, yaw], axis=-1)


def points_in_parent(pose, points):
    """Transforms points (n x 2, m) from the frame of the planar `pose` (3) to its parent."""
    return compose(pose, _with_yaw(points))[..., :2]


def points_seen_from(origin, points):
    """Returns points (n x 2, m) relative to the planar pose `origin` (3) in the same frame."""
    return relative(origin, _with_yaw(points))[..., :2]


def _with_yaw(points):
    points = np.asarray(points, dtype=float)
    return np.concatenate([points, np.zeros((*points.shape[:-1], 1))], axis=-1)


def arc(speed, yaw_rate, duration):
    """Returns the motion (x, y, yaw) at a `speed` (m/s) and `yaw_rate` (rad/s) for `duration`
    (s)."""
    yaw = yaw_rate * duration
    chord = speed * duration * np.sinc(0.5 * yaw / math.pi)
    return np.array([chord * math.cos(0.5 * yaw), chord * math.sin(0.5 * yaw), yaw])


def rates_of(motion, duration):
    """Returns speed (m/s) and yaw rate (rad/s) of the arc of a planar `motion` in `duration` (s).

    The component of the motion across the arc's chord is ignored: a vehicle does not slip sideways.
    """
    x, y, yaw = motion
    chord = x * math.cos(0.5 * yaw) + y * math.sin(0.5 * yaw)
    return chord / (duration * np.sinc(0.5 * yaw / math.pi)), yaw / duration
