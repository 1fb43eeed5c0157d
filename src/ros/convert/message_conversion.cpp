// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/message_conversion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "message_parts.h"

#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/output_check.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Quaternions are sent as doubles; one with a larger error was never normalized.
constexpr double kUnitLengthTolerance = 1e-3;

/// Index of our covariance over x, y and heading in ROS's 6 x 6 (x, y, z, roll, pitch, yaw).
std::size_t indexInSix(int row, int column) {
  constexpr std::array<std::size_t, 3> kPlanar = {0, 1, 5};
  return 6 * kPlanar.at(static_cast<std::size_t>(row)) +
         kPlanar.at(static_cast<std::size_t>(column));
}

bool isReach(double range) { return range >= 0.0 && range <= kMaxReach; }

ScanPointMessage toMessage(const ScanPoint& point) {
  ScanPointMessage message;
  message.x = static_cast<float>(point.position.x());
  message.y = static_cast<float>(point.position.y());
  message.range = static_cast<float>(point.range);
  message.bearing = static_cast<float>(point.bearing);
  message.beam = static_cast<std::uint16_t>(point.beam);
  message.state = static_cast<std::uint8_t>(point.state);
  return message;
}

ScanPoint fromMessage(const ScanPointMessage& message) {
  ScanPoint point;
  point.position = Point2(message.x, message.y);
  point.range = message.range;
  point.bearing = message.bearing;
  point.beam = message.beam;
  point.state = static_cast<PointState>(message.state);
  // NaN compares false with everything.
  const bool near = point.position.norm() <= kMaxReach + kMaxMountDistance &&
                    isReach(point.range) && std::abs(point.bearing) <= kMaxBearing;
  if (!near || message.state > ScanPointMessage::UNKNOWN) {
    throw InputError("bad_point",
                     "labeled scan with beam " + std::to_string(message.beam) + " at " +
                         std::to_string(message.x) + ", " + std::to_string(message.y) +
                         ", bearing " + std::to_string(message.bearing) + ", in state " +
                         std::to_string(message.state) +
                         ": expected a point within a scanner's range, a bearing within two turns, "
                         "and a state from 0 to 2");
  }
  return point;
}

ScanFieldMessage toMessage(const ScanField& field) {
  ScanFieldMessage message;
  message.first_bearing = field.first_bearing;
  message.beam_spacing = field.beam_spacing;
  message.beams = field.beams;
  message.min_range = static_cast<float>(field.min_range);
  message.free_range = static_cast<float>(field.free_range);
  message.range = static_cast<float>(field.range);
  message.beam_time = field.beam_time;
  return message;
}

ScanField fromMessage(const ScanFieldMessage& message) {
  const ScanField field{message.first_bearing, message.beam_spacing, message.beams,
                        message.min_range,     message.free_range,   message.range,
                        message.beam_time};
  const bool usable = std::abs(field.first_bearing) <= kMaxBearing &&
                      std::abs(field.beam_spacing) <= kMaxBearing && field.beam_time >= 0.0 &&
                      field.beam_time * field.beams <= kMaxSweep && isReach(field.min_range) &&
                      isReach(field.free_range) && isReach(field.range);
  if (!usable || (field.beams > 0 && field.beam_spacing == 0.0) || field.beams > kMaxBeams) {
    throw InputError(
        "bad_field",
        "labeled scan of " + std::to_string(field.beams) + " beams from " +
            std::to_string(field.first_bearing) + " rad every " +
            std::to_string(field.beam_spacing) + " rad up to " + std::to_string(field.range) +
            " m, one every " + std::to_string(field.beam_time) +
            " s: expected angles within two turns, ranges up to " + std::to_string(kMaxReach) +
            " m, a spacing other than 0, at most " + std::to_string(kMaxBeams) +
            " beams, and from 0 to " + std::to_string(kMaxSweep) + " s for all of them");
  }
  return field;
}

}  // namespace

geometry_msgs::Pose toMessage(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x();
  message.position.y = pose.y();
  message.orientation.z = std::sin(0.5 * pose.heading());
  message.orientation.w = std::cos(0.5 * pose.heading());
  return message;
}

geometry_msgs::PoseWithCovariance toMessage(const PoseWithCovariance& pose) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = toMessage(pose.pose);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.covariance.at(indexInSix(row, column)) = pose.covariance(row, column);
    }
  }
  return message;
}

