# SPDX-License-Identifier: BSD-3-Clause
"""Assigns a recording's topics to the inputs of the stack."""

from datmo_tools.check_bag import recording as kinds
from datmo_tools.check_bag.transform_table import bare

OPTICAL_FIELDS = {"rgb", "rgba"}  # of clouds from image pipelines
LIDAR_FIELDS = {"ring", "intensity", "time", "t", "timestamp", "channel"}
DEPTH_ENCODINGS = {"16UC1", "32FC1"}
USUAL_BASE_FRAMES = "base_link", "base_footprint", "base"


class Roles:
    """Topics (names) by role; None if the recording has none."""

    def __init__(self, recording, scan=None, odometry=None):
        """scan, odometry: topics selected by the user instead of those with most messages."""
        self.scans = [topic.name for topic in recording.of_type(*kinds.SCANS)]
        self.scan = scan or _preferred(recording, self.scans, "/scan")
        self.scan_is_echoes = _type(recording, self.scan) == kinds.SCANS[1]
        odometries = [topic.name for topic in recording.of_type(kinds.ODOMETRY)]
        odometries = [name for name in odometries if not name.startswith("/ground_truth")]
        self.odometries = odometries
        self.odometry = odometry or _preferred(recording, odometries, "/odometry")
        self.twist = _preferred(recording, _names(recording, *kinds.TWISTS), "/twist")
        self.imu = _preferred(recording, _names(recording, kinds.IMU), "/imu/data")
        self.wheels = _wheel_topics(recording)
        self.steering = _preferred(recording, _steering_topics(recording), "/steering")
        self.acceleration = _preferred(recording, _names(recording, kinds.ACCELERATION), "/acceleration")
        self.camera_clouds, self.lidar_clouds = _clouds(recording)
        self.depth_images = _depth_images(recording)
        self.left_image, self.right_image = _stereo_pair(recording)
        self.mono_images = [
            name for name in recording.images
            if name not in self.depth_images and name not in (self.left_image, self.right_image)
        ]  # fmt: skip
        self.base_frame = _base_frame(recording, self.odometry)
        self.odom_frame = _odom_frame(recording, self.odometry)
        self.scan_frame = bare(recording.topics[self.scan].frame()) if self.scan else ""

    def info_beside(self, recording, image):
        """Returns the camera_info topic in an image's namespace; None if there is none."""
        if image is None:
            return None
        name = image.rsplit("/", 1)[0] + "/camera_info"
        return name if name in recording.camera_infos else None


def _names(recording, *types):
    return [topic.name for topic in recording.of_type(*types)]


def _type(recording, name):
    return recording.topics[name].type if name in recording.topics else ""


def _preferred(recording, names, usual):
    if usual in names:
        return usual
    return max(names, key=lambda name: recording.topics[name].count, default=None)


def _wheel_topics(recording):
    """Returns topics that look like wheel speeds: joint states with velocities, and other types
    named that way."""
    named = ("wheel", "encoder", "joint_states")
    return [
        topic.name
        for topic in recording.topics.values()
        if is_wheel_joints(recording, topic.name)
        or (topic.type != kinds.JOINTS
            and any(word in topic.name.lower() for word in named)
            and topic.type.split("/")[0] not in ("visualization_msgs", "tf2_msgs"))
    ]  # fmt: skip


def is_wheel_joints(recording, name):
    """Returns whether a topic has joint states with velocities, as of wheels."""
    return name in recording.joints and recording.joints[name].has_velocity


def _steering_topics(recording):
    """Returns topics of joint states whose positions are all those of front wheels, by their names:
    others would need risk/host_state/steering_joint."""
    return [
        name for name, joints in recording.joints.items()
        if joints.has_position
        and ("steer" in name.lower()
             or (joints.names and all("steer" in joint.lower() for joint in joints.names)))
    ]  # fmt: skip


def _clouds(recording):
    """Returns the topics of clouds from cameras, and from 3D lidars."""
    cameras, lidars = [], []
    for name, cloud in recording.clouds.items():
        fields = set(cloud.fields)
        optical = "optical" in cloud.frame or name.endswith("points2") or fields & OPTICAL_FIELDS
        is_camera = optical and not fields & {"ring"}
        (cameras if is_camera else lidars).append(name)
    return sorted(cameras), sorted(lidars)


def _depth_images(recording):
    return sorted(
        name
        for name, image in recording.images.items()
        if image.encoding in DEPTH_ENCODINGS or "/depth" in name
    )


def _stereo_pair(recording):
    """Returns the left image topic that has a right one in the same namespace, and that one."""
    for name in sorted(recording.images, key=lambda name: ("rect" not in name, name)):
        if "left" in name and name.replace("left", "right") in recording.images:
            return name, name.replace("left", "right")
    return None, None


def _base_frame(recording, odometry):
    if odometry is not None:
        child = recording.topics[odometry].children.most_common(1)
        if child and child[0][0]:
            return bare(child[0][0])
    frames = recording.transforms.frames()
    return next((name for name in USUAL_BASE_FRAMES if name in frames), USUAL_BASE_FRAMES[0])


def _odom_frame(recording, odometry):
    frame = recording.topics[odometry].frame() if odometry is not None else ""
    return bare(frame) or "odom"
