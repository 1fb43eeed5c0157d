// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "message_samples.h"
#include <Eigen/Core>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/point_field.h"

/// Clouds of a stereo camera, which tests modify.
namespace datmo::samples {

/// The layout of stereo_image_proc's clouds: x, y, z, 4 bytes of padding, rgb, 12 bytes of padding.
/// One row; the points are in the optical frame, m.
inline sensor_msgs::PointCloud2 cloud(const std::vector<Eigen::Vector3f>& points) {
  sensor_msgs::PointCloud2 message;
  message.header.stamp = ros::Time(kStart);
  message.header.frame_id = "camera";
  message.fields = {pointField("x", 0), pointField("y", 4), pointField("z", 8),
                    pointField("rgb", 16)};
  message.height = 1;
  message.width = static_cast<std::uint32_t>(points.size());
  message.point_step = 32;
  message.row_step = message.point_step * message.width;
  message.data.resize(message.row_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&message.data[i * message.point_step], points[i].data(), 3 * sizeof(float));
  }
  return message;
}

/// A rectified camera with 500 px of focal length and 0.2 m of baseline; 640 x 480 px.
inline sensor_msgs::CameraInfo rightCameraInfo() {
  sensor_msgs::CameraInfo message;
  message.width = 640;
  message.height = 480;
  message.P = {500.0, 0.0, 319.5, -100.0, 0.0, 500.0, 239.5, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

inline constexpr double kCameraHeight = 1.2;  // m
inline constexpr double kWallAhead = 10.0;    // m, of the camera

/// A forward-looking camera 2 m ahead of the vehicle's origin.
inline geometry_msgs::TransformStamped cameraMount() {
  geometry_msgs::TransformStamped mount = transform("base_link", "camera", 2.0);
  mount.transform.translation.z = kCameraHeight;
  mount.transform.rotation.x = -0.5;
  mount.transform.rotation.y = 0.5;
  mount.transform.rotation.z = -0.5;
  mount.transform.rotation.w = 0.5;
  return mount;
}

/// That camera's view of a flat road and a wall on it, every few pixels; the wall extends from
/// `right` to `left` (tangents) and up to `top` above the road, m.
inline std::vector<Eigen::Vector3f> wallOnARoad(double left = -1.0, double right = 1.0,
                                                double top = 100.0) {
  std::vector<Eigen::Vector3f> points;
  for (int row = 0; row < 480; row += 4) {
    for (int column = 0; column < 640; column += 4) {
      const double across = (column - 319.5) / 500.0;
      const double down = (row - 239.5) / 500.0;
      const double road = down > 0.0 ? kCameraHeight / down : 1e9;
      const bool on_wall = left < across && across < right &&
                           kCameraHeight - down * kWallAhead < top && kWallAhead < road;
      const double depth = on_wall ? kWallAhead : road;
      if (depth < 100.0) {
        points.emplace_back(Eigen::Vector3d(across * depth, down * depth, depth).cast<float>());
      }
    }
  }
  return points;
}

}  // namespace datmo::samples
