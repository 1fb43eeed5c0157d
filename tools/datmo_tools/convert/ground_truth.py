# SPDX-License-Identifier: BSD-3-Clause
"""Converts labeled boxes to objects in the map: velocity, whether they move, and visibility."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms

# Half the time over which a line is fitted to the positions: short for the velocity, long for
# deciding whether the object moves at all.
VELOCITY_HALF_WINDOW = 0.5  # s
MOVING_HALF_WINDOW = 1.0  # s

# Labels of parked cars drift by a few tenths of a meter as the car drives past; no road user is
# slower than half a slow walking speed.
MOVING_SPEED = 0.5  # m/s

# A beam is counted for an object if its cloud point is within this distance of the box: the labels
# are about as accurate.
BOX_TOLERANCE = 0.2  # m


class MapObject(NamedTuple):
    """A labeled object of one frame in the map."""

    source: object  # the TrueObject that it comes from
    box: object  # the TrueBox of this frame, in the Velodyne's frame
    pose: np.ndarray  # x, y (m), yaw (rad) of the box's center
    z: float  # m, center above the road
    velocity: np.ndarray  # vx, vy in m/s; 0 if it does not move
    moving: bool


def objects_by_frame(objects, base_from_velodyne, stamps, poses):
    """Returns a dictionary frame -> list of MapObject.

    objects: TrueObject list; stamps: ns of all frames; poses: n x 3, base_link in the map at the
    stamps. Boxes of frames that the drive does not have are dropped.
    """
    frames = {frame: [] for frame in range(len(stamps))}
    for source in objects:
        known = sorted(frame for frame in source.boxes if frame in frames)
        if known:
            for frame, item in zip(
                known, _moved_to_map(source, known, base_from_velodyne, stamps, poses)
            ):
                frames[frame].append(item)
    return frames


def _moved_to_map(source, known, base_from_velodyne, stamps, poses):
    boxes = [source.boxes[frame] for frame in known]
    in_base = transforms.apply(
        base_from_velodyne, np.array([[box.x, box.y, box.z] for box in boxes])
    )
    yaw = np.array([box.yaw for box in boxes]) + transforms.yaw_of(base_from_velodyne)
    local = np.column_stack([in_base[:, :2], yaw])
    in_map = np.array([transforms.compose(poses[frame], pose) for frame, pose in zip(known, local)])
    seconds = np.array([(stamps[frame] - stamps[known[0]]) * 1e-9 for frame in known])
    velocity = fitted_velocities(seconds, in_map[:, :2], VELOCITY_HALF_WINDOW)
    steady = fitted_velocities(seconds, in_map[:, :2], MOVING_HALF_WINDOW)
    moving = np.hypot(steady[:, 0], steady[:, 1]) > MOVING_SPEED
    return [
        MapObject(
            source, boxes[i], in_map[i], in_base[i, 2], velocity[i] * moving[i], bool(moving[i])
        )
        for i in range(len(known))
    ]


def fitted_velocities(seconds, positions, half_window):
    """Returns velocities (n x k, m/s): slopes of lines fitted to nearby positions (n x k, m).

    seconds: n, increasing. A stamp with no other one within the window gets 0.
    """
    velocities = np.zeros(positions.shape)
    for i, instant in enumerate(seconds):
        near = np.abs(seconds - instant) <= half_window + 1e-9
        offset = seconds[near] - np.mean(seconds[near])
        spread = np.sum(offset**2)
        if spread > 0.0:
            velocities[i] = offset @ positions[near] / spread
    return velocities


def points_in_box(points, source, box, tolerance=BOX_TOLERANCE):
    """Returns how many points (n x 2 or more, the Velodyne's frame) are in the box from above."""
    local = transforms.points_seen_from([box.x, box.y, box.yaw], points[:, :2])
    ends = 0.5 * np.array([source.length, source.width]) + tolerance
    return int(np.count_nonzero(np.all(np.abs(local) <= ends, axis=1)))
