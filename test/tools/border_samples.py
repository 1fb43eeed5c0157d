# SPDX-License-Identifier: BSD-3-Clause
"""A drive of two seconds along a street, with published borders, that tests of tools share.

The vehicle drives along x from the origin of the true map at 10 m/s. The run has drifted: its map
is shifted by 5 m to the side, and rotated by a right angle.
"""

import numpy as np
from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import whole_bag
from geometry_msgs.msg import Point, Point32, PoseWithCovarianceStamped, Quaternion

from datmo_fusion.msg import (
    Polyline,
    RoadBorder,
    RoadBorders,
    TrueObjectArray,
    TrueRoadBorders,
)
from track_samples import DRIFT, PERIOD, START, car

FRAMES = 21
STEP = 1.0  # m, from frame to frame

CURBS = (((-100.0, 5.0), (200.0, 5.0)), ((-100.0, -5.0), (200.0, -5.0)))

SIGMA = 0.2  # m, of published points


def along(*positions):
    """Returns a function of the frame: true poses (x, y, yaw) on a straight path,
    or the given ones."""

    def at(frame):
        return positions[frame] if positions else (STEP * frame, 0.0, 0.0)

    return at


def parked(number, x, y):
    """Returns a car of 4 m x 2 m that is parked there throughout."""
    return car(number, x, y)


def border(side, *points, sigma=SIGMA, side_street=False, frames=range(FRAMES)):
    """Function of the frame: a border through points of the true map, side as in RoadBorder; None
    out of its frames."""

    def at(frame, base):
        if frame not in frames:
            return None
        local = [transforms.relative(base, [x, y, 0.0]) for x, y in points]
        # The run's estimate of the vehicle's pose is the true one moved by DRIFT.
        run_base = transforms.compose(DRIFT, base)
        positions = [transforms.compose(run_base, point) for point in local]
        return RoadBorder(
            side=side, points=[Point32(position[0], position[1], 0.0) for position in positions],
            sigma=[sigma] * len(positions), probability=0.9, side_street=side_street,
        )  # fmt: skip

    return at


def left(y, first=-60.0, last=120.0, **others):
    """Returns a left border along x at y."""
    return border(RoadBorder.LEFT, (first, y), (last, y), **others)


def right(y, first=-60.0, last=120.0, **others):
    """Returns a right border along x at y."""
    return border(RoadBorder.RIGHT, (first, y), (last, y), **others)


def write_drive(path, borders, curbs=CURBS, objects=(), trajectory=along(), at_intersection=()):
    """A bag of run_bag --road-border --with-truth.

    borders: as border() gives them, None: without their topic; curbs: lines of the true map;
    objects: as parked() gives them; at_intersection: frames.
    """
    with whole_bag(path, "test") as bag:
        for frame in range(FRAMES):
            stamp = START + frame * PERIOD
            header, base = bag_messages.header(stamp, "map"), np.array(trajectory(frame))
            if borders is not None:
                present = [item(frame, base) for item in borders]
                present = [item for item in present if item is not None]
                bag.write("/road_borders", stamp, RoadBorders(header=header, borders=present))
            pose = PoseWithCovarianceStamped(header=header)
            drifted = transforms.compose(DRIFT, base)
            pose.pose.pose.position = Point(drifted[0], drifted[1], 0.0)
            pose.pose.pose.orientation = Quaternion(*transforms.quaternion_of_yaw(drifted[2]))
            bag.write("/pose", stamp, pose)
            true_pose = bag_messages.planar_odometry(stamp, "map", "base_link", base, 0.0, 0.0)
            bag.write("/ground_truth/pose", stamp, true_pose)
            truth = TrueObjectArray(header=header, objects=[item(frame) for item in objects])
            bag.write("/ground_truth/objects", stamp, truth)
            lines = [Polyline([Point32(x, y, 0.0) for x, y in line]) for line in curbs]
            state = TrueRoadBorders(header=header, borders=lines)
            state.at_intersection = frame in at_intersection
            bag.write("/ground_truth/road_borders", stamp, state)
