# SPDX-License-Identifier: BSD-3-Clause
"""Ground truth as messages of the stack's data contract."""

from geometry_msgs.msg import Point, Quaternion, Vector3

from datmo_fusion.msg import Object, TrueObject, TrueObjectArray
from datmo_tools import transforms
from datmo_tools.bag_messages import MAP, SCANNER, header, planar_odometry

TRUE_BASE = "base_link_ground_truth"

CLASSES = {
    "Car": Object.CLASS_VEHICLE,
    "Van": Object.CLASS_VEHICLE,
    "Truck": Object.CLASS_VEHICLE,
    "Tram": Object.CLASS_VEHICLE,
    "Pedestrian": Object.CLASS_PEDESTRIAN,
    "Person_sitting": Object.CLASS_PEDESTRIAN,
    "Person": Object.CLASS_PEDESTRIAN,  # the same class in some files of label_02
    "Person (sitting)": Object.CLASS_PEDESTRIAN,  # the same class in tracklet_labels.xml
    "Cyclist": Object.CLASS_CYCLIST,
}


def true_pose(stamp, pose, speed, yaw_rate):
    """Returns the Odometry of the true pose (x, y, yaw) in the map at `stamp` (ns), and its
    rates."""
    return planar_odometry(stamp, MAP, TRUE_BASE, pose, speed, yaw_rate)


def true_objects(stamp, objects, beam_counts):
    """Returns the TrueObjectArray of MapObjects, with the number of beams that end on each."""
    items = [_true_object(item, beams) for item, beams in zip(objects, beam_counts)]
    return TrueObjectArray(header=header(stamp, MAP), objects=items)


def _true_object(item, beams):
    message = TrueObject(
        id=item.source.number,
        label=item.source.label,
        classification=CLASSES.get(item.source.label, Object.CLASS_UNKNOWN),
        size=Vector3(item.source.length, item.source.width, item.source.height),
        velocity=Vector3(item.velocity[0], item.velocity[1], 0.0),
        moving=item.moving,
        visible_to=[SCANNER] if beams > 0 else [],
        lidar_beams=beams,
        occlusion=item.box.occlusion,
    )
    message.pose.position = Point(item.pose[0], item.pose[1], item.z)
    message.pose.orientation = Quaternion(*transforms.quaternion_of_yaw(item.pose[2]))
    return message
