# SPDX-License-Identifier: BSD-3-Clause
"""Messages for tests of rviz: what its displays and panels of ours show."""

import math

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point32, Pose2D
from std_msgs.msg import String
from visualization_msgs.msg import Marker

from datmo_fusion.msg import (Object, ObjectArray, Risk, RiskArray, RoadBorder, RoadBorders, Track,
                              TrackArray)

TRACKS = 200
RATE = 10.0  # Hz


def track(number, time_s):
    """Returns one of many tracks, in rows around the host."""
    result = Track(id=number + 1, moving=True, classification=number % 5, existence_probability=0.3 + 0.7 *
                   (number % 7) / 6.0, heading_variance=0.01, class_probability=1.0)
    result.pose.position.x = 6.0 * (number % 20) - 40.0 + time_s
    result.pose.position.y = 6.0 * (number // 20) - 30.0
    result.pose.orientation.w = 1.0
    result.size.x, result.size.y, result.size.z = 4.0, 1.8, 1.5
    result.velocity.x = 0.1 * number
    result.covariance = [0.2 if i % 7 == 0 else 0.0 for i in range(36)]
    result.mode_probabilities = [0.5, 0.0, 0.3, 0.2, 0.0]
    result.class_probabilities = [1.0 if i == number % 5 else 0.0 for i in range(5)]
    result.sensors = ["lidar"]
    return result


def broken_tracks():
    """Invalid numbers, an invalid covariance, an unknown class."""
    tracks = [track(number, 0.0) for number in range(4)]
    tracks[0].pose.position.x = math.nan
    tracks[1].covariance = [math.nan] * 36
    tracks[2].covariance = [-1.0] * 36
    tracks[3].classification = 200
    tracks[3].mode_probabilities = []
    return tracks


def risks():
    """A contact ahead, a warning, and the host's path."""
    message = RiskArray(level=2, cause=3, reason="cyclist 3 at the front", host_path_step=0.2,
                        host_length=4.6, host_width=1.85)
    message.host_path = [Pose2D(0.2 * i * 10.0, 0.0, 0.0) for i in range(21)]
    risk = Risk(id=3, contact_probability=[0.0, 0.6, 0.8, 0.9], median_ttc=1.6, time_to_brake=0.4)
    risk.contact.x = 18.0
    far = Risk(id=4, median_ttc=math.inf, time_to_brake=math.inf)
    message.risks = [risk, far]
    return message


def borders():
    """One on each side."""
    message = RoadBorders()
    for side, y in ((0, 5.0), (1, -5.0)):
        message.borders.append(RoadBorder(side=side, probability=0.9, sigma=[0.2, 0.4], points=[
            Point32(-20.0, y, 0.0), Point32(60.0, y, 0.0)]))
    return message


def host_vehicle():
    """As `markers` publishes it."""
    result = Marker(ns="host vehicle", type=Marker.MESH_RESOURCE, frame_locked=True, mesh_use_embedded_materials=True,
                    mesh_resource="package://datmo_fusion/meshes/vehicle.obj")
    result.pose.orientation.w = 1.0
    result.scale.x, result.scale.y, result.scale.z = 4.6, 1.85, 1.5
    return result


def objects():
    """One pedestrian."""
    message = ObjectArray()
    one = Object(classification=1, dynamic_state=2, sensors=["lidar", "stereo"])
    one.pose.position.x = 8.0
    one.pose.orientation.w = 1.0
    message.objects = [one]
    return message


class Publisher:
    """Publishes everything at RATE until it is stopped."""

    def __init__(self):
        self.tracks = [track(number, 0.0) for number in range(TRACKS)]
        self._out = {
            "/tracks": rospy.Publisher("/tracks", TrackArray, queue_size=2),
            "/tracks/elsewhere": rospy.Publisher("/tracks/elsewhere", TrackArray, queue_size=2),
            "/host_vehicle": rospy.Publisher("/host_vehicle", Marker, queue_size=2),
            "/objects": rospy.Publisher("/objects", ObjectArray, queue_size=2),
            "/road_borders": rospy.Publisher("/road_borders", RoadBorders, queue_size=2),
            "/risks": rospy.Publisher("/risks", RiskArray, queue_size=2),
            "/no_tracks": rospy.Publisher("/no_tracks", String, queue_size=2),
            "/diagnostics": rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=2),
        }
        self._timer = rospy.Timer(rospy.Duration(1.0 / RATE), self._publish)

    def _publish(self, _):
        messages = {"/tracks": TrackArray(tracks=self.tracks), "/objects": objects(),
                    "/tracks/elsewhere": TrackArray(tracks=self.tracks[:3]),
                    "/road_borders": borders(), "/risks": risks(), "/host_vehicle": host_vehicle()}
        for topic, message in messages.items():
            message.header.stamp = rospy.Time.now()
            message.header.frame_id = "nowhere" if "elsewhere" in topic else "map"
            self._out[topic].publish(message)
        self._out["/no_tracks"].publish("not a track")
        status = DiagnosticStatus(name="grid_slam: stage", message="runs", values=[
            KeyValue("scan received", "3"), KeyValue("scan rate [Hz]", "10.0")])
        self._out["/diagnostics"].publish(DiagnosticArray(status=[status]))

    def stop(self):
        """Stops publishing."""
        self._timer.shutdown()