Pose2 fromMessage(const geometry_msgs::Pose& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const bool reasonable = std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate;
  if (!reasonable || !(std::abs(length - 1.0) < kUnitLengthTolerance)) {
    throw InputError("bad_pose", "pose at " + std::to_string(p.x) + ", " + std::to_string(p.y) +
                                     " with a quaternion of length " + std::to_string(length) +
                                     ": expected finite numbers within 20000 km and length 1");
  }
  const double heading =
      std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
  return {p.x, p.y, heading};
}

Eigen::Matrix3d planarCovariance(const geometry_msgs::PoseWithCovariance& message) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      covariance(row, column) = message.covariance.at(indexInSix(row, column));
    }
  }
  return covariance;
}

PoseWithCovariance fromMessage(const geometry_msgs::PoseWithCovariance& message) {
  const PoseWithCovariance pose{fromMessage(message.pose), planarCovariance(message)};
  if (!isCovariance(pose.covariance.data(), 3) ||
      pose.covariance.diagonal().maxCoeff() > kMaxCoordinate * kMaxCoordinate) {
    throw InputError("bad_pose",
                     "pose with an invalid covariance of x, y and yaw: expected finite numbers up "
                     "to the square of 20000 km, symmetric and positive semidefinite");
  }
  return pose;
}

geometry_msgs::TransformStamped toTransform(const Pose2& child_in_parent, Stamp stamp,
                                            const std::string& parent_frame,
                                            const std::string& child_frame) {
  geometry_msgs::TransformStamped message;
  message.header = header(stamp, parent_frame);
  message.child_frame_id = child_frame;
  message.transform.translation = planar(child_in_parent.x(), child_in_parent.y());
  message.transform.rotation = toMessage(child_in_parent).orientation;
  return message;
}

OdometrySample toSample(const nav_msgs::Odometry& message) {
  const Twist2 twist{message.twist.twist.linear.x, message.twist.twist.angular.z};
  if (!isPlausible(twist)) {
    throw InputError("bad_odometry", "odometry with speed " + std::to_string(twist.forward_speed) +
                                         " m/s and yaw rate " + std::to_string(twist.yaw_rate) +
                                         " rad/s: expected at most " + std::to_string(kMaxSpeed) +
                                         " m/s and " + std::to_string(kMaxYawRate) + " rad/s");
  }
  return {toStamp(message.header.stamp), twist};
}

LabeledScanMessage toMessage(const LabeledScan& scan, const std::string& base_frame,
                             const std::string& map_frame) {
  LabeledScanMessage message;
  message.header = header(scan.stamp, base_frame);
  message.map_frame = map_frame;
  message.pose = toMessage(scan.base_in_map);
  message.scanner = toPose2D(scan.scanner_in_base);
  message.field = toMessage(scan.field);
  message.blind_beams.assign(scan.blind_beams.begin(), scan.blind_beams.end());
  for (const ScanPoint& point : scan.points) {
    message.points.push_back(toMessage(point));
  }
  return message;
}

LabeledScan fromMessage(const LabeledScanMessage& message) {
  LabeledScan scan;
  scan.stamp = toStamp(message.header.stamp);
  scan.base_in_map = fromMessage(message.pose);
  const geometry_msgs::Pose2D& scanner = message.scanner;
  if (!(std::hypot(scanner.x, scanner.y) <= kMaxMountDistance) || !std::isfinite(scanner.theta)) {
    throw InputError("bad_pose", "scanner at " + std::to_string(scanner.x) + ", " +
                                     std::to_string(scanner.y) + ", heading " +
                                     std::to_string(scanner.theta) +
                                     ": expected finite numbers, at most " +
                                     std::to_string(kMaxMountDistance) + " m from the vehicle");
  }
  scan.scanner_in_base = toPose2(scanner);
  scan.field = fromMessage(message.field);
  scan.blind_beams.assign(message.blind_beams.begin(), message.blind_beams.end());
  for (const ScanPointMessage& point : message.points) {
    scan.points.push_back(fromMessage(point));
  }
  return scan;
}

nav_msgs::OccupancyGrid toMessage(const OccupancyMap& map, Stamp stamp,
                                  const std::string& map_frame) {
  const GridWindow& window = map.window();
  nav_msgs::OccupancyGrid message;
  message.header = header(stamp, map_frame);
  message.info.map_load_time = message.header.stamp;
  message.info.resolution = static_cast<float>(window.cell_size);
  message.info.width = static_cast<std::uint32_t>(window.columns);
  message.info.height = static_cast<std::uint32_t>(window.rows);
  message.info.origin = toMessage(Pose2(window.origin(), 0.0));
  message.data = map.occupancyImage();
  return message;
}

}  // namespace datmo
