# SPDX-License-Identifier: BSD-3-Clause
"""Converts tracks to messages of other packages: vision_msgs and derived_object_msgs.

Both functions fill messages of the module that the caller passes, so that this module can be loaded
without either package. Positions, velocities and frames are unchanged: m, m/s, rad, the
TrackArray's frame.
"""

import math

from geometry_msgs.msg import Point32

from datmo_fusion.msg import Object

CLASS_NAMES = {Object.CLASS_UNKNOWN: "unknown", Object.CLASS_PEDESTRIAN: "pedestrian",
               Object.CLASS_CYCLIST: "cyclist", Object.CLASS_VEHICLE: "vehicle",
               Object.CLASS_POLE: "pole"}
STATES = 6  # of a track's covariance: x, y, vx, vy, ax, ay
BOX = 1  # shape_msgs/SolidPrimitive.BOX
TRACKED = 1  # derived_object_msgs/Object.OBJECT_TRACKED
# derived_object_msgs/Object.CLASSIFICATION_*: UNKNOWN, PEDESTRIAN, BIKE, CAR; a pole is a BARRIER.
DERIVED_CLASSES = {Object.CLASS_UNKNOWN: 0, Object.CLASS_PEDESTRIAN: 4, Object.CLASS_CYCLIST: 5,
                   Object.CLASS_VEHICLE: 6, Object.CLASS_POLE: 10}
MAX_CERTAINTY = 255


def heading_of(pose):
    """Returns the yaw (rad) of a planar pose."""
    return 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def pose_covariance(track):
    """Returns the 36 numbers of geometry_msgs/PoseWithCovariance: x, y and heading variance."""
    covariance = [0.0] * 36
    covariance[0], covariance[1] = track.covariance[0], track.covariance[1]
    covariance[6], covariance[7] = track.covariance[STATES], track.covariance[STATES + 1]
    covariance[35] = track.heading_variance
    return covariance


def corners(track):
    """Returns the box's corners on the ground, counterclockwise from the front left one."""
    heading = heading_of(track.pose)
    cosine, sine = math.cos(heading), math.sin(heading)
    at = track.pose.position
    polygon = []
    for along, across in ((0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)):
        ahead, left = along * track.size.x, across * track.size.y
        polygon.append(Point32(at.x + cosine * ahead - sine * left,
                               at.y + sine * ahead + cosine * left, at.z))
    return polygon


def to_detections(tracks, module):
    """Returns a vision_msgs/Detection3DArray; `module`: vision_msgs.msg.

    One hypothesis per class with a probability above 0: by name if the id is a string (later
    versions), else by number of Object.CLASS_*. The track's id is in the field that the version has
    for it: Detection3D.tracking_id or ObjectHypothesisWithPose.object_id.
    """
    array = module.Detection3DArray()
    array.header = tracks.header
    array.detections = [to_detection(track, tracks.header, module) for track in tracks.tracks]
    return array


def to_detection(track, header, module):
    """Returns the vision_msgs/Detection3D of one track."""
    detection = module.Detection3D()
    detection.header = header
    detection.bbox.center = track.pose
    detection.bbox.size = track.size
    if hasattr(detection, "tracking_id"):
        detection.tracking_id = str(track.id)
    if hasattr(detection, "is_tracking"):
        detection.is_tracking = True
    for number, probability in enumerate(track.class_probabilities):
        if probability > 0.0:
            detection.results.append(to_hypothesis(track, number, probability, module))
    return detection


def to_hypothesis(track, number, probability, module):
    """Returns the vision_msgs/ObjectHypothesisWithPose of one class."""
    hypothesis = module.ObjectHypothesisWithPose()
    hypothesis.id = CLASS_NAMES[number] if isinstance(hypothesis.id, str) else number
    if hasattr(hypothesis, "object_id"):
        hypothesis.object_id = str(track.id)
    hypothesis.score = probability * track.existence_probability
    hypothesis.pose.pose = track.pose
    hypothesis.pose.covariance = pose_covariance(track)
    return hypothesis


def to_derived_objects(tracks, module):
    """Returns a derived_object_msgs/ObjectArray; `module`: derived_object_msgs.msg.

    Twist and acceleration are in the tracks' frame, like the pose. classification_age: hits.
    """
    array = module.ObjectArray()
    array.header = tracks.header
    array.objects = [to_derived_object(track, tracks.header, module) for track in tracks.tracks]
    return array


def to_derived_object(track, header, module):
    """Returns the derived_object_msgs/Object of one track."""
    derived = module.Object()
    derived.header = header
    derived.id = track.id
    derived.detection_level = TRACKED
    derived.pose = track.pose
    derived.twist.linear = track.velocity
    derived.twist.angular.z = track.yaw_rate
    derived.accel.linear = track.acceleration
    derived.polygon.points = corners(track)
    derived.shape.type = BOX
    derived.shape.dimensions = [track.size.x, track.size.y, track.size.z]
    derived.object_classified = track.classification != Object.CLASS_UNKNOWN
    derived.classification = DERIVED_CLASSES[track.classification]
    derived.classification_certainty = round(MAX_CERTAINTY * track.class_probability)
    derived.classification_age = track.hits
    return derived
