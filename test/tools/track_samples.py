# SPDX-License-Identifier: BSD-3-Clause
"""A drive of one second with tracks of two sensors and fused ones, that tests of tools share.

The vehicle is stationary at the origin of the true map and faces along x. The run has drifted: its
map is shifted by 5 m to the side, and rotated by a right angle.
"""

import math

import numpy as np
from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import whole_bag
from geometry_msgs.msg import (
    Point,
    Pose,
    Pose2D,
    PoseWithCovarianceStamped,
    Quaternion,
    Vector3,
)

from datmo_fusion.msg import (
    Object,
    SourceTrack,
    Track,
    TrackArray,
    TrueObject,
    TrueObjectArray,
    ViewFan,
)

START = 1000 * 10**9
PERIOD = 10**8  # ns
FRAMES = 11
DRIFT = np.array([0.0, 5.0, math.pi / 2])  # of the run's map: pose of the vehicle in it
SPEED = 10.0  # m/s, of the car that drives

EVERYWHERE = ("scanner", "stereo")


def car(number, x, y, speed=0.0, visible_to=EVERYWHERE, label="Car",
        classification=Object.CLASS_VEHICLE):  # fmt: skip
    """Function of the frame: a TrueObject of 4 m x 2 m that drives along x from there."""

    def at(frame):
        position = Point(x + speed * frame * PERIOD * 1e-9, y, 0.0)
        return TrueObject(
            id=number, label=label, classification=classification,
            pose=Pose(position, Quaternion(0.0, 0.0, 0.0, 1.0)), size=Vector3(4.0, 2.0, 1.5),
            velocity=Vector3(speed, 0.0, 0.0), moving=speed != 0.0, visible_to=list(visible_to),
        )  # fmt: skip

    return at


def track(number, x, y, speed=0.0, frames=range(FRAMES), sources=(), sources_from=0, moving=True):
    """Function of the frame: a Track there in the truth's map, or None out of its frames.

    sources: of (source, id), which it has from the frame `sources_from` on; before, the first one.
    """

    def at(frame):
        if frame not in frames:
            return None
        position = transforms.compose(DRIFT, [x + speed * frame * PERIOD * 1e-9, y, 0.0])
        turned = speed * np.array([math.cos(DRIFT[2]), math.sin(DRIFT[2])])
        members = sources if frame >= sources_from else sources[:1]
        return Track(
            id=number, pose=Pose(Point(position[0], position[1], 0.0), Quaternion(0.0, 0.0, 0.0, 1.0)),
            velocity=Vector3(turned[0], turned[1], 0.0), moving=moving,
            sources=[SourceTrack(*member) for member in members],
        )  # fmt: skip

    return at


def view(reach=36.0):
    """A camera's view of 60 degrees to either side, from the vehicle; reach: m, of all beams."""
    return ViewFan(
        sensor=Pose2D(*DRIFT), first_bearing=-math.pi / 3, beam_spacing=math.pi / 180, range=36.0,
        sure_range=20.0, reach=[reach] * 121,
    )  # fmt: skip


def write_run(path, lists, objects=(), views=(), frames=FRAMES):
    """A bag of run_bag --track-fusion --with-truth.

    lists: dictionary topic -> functions as track() gives them; objects: as car() gives them; views:
    of the camera.
    """
    with whole_bag(path, "test") as bag:
        for frame in range(frames):
            stamp = START + frame * PERIOD
            header = bag_messages.header(stamp, "map")
            for topic, tracks in lists.items():
                present = [item(frame) for item in tracks if item(frame) is not None]
                message = TrackArray(header=header, tracks=present)
                message.views = list(views) if topic == "/tracks/stereo" else []
                bag.write(topic, stamp, message)
            bag.write("/pose", stamp, _pose(header))
            true_pose = bag_messages.planar_odometry(
                stamp, "map", "base_link", (0.0, 0.0, 0.0), 0.0, 0.0)  # fmt: skip
            bag.write("/ground_truth/pose", stamp, true_pose)
            truth = TrueObjectArray(header=header, objects=[item(frame) for item in objects])
            bag.write("/ground_truth/objects", stamp, truth)


def _pose(header):
    message = PoseWithCovarianceStamped(header=header)
    message.pose.pose.position = Point(DRIFT[0], DRIFT[1], 0.0)
    message.pose.pose.orientation = Quaternion(*transforms.quaternion_of_yaw(DRIFT[2]))
    return message
