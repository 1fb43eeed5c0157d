# SPDX-License-Identifier: BSD-3-Clause
"""Reads a recording once, in bounded memory: every stamp, but only some of the messages."""

import functools
import struct
from collections import Counter

import genpy
import numpy as np

from datmo_tools.check_bag.motion_signal import ImuSamples, OdometrySamples, TwistSamples
from datmo_tools.check_bag.samples import cloud_sample, image_shape, joint_sample, scan_sample
from datmo_tools.check_bag.transform_table import TransformTable

SCANS = "sensor_msgs/LaserScan", "sensor_msgs/MultiEchoLaserScan"
ODOMETRY = "nav_msgs/Odometry"
TWISTS = "geometry_msgs/TwistStamped", "geometry_msgs/TwistWithCovarianceStamped"
IMU = "sensor_msgs/Imu"
JOINTS = "sensor_msgs/JointState"
ACCELERATION = "geometry_msgs/AccelWithCovarianceStamped"
CLOUD = "sensor_msgs/PointCloud2"
IMAGE = "sensor_msgs/Image"
CAMERA_INFO = "sensor_msgs/CameraInfo"
TRANSFORMS = "tf2_msgs/TFMessage", "tf/tfMessage"

# How many messages of a topic are decoded. Scans in blocks, as neighbors are compared.
MAX_SCANS = 1200
SCANS_IN_BLOCK = 60
MAX_MOTIONS = 40000
MAX_TRANSFORMS = 20000
MAX_CAMERA_INFOS = 20


class Topic:
    """Stamps and headers of one topic."""

    def __init__(self, name, datatype, with_header):
        self.name = name
        self.type = datatype
        self.with_header = with_header
        self.recorded = []  # s since the start of the recording
        self.stamps = []  # s since that start, from the header; empty without one
        self.unstamped = 0  # messages with stamp 0
        self.frames = Counter()  # as written
        self.children = Counter()  # child_frame_id of odometry

    @property
    def count(self):
        """Messages."""
        return len(self.recorded)

    def period(self):
        """Returns the median period (s) by stamps, else by record time; None if too few."""
        times = self.stamps if len(self.stamps) > 2 else self.recorded
        steps = np.diff(np.sort(np.asarray(times)))
        steps = steps[steps > 0.0]
        return float(np.median(steps)) if len(steps) else None

    def frame(self):
        """Returns the most frequent frame; "" if there is none."""
        return self.frames.most_common(1)[0][0] if self.frames else ""


class Recording:
    """A recording as it was read."""

    def __init__(self, path, start):
        self.path = path
        self.start = start  # ns
        self.topics = {}  # name -> Topic
        self.scans = {}  # topic -> list of ScanSample
        self.odometry = {}  # topic -> OdometrySamples
        self.twists = {}  # topic -> TwistSamples
        self.imus = {}  # topic -> ImuSamples
        self.joints = {}  # topic -> JointSample
        self.clouds = {}  # topic -> CloudSample
        self.images = {}  # topic -> ImageShape
        self.camera_infos = {}  # topic -> list of CameraInfo
        self.transforms = TransformTable()
        self.undecoded = {}  # topic -> why
        self.other_versions = {}  # topic -> type, recorded with another definition than ours

    @property
    def duration(self):
        """Returns the time (s) from the first message to the last by record time."""
        times = [topic.recorded[-1] for topic in self.topics.values() if topic.count]
        return max(times, default=0.0)

    def of_type(self, *types):
        """Returns the topics of these types that have messages, by name."""
        return sorted(
            (topic for topic in self.topics.values() if topic.type in types and topic.count),
            key=lambda topic: topic.name,
        )


