#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tracks in the messages of vision_msgs and derived_object_msgs. Neither package is required:
stand-ins with the fields of their published definitions refuse any other field."""

import math
import types
import unittest

from geometry_msgs.msg import Accel, Polygon, Pose, PoseWithCovariance, Quaternion, Twist, Vector3
from std_msgs.msg import Header

from datmo_fusion.msg import Object, Track, TrackArray
from datmo_tools import track_bridge


def message(name, **defaults):
    """Returns a class whose instances have only these fields; a default is a value or makes one."""
    def __init__(self):
        for field, default in defaults.items():
            setattr(self, field, default() if callable(default) else default)
    return type(name, (), {"__slots__": tuple(defaults), "__init__": __init__})


BOX = message("BoundingBox3D", center=Pose, size=Vector3)
FIRST_VISION = types.SimpleNamespace(  # Melodic, Noetic
    Detection3DArray=message("Detection3DArray", header=Header, detections=list),
    Detection3D=message("Detection3D", header=Header, results=list, bbox=BOX, source_cloud=None),
    ObjectHypothesisWithPose=message("ObjectHypothesisWithPose", id=0, score=0.0,
                                     pose=PoseWithCovariance))
LATER_VISION = types.SimpleNamespace(
    Detection3DArray=FIRST_VISION.Detection3DArray,
    Detection3D=message("Detection3D", header=Header, results=list, bbox=BOX, source_cloud=None,
                        is_tracking=False, tracking_id=""),
    ObjectHypothesisWithPose=message("ObjectHypothesisWithPose", id="", object_id="", score=0.0,
                                     pose=PoseWithCovariance))
SHAPE = message("SolidPrimitive", type=0, dimensions=list)
DERIVED = types.SimpleNamespace(
    ObjectArray=message("ObjectArray", header=Header, objects=list),
    Object=message("Object", header=Header, id=0, detection_level=0, object_classified=False,
                   pose=Pose, twist=Twist, accel=Accel, polygon=Polygon, shape=SHAPE,
                   classification=0, classification_certainty=0, classification_age=0))


def one_car():
    """Returns a car of 4 x 2 m at (10, 5) that faces to the left of the x axis."""
    track = Track(id=7, classification=Object.CLASS_VEHICLE, class_probability=0.8, hits=12,
                  class_probabilities=[0.2, 0.0, 0.0, 0.8, 0.0], existence_probability=0.5,
                  yaw_rate=0.25, heading_variance=0.04)
    track.pose.position.x, track.pose.position.y = 10.0, 5.0
    track.pose.orientation = Quaternion(0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4))
    track.size = Vector3(4.0, 2.0, 1.5)
    track.velocity = Vector3(0.0, 3.0, 0.0)
    track.acceleration = Vector3(0.0, 0.5, 0.0)
    track.covariance = [float(i) for i in range(36)]
    array = TrackArray(tracks=[track])
    array.header.frame_id = "map"
    return array


class TrackBridge(unittest.TestCase):
    def test_a_car_in_vision_msgs(self):
        array = track_bridge.to_detections(one_car(), FIRST_VISION)
        self.assertEqual(array.header.frame_id, "map")
        detection, = array.detections
        self.assertEqual(detection.header.frame_id, "map")
        self.assertEqual((detection.bbox.center.position.x, detection.bbox.size.x), (10.0, 4.0))
        unknown, vehicle = detection.results
        self.assertEqual((unknown.id, vehicle.id), (0, Object.CLASS_VEHICLE))
        self.assertAlmostEqual(vehicle.score, 0.4, 6)
        self.assertEqual(vehicle.pose.pose.position.y, 5.0)
        covariance = vehicle.pose.covariance
        self.assertEqual([covariance[i] for i in (0, 1, 6, 7)], [0.0, 1.0, 6.0, 7.0])
        self.assertAlmostEqual(covariance[35], 0.04)

    def test_later_versions_hold_the_id_and_names(self):
        detection, = track_bridge.to_detections(one_car(), LATER_VISION).detections
        self.assertEqual((detection.is_tracking, detection.tracking_id), (True, "7"))
        self.assertEqual([(each.id, each.object_id) for each in detection.results],
                         [("unknown", "7"), ("vehicle", "7")])

    def test_a_car_in_derived_object_msgs(self):
        derived, = track_bridge.to_derived_objects(one_car(), DERIVED).objects
        self.assertEqual((derived.id, derived.detection_level, derived.header.frame_id),
                         (7, 1, "map"))
        self.assertEqual((derived.twist.linear.y, derived.twist.angular.z, derived.accel.linear.y),
                         (3.0, 0.25, 0.5))
        self.assertEqual((derived.shape.type, derived.shape.dimensions), (1, [4.0, 2.0, 1.5]))
        self.assertEqual((derived.object_classified, derived.classification,
                          derived.classification_certainty, derived.classification_age),
                         (True, 6, 204, 12))
        front_left = derived.polygon.points[0]
        self.assertAlmostEqual(front_left.x, 9.0)
        self.assertAlmostEqual(front_left.y, 7.0)

    def test_no_tracks(self):
        empty = TrackArray()
        self.assertEqual(track_bridge.to_detections(empty, FIRST_VISION).detections, [])
        self.assertEqual(track_bridge.to_derived_objects(empty, DERIVED).objects, [])

    def test_an_unknown_class_is_not_classified(self):
        array = one_car()
        array.tracks[0].classification = Object.CLASS_UNKNOWN
        derived, = track_bridge.to_derived_objects(array, DERIVED).objects
        self.assertFalse(derived.object_classified)


if __name__ == "__main__":
    unittest.main()
