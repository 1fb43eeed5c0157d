// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "cloud_samples.h"
#include "lidar_samples.h"
#include "message_samples.h"

#include <sensor_msgs/PointCloud2.h>

/// Messages of a 3D lidar, which tests modify.
namespace datmo::samples {

/// The points of a cloud in the frame `velodyne`.
inline sensor_msgs::PointCloud2 lidarMessage(const LidarCloud& lidar) {
  std::vector<Eigen::Vector3f> points;
  for (const pcl::PointXYZ& point : *lidar.points) {
    points.emplace_back(point.x, point.y, point.z);
  }
  auto message = cloud(points);
  message.header.frame_id = "velodyne";
  return message;
}

/// Writes one number for each point where cloud() leaves padding, and declares them as a field.
template <typename Number>
void addTimes(sensor_msgs::PointCloud2& message, const std::string& name, std::uint8_t datatype,
              const std::vector<Number>& numbers) {
  constexpr std::uint32_t kOffset = 24;
  message.fields.push_back(pointField(name, kOffset, datatype));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::memcpy(&message.data[i * message.point_step + kOffset], &numbers[i], sizeof(Number));
  }
}

}  // namespace datmo::samples
