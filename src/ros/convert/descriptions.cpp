// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/descriptions.h"

#include <iomanip>
#include <sstream>

#include "datmo_fusion/common/object.h"

namespace datmo {

namespace {

template <typename Scan>
std::string descriptionOfScan(const Scan& scan) {
  std::ostringstream text;
  text << scan.ranges.size() << " beams to " << std::fixed << std::setprecision(1) << scan.range_max
       << " m in frame " << scan.header.frame_id;
  if (scan.scan_time > 0.0F) {
    text << ", " << 1.0F / scan.scan_time << " Hz";
  }
  return text.str();
}

}  // namespace

std::string descriptionOf(const sensor_msgs::LaserScan& scan) { return descriptionOfScan(scan); }

std::string descriptionOf(const sensor_msgs::MultiEchoLaserScan& scan) {
  return descriptionOfScan(scan);
}

std::string descriptionOf(const nav_msgs::Odometry& odometry) {
  return "in " + odometry.header.frame_id + " -> " + odometry.child_frame_id;
}

std::string descriptionOf(const sensor_msgs::PointCloud2& cloud) {
  return std::to_string(cloud.width) + " x " + std::to_string(cloud.height) + " points in frame " +
         cloud.header.frame_id;
}

std::string descriptionOf(const datmo_fusion::RadarScan& scan) {
  return std::to_string(scan.returns.size()) + " returns in frame " + scan.header.frame_id;
}

std::string descriptionOf(const TrackMessage& track, const std::string& frame) {
  std::ostringstream text;
  text << "id " << track.id << ", " << nameOf(static_cast<ObjectClass>(track.classification))
       << ", at (" << std::fixed << std::setprecision(1) << track.pose.position.x << ", "
       << track.pose.position.y << ") m in " << frame;
  return text.str();
}

}  // namespace datmo
