# SPDX-License-Identifier: BSD-3-Clause
"""Adds a satellite receiver on the vehicle and a camera on a roadside pole to a simulated drive."""

import math
from typing import NamedTuple

import numpy as np
import rosbag
from datmo_fusion.msg import Object, StationTrack, StationTracks
from sensor_msgs.msg import NavSatFix, NavSatStatus

from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_messages import header
from datmo_tools.evaluate.truth import TRUE_POSE, read_true_objects
from datmo_tools.pose_path import planar, read_messages

PEDESTRIAN, VEHICLE = Object.CLASS_PEDESTRIAN, Object.CLASS_VEHICLE
CLASSES = 5
GNSS, STATIONS = "/gnss", "/stations"

# The pose of the truth's map on the earth: WGS 84 position of its origin, and its heading from
# east.
LATITUDE, LONGITUDE, ALTITUDE, HEADING = math.radians(45.19), math.radians(5.72), 212.0, 0.7
SEMI_MAJOR, ECCENTRICITY2 = 6378137.0, 6.69437999014e-3  # m, 1

GNSS_PERIOD, CAMERA_PERIOD, LATENCY = 0.2, 0.1, 0.08  # s
SHARED, SHARED_TIME = 0.8, 60.0  # share of the receiver's variance that lasts, and its duration (s)
POLE, RANGE = np.array([81.0, 11.0]), 40.0  # m, in the map of the truth
STATION = 3
ACCELERATION = 1.0  # m/s^2, of the camera's own filter
START_VELOCITY = 6.0  # m/s, standard deviation of a new track of the camera
CLOCK_SIGMA = 0.02  # s, as stated by the camera
NANOSECONDS = 1e9


class Item(NamedTuple):
    """A true object at one stamp (ns), map of the truth."""

    id: int
    kind: int
    stamp: int
    position: np.ndarray
    velocity: np.ndarray
    heading: float
    size: tuple
    moving: bool

    def at(self, stamp):
        """Returns its position slightly earlier or later."""
        return self.position + (stamp - self.stamp) * 1e-9 * self.velocity


class Truth:
    """All true objects of a drive, and the vehicle's poses."""

    def __init__(self, path):
        """path: of the bag (Path). Raises InputError."""
        self.frames = [(stamp, [_item(one, stamp) for one in objects])
                       for stamp, objects in read_true_objects(path).items()]  # fmt: skip
        self.poses = [_pose(message) for message, _ in read_messages(path, TRUE_POSE)]
        self.start = self.frames[0][0]

    def all(self, stamp):
        """Returns the items of the frame nearest to a stamp (ns)."""
        return min(self.frames, key=lambda frame: abs(frame[0] - stamp))[1]

    def moving(self, stamp):
        """Returns those that move or can move: people."""
        return [item for item in self.all(stamp) if item.moving or item.kind == PEDESTRIAN]

    def nearest(self, stamp, kind):
        """Returns the first item of a kind, or None."""
        return next((item for item in self.all(stamp) if item.kind == kind), None)


def _pose(message):
    """Returns stamp (ns), position (m), heading (rad) and speed (m/s) of the vehicle."""
    x, y, heading = planar(message.pose.pose)
    return message.header.stamp.to_nsec(), np.array([x, y]), heading, message.twist.twist.linear.x


def _item(one, stamp):
    position, velocity = one.pose.position, one.velocity
    return Item(one.id, one.classification, stamp, np.array([position.x, position.y]),
                np.array([velocity.x, velocity.y]), planar(one.pose)[2],
                (one.size.x, one.size.y, one.size.z), one.moving)  # fmt: skip


def write(recorded, written, seed, values):
    """Copies a bag (Path) and adds the two; returns its Truth. values: the command line's."""
    random = np.random.default_rng(seed)
    truth = Truth(recorded)
    with rosbag.Bag(str(recorded)) as bag:
        extra = [*_fixes(truth, random, values.gnss_sigma), *_lists(truth, random, values)]
        extra.sort(key=lambda one: one[0])
        with whole_bag(written, "pole_camera") as out:
            for topic, message, time in bag.read_messages():
                while extra and extra[0][0] <= time.to_nsec():
                    stamp, name, added = extra.pop(0)
                    out.write(name, stamp, added)
                out.write(topic, time.to_nsec(), message)
    return truth