def read_recording(path, bag):
    """Returns the Recording of an open rosbag.Bag called `path`."""
    start = int(round(bag.get_start_time() * 1e9))
    recording = Recording(path, start)
    counts = {}
    for name, info in bag.get_type_and_topic_info().topics.items():
        counts[name] = info.message_count
    with_header = _types_with_header(bag)
    for name, message, recorded in bag.read_messages(raw=True):
        datatype, data, pytype = message[0], message[1], message[-1]
        topic = recording.topics.get(name)
        if topic is None:
            topic = Topic(name, datatype, with_header.get(datatype, False))
            recording.topics[name] = topic
        if _is_other_version(datatype, message[2]):
            recording.other_versions[name] = datatype
        index = topic.count
        topic.recorded.append(1e-9 * (recorded.to_nsec() - start))
        stamp = _take_header(topic, data, start) if topic.with_header else None
        if _is_decoded(topic, index, counts.get(name, 0)):
            _decode(recording, topic, pytype, data, stamp, index)
    return recording


@functools.cache
def _is_other_version(datatype, checksum):
    installed = genpy.message.get_message_class(datatype)
    # pylint: disable=protected-access
    return installed is not None and installed._md5sum != checksum


def _types_with_header(bag):
    # The index has each type's definition; there is no public call that returns all of them.
    return {
        connection.datatype: _begins_with_header(connection.msg_def)
        for connection in bag._get_connections()  # pylint: disable=protected-access
    }


def _begins_with_header(definition):
    lines = (line.split("#")[0].split() for line in definition.splitlines())
    first = next((words for words in lines if words and "=" not in "".join(words)), [""])
    return first[0] in ("Header", "std_msgs/Header", "roslib/Header")


def _take_header(topic, data, start):
    """Adds stamp and frame of a serialized message; returns the stamp (s), None if it is 0."""
    if len(data) < 16:
        return None
    seconds, nanoseconds, length = struct.unpack_from("<III", data, 4)
    frame = data[16 : 16 + min(length, 200)].decode("utf-8", "replace")
    topic.frames[frame] += 1
    if seconds == 0 and nanoseconds == 0:
        topic.unstamped += 1
        return None
    stamp = 1e-9 * (seconds * 10**9 + nanoseconds - start)
    topic.stamps.append(stamp)
    return stamp


def _is_decoded(topic, index, count):
    if topic.type in SCANS:
        blocks = max(1, MAX_SCANS // SCANS_IN_BLOCK)
        return count <= MAX_SCANS or index % (count // blocks) < SCANS_IN_BLOCK
    if topic.type in TRANSFORMS:
        static = topic.name.endswith("tf_static")
        return static or count <= MAX_TRANSFORMS or index % (count // MAX_TRANSFORMS + 1) == 0
    if topic.type in (ODOMETRY, IMU, *TWISTS):
        return count <= MAX_MOTIONS or index % (count // MAX_MOTIONS + 1) == 0
    if topic.type == CAMERA_INFO:
        return index < MAX_CAMERA_INFOS
    return topic.type in (CLOUD, IMAGE, JOINTS) and index == 0


def _decode(recording, topic, pytype, data, stamp, index):
    message = pytype()
    try:
        message.deserialize(data)
    except Exception as error:  # pylint: disable=broad-except
        # genpy raises whatever struct and its own checks raise; one bad message does not make a bad
        # bag.
        recording.undecoded.setdefault(topic.name, str(error))
        return
    _keep(recording, topic, message, stamp, index)


def _keep(recording, topic, message, stamp, index):
    name, at = topic.name, topic.recorded[-1] if stamp is None else stamp
    if topic.type in SCANS:
        recording.scans.setdefault(name, []).append(scan_sample(message, at, index))
    elif topic.type in TRANSFORMS:
        recording.transforms.add(message, name.endswith("tf_static"), recording.start)
    elif topic.type == ODOMETRY:
        topic.children[message.child_frame_id] += 1
        recording.odometry.setdefault(name, OdometrySamples()).add(message, at)
    elif topic.type in TWISTS:
        recording.twists.setdefault(name, TwistSamples()).add(message, at)
    elif topic.type == IMU:
        recording.imus.setdefault(name, ImuSamples()).add(message, at)
    elif topic.type == CAMERA_INFO:
        recording.camera_infos.setdefault(name, []).append(message)
    elif topic.type == JOINTS:
        recording.joints[name] = joint_sample(message)
    elif topic.type == CLOUD:
        recording.clouds[name] = cloud_sample(message)
    else:
        recording.images[name] = image_shape(message)
