# SPDX-License-Identifier: BSD-3-Clause
"""Bags of borders that the tests of evaluate draw_borders share: a vehicle drives along the map's y axis."""

import math

import genpy
import numpy as np
from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import whole_bag
from datmo_tools.convert.kitti_calibration import Camera
from datmo_tools.convert.kitti_messages import LEFT_CAMERA, camera_info, gray_image
from geometry_msgs.msg import Point, Point32, Pose, PoseWithCovarianceStamped, Quaternion
from tf2_msgs.msg import TFMessage

from datmo_fusion.msg import (
    DroppedObject,
    DroppedObjects,
    Object,
    ObjectArray,
    Polyline,
    RoadBorder,
    RoadBorders,
    ScanPoint,
    LabeledScan,
    TrueObjectArray,
    TrueRoadBorders,
)
from object_samples import object_at

START = 1000 * 10**9
STEP = 10**8  # ns from a scan to the next one
SPEED = 10.0  # m/s
HEADING = math.pi / 2
DRIFT = 3.0  # m, of the map along its x axis relative to the true one

# Optical axes (x right, y down, z ahead) of a forward-looking camera 1.5 m above base_link.
AXES = np.array([(0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])
MOUNT = transforms.rigid(AXES, [0.0, 0.0, 1.5])
CAMERA = Camera(
    np.array([(100.0, 0.0, 50.0, 0.0), (0.0, 100.0, 40.0, 0.0), (0.0, 0.0, 1.0, 0.0)]), 100, 80
)


def border(side, points, sigma=0.1, probability=0.9, unseen=0.0):
    """points: x, y (m) in the map."""
    return RoadBorder(
        side=side, points=[Point32(x, y, 0.0) for x, y in points], sigma=[sigma] * len(points),
        probability=probability, unseen=genpy.Duration.from_sec(unseen),
    )  # fmt: skip


# Straight along the road: 4 m to its left, 3 m to its right.
LEFT = border(RoadBorder.LEFT, [(-4.0, -10.0), (-4.0, 50.0)])
RIGHT = border(RoadBorder.RIGHT, [(3.0, 0.0), (3.0, 20.0)], sigma=0.2, probability=0.5, unseen=2.0)


def write_run(path, count=11, borders=(LEFT, RIGHT), truth=True):
    """A run of this many scans: in each a point 10 m ahead, a moving object there, another object,
    and one that was dropped."""
    with whole_bag(path, "test") as bag:
        for i in range(count):
            stamp = START + i * STEP
            position = Pose(Point(0.0, SPEED * i * STEP * 1e-9, 0.0),
                         Quaternion(*transforms.quaternion_of_yaw(HEADING)))  # fmt: skip
            in_map = bag_messages.header(stamp, "map")
            in_base = bag_messages.header(stamp, "base_link")
            pose = PoseWithCovarianceStamped(header=in_map)
            pose.pose.pose = position
            bag.write("/pose", stamp, pose)
            scan = LabeledScan(header=in_base, map_frame="map", pose=pose.pose)
            scan.points = [ScanPoint(x=10.0, y=0.0, state=ScanPoint.MOVING)]
            bag.write("/labeled_scan", stamp, scan)
            bag.write("/road_borders", stamp, RoadBorders(header=in_map, borders=borders))
            kept = [object_at(10.0, 0.0), object_at(20.0, 0.0)]
            kept[0].dynamic_state = Object.STATE_MOVING
            bag.write("/objects", stamp, ObjectArray(header=in_base, objects=kept))
            dropped = [DroppedObject(object=object_at(5.0, -3.0))]
            bag.write("/objects/dropped", stamp, DroppedObjects(header=in_base, objects=dropped))
            if truth:
                _write_truth(bag, stamp, position)


def _write_truth(bag, stamp, position):
    header = bag_messages.header(stamp, "map")
    pose = (DRIFT, position.position.y, HEADING)
    true_pose = bag_messages.planar_odometry(stamp, "map", "base_link", pose, SPEED, 0.0)
    bag.write("/ground_truth/pose", stamp, true_pose)
    bag.write("/ground_truth/objects", stamp, TrueObjectArray(header=header))
    curb = Polyline([Point32(DRIFT - 4.0, 0.0, 0.0), Point32(DRIFT - 4.0, 40.0, 0.0)])
    message = TrueRoadBorders(header=header, borders=[curb], at_intersection=True)
    bag.write("/ground_truth/road_borders", stamp, message)


def write_images(path, count=11, delay=STEP // 4, encoding="mono8"):
    """Images of the drive, each with an offset (ns) from a scan;
    all pixels of number i have the gray value i."""
    with whole_bag(path, "test") as bag:
        mount = bag_messages.transform(
            START, "base_link", LEFT_CAMERA, MOUNT, transforms.quaternion_of(AXES))  # fmt: skip
        bag.write_latched("/tf_static", START, TFMessage([mount]))
        for i in range(count):
            stamp = START + i * STEP + delay
            image = gray_image(stamp, np.full((CAMERA.height, CAMERA.width), i, dtype=np.uint8))
            image.encoding = encoding
            bag.write("/stereo/left/image_rect", stamp, image)
            bag.write("/stereo/left/camera_info", stamp, camera_info(stamp, CAMERA))