def _fixes(truth, random, sigma):
    shared = math.sqrt(SHARED) * sigma * random.normal(size=2)
    keep = math.exp(-GNSS_PERIOD / SHARED_TIME)
    next_stamp = truth.start
    for stamp, position, _, _ in truth.poses:
        if stamp < next_stamp:
            continue
        next_stamp += round(GNSS_PERIOD * NANOSECONDS)
        shared = keep * shared + math.sqrt(SHARED * (1.0 - keep**2)) * sigma * random.normal(size=2)
        white = math.sqrt(1.0 - SHARED) * sigma * random.normal(size=2)
        latitude, longitude = _geodetic(_to_plane(position) + shared + white)
        fix = NavSatFix(header=header(stamp, "base_link"), latitude=latitude, longitude=longitude,
                        altitude=ALTITUDE)  # fmt: skip
        fix.status.status = NavSatStatus.STATUS_FIX
        fix.position_covariance = [sigma**2, 0, 0, 0, sigma**2, 0, 0, 0, 4.0 * sigma**2]
        fix.position_covariance_type = NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
        yield stamp, GNSS, fix


def _lists(truth, random, values):
    """Yields the camera's Kalman-filtered tracks of objects near the pole and of the vehicle."""
    filters = {}
    next_stamp = truth.start
    for (stamp, items), pose in zip(truth.frames, truth.poses):
        if stamp < next_stamp:
            continue
        next_stamp += round(CAMERA_PERIOD * NANOSECONDS)
        tracks = []
        for item in [*(one for one in items if one.moving or one.kind == PEDESTRIAN), _ego(pose)]:
            if np.linalg.norm(item.position - POLE) > RANGE:
                filters.pop(item.id, None)
                continue
            measured = _to_plane(item.position) + values.camera_sigma * random.normal(size=2)
            state = filters.setdefault(item.id, Filter(measured, values.camera_sigma))
            state.take(stamp, measured)
            tracks.append(_track(item, state))
        claimed = stamp + round(values.clock_offset * random.normal() * NANOSECONDS)
        message = StationTracks(header=header(claimed, ""), station=STATION, clock_sigma=CLOCK_SIGMA,
                                tracks=tracks)  # fmt: skip
        yield stamp + round(LATENCY * NANOSECONDS), STATIONS, message


def _ego(pose):
    """Returns the vehicle as an object: its center is this far ahead of the rear axle."""
    stamp, position, heading, speed = pose
    ahead = np.array([math.cos(heading), math.sin(heading)])
    return Item(0, VEHICLE, stamp, position + 1.4 * ahead, speed * ahead, heading, (4.6, 1.85, 1.5),
                True)  # fmt: skip


class Filter:
    """Kalman filter with constant velocity, in the plane of east and north."""

    def __init__(self, position, sigma):
        self.state = np.array([*position, 0.0, 0.0])
        self.covariance = np.diag([sigma**2, sigma**2, START_VELOCITY**2, START_VELOCITY**2])
        self.sigma, self.stamp = sigma, None

    def take(self, stamp, position):
        """Adds a detection (m) at a stamp (ns); the first one is already included."""
        if self.stamp is not None:
            seconds = (stamp - self.stamp) / NANOSECONDS
            step = np.eye(4) + seconds * np.eye(4, k=2)
            sway = np.vstack([0.5 * seconds**2 * np.eye(2), seconds * np.eye(2)])
            self.state = step @ self.state
            self.covariance = step @ self.covariance @ step.T + ACCELERATION**2 * sway @ sway.T
            innovation = self.covariance[:2, :2] + self.sigma**2 * np.eye(2)
            gain = self.covariance[:, :2] @ np.linalg.inv(innovation)
            self.state = self.state + gain @ (position - self.state[:2])
            self.covariance = self.covariance - gain @ innovation @ gain.T
            self.covariance = 0.5 * (self.covariance + self.covariance.T)
        self.stamp = stamp


def _track(item, state):
    latitude, longitude = _geodetic(state.state[:2])
    classes = [0.05] * CLASSES
    classes[item.kind] = 0.8
    return StationTrack(
        id=item.id + 1, latitude=latitude, longitude=longitude, velocity_east=state.state[2],
        velocity_north=state.state[3], covariance=state.covariance.ravel().tolist(),
        heading=item.heading + HEADING, heading_variance=0.05, length=item.size[0], width=item.size[1],
        height=item.size[2], moving=bool(np.linalg.norm(state.state[2:]) > 0.5),
        class_probabilities=classes, existence_probability=0.95)  # fmt: skip


def _to_plane(position):
    c, s = math.cos(HEADING), math.sin(HEADING)
    return np.array([c * position[0] - s * position[1], s * position[0] + c * position[1]])


def _geodetic(point):
    """Returns the degrees of a point east and north of the origin (m), by local curvature radii."""
    root = math.sqrt(1.0 - ECCENTRICITY2 * math.sin(LATITUDE) ** 2)
    meridian = SEMI_MAJOR * (1.0 - ECCENTRICITY2) / root**3 + ALTITUDE
    normal = SEMI_MAJOR / root + ALTITUDE
    return (math.degrees(LATITUDE + point[1] / meridian),
            math.degrees(LONGITUDE + point[0] / (normal * math.cos(LATITUDE))))  # fmt: skip
