# SPDX-License-Identifier: BSD-3-Clause
"""Creates kitti_to_bag's ROS messages in the frames of the stack's data contract."""

import numpy as np
from sensor_msgs.msg import CameraInfo, Image, PointCloud2, PointField
from tf2_msgs.msg import TFMessage

from datmo_tools import transforms
from datmo_tools.bag_messages import BASE, SCANNER, header, transform

VELODYNE, IMU = "velodyne", "imu"
LEFT_CAMERA, RIGHT_CAMERA = "stereo_left_optical", "stereo_right_optical"


def point_cloud(stamp, cloud):
    """Returns the PointCloud2 (x, y, z, intensity: float32) of a Velodyne cloud (n x 4)."""
    fields = [
        PointField(name, 4 * i, PointField.FLOAT32, 1)
        for i, name in enumerate(("x", "y", "z", "intensity"))
    ]
    return PointCloud2(
        header=header(stamp, VELODYNE),
        height=1,
        width=len(cloud),
        fields=fields,
        is_bigendian=False,
        point_step=16,
        row_step=16 * len(cloud),
        data=np.ascontiguousarray(cloud, dtype="<f4").tobytes(),
        is_dense=True,
    )


def points(message):
    """Returns the cloud (n x 4) of a PointCloud2 made by point_cloud()."""
    return np.frombuffer(message.data, dtype="<f4").reshape(-1, 4)


def gray_image(stamp, pixels):
    """Returns a mono8 Image (height x width) in the left rectified camera's frame."""
    height, width = pixels.shape
    return Image(
        header=header(stamp, LEFT_CAMERA),
        height=height,
        width=width,
        encoding="mono8",
        is_bigendian=0,
        step=width,
        data=pixels.tobytes(),
    )


def camera_info(stamp, camera):
    """Returns a rectified camera's CameraInfo: no distortion, no rotation, K from P."""
    projection = camera.projection
    return CameraInfo(
        header=header(stamp, LEFT_CAMERA),
        height=camera.height,
        width=camera.width,
        distortion_model="plumb_bob",
        D=[0.0] * 5,
        K=projection[:, :3].ravel().tolist(),
        R=np.eye(3).ravel().tolist(),
        P=projection.ravel().tolist(),
    )


def static_transforms(stamp, calibration, scanner_height):
    """Returns the TFMessage base_link -> every sensor."""
    velodyne = calibration.base_from_velodyne
    left = velodyne @ transforms.inverse(calibration.left_from_velodyne)
    right = left @ transforms.rigid(np.eye(3), [calibration.baseline, 0.0, 0.0])
    mounts = (
        (SCANNER, scanner_mount(velodyne, scanner_height)),
        (VELODYNE, velodyne),
        (IMU, calibration.base_from_imu),
        (LEFT_CAMERA, left),
        (RIGHT_CAMERA, right),
    )
    return TFMessage(
        [
            transform(stamp, BASE, frame, mount, transforms.quaternion_of(mount[:3, :3]))
            for frame, mount in mounts
        ]
    )


def scanner_mount(base_from_velodyne, height):
    """Returns base_link -> scanner (4 x 4): below the Velodyne at `height` (m), not rotated."""
    return transforms.rigid(np.eye(3), [*base_from_velodyne[:2, 3], height])
