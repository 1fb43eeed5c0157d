// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/stereo_messages.h"

#include <cstring>

#include <Eigen/Geometry>

#include <sensor_msgs/distortion_models.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/point_field.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::simulator {

namespace {

const char* const kFrame = "stereo_left_optical";

}  // namespace

geometry_msgs::TransformStamped toMount(const StereoCameraOptions& options, Stamp stamp) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = toTime(stamp);
  message.header.frame_id = "base_link";
  message.child_frame_id = kFrame;
  message.transform.translation.x = options.mount_x;
  message.transform.translation.y = options.mount_y;
  message.transform.translation.z = options.mount_height;
  // The optical axes in base_link's: z is its x, x its -y, y its -z.
  const Eigen::Quaterniond reported =
      Eigen::AngleAxisd(-degrees(options.mount_heading_error), Eigen::Vector3d::UnitZ()) *
      Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  message.transform.rotation.x = reported.x();
  message.transform.rotation.y = reported.y();
  message.transform.rotation.z = reported.z();
  message.transform.rotation.w = reported.w();
  return message;
}

sensor_msgs::PointCloud2 toCloud(const StereoPoints& points, Stamp stamp) {
  sensor_msgs::PointCloud2 message;
  message.header.stamp = toTime(stamp);
  message.header.frame_id = kFrame;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(points.points.size());
  message.fields = floatFields({"x", "y", "z"});
  message.is_bigendian = 0U;
  message.point_step = 3 * sizeof(float);
  message.row_step = message.point_step * message.width;
  message.is_dense = 1U;
  message.data.resize(message.row_step);
  std::size_t offset = 0;
  for (const Eigen::Vector3f& point : points.points) {
    std::memcpy(&message.data[offset], point.data(), message.point_step);
    offset += message.point_step;
  }
  return message;
}

sensor_msgs::CameraInfo toLeftInfo(const StereoCameraOptions& options, Stamp stamp) {
  constexpr std::size_t kDistortions = 5;  // of plumb_bob
  const double focal = options.focal_length;
  const double column = options.middleColumn();
  const double row = options.middleRow();
  sensor_msgs::CameraInfo message;
  message.header.stamp = toTime(stamp);
  message.header.frame_id = kFrame;
  message.width = static_cast<std::uint32_t>(options.image_width);
  message.height = static_cast<std::uint32_t>(options.image_height);
  message.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  message.D.resize(kDistortions, 0.0);
  message.K = {focal, 0.0, column, 0.0, focal, row, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {focal, 0.0, column, 0.0, 0.0, focal, row, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

sensor_msgs::CameraInfo toRightInfo(const StereoCameraOptions& options, Stamp stamp) {
  constexpr std::size_t kBaselineTerm = 3;  // of the 3 x 4 projection
  sensor_msgs::CameraInfo message = toLeftInfo(options, stamp);
  message.P[kBaselineTerm] = -options.focal_length * options.baseline;
  return message;
}

}  // namespace datmo::simulator
