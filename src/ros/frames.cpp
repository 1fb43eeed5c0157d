// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/frames.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <geometry_msgs/TransformStamped.h>
#include <tf2/LinearMath/Matrix3x3.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

geometry_msgs::Transform lookUp(const tf2::BufferCore& transforms, const std::string& parent_frame,
                                const std::string& child_frame, const ros::Time& time) {
  try {
    return transforms.lookupTransform(parent_frame, child_frame, time).transform;
  } catch (const std::runtime_error& error) {  // from tf2, and from ros::Time near its end
    throw InputError("missing_transform", "transform " + parent_frame + " -> " + child_frame +
                                              ": expected on tf (" + error.what() + ")");
  }
}

/// Throws InputError if the sensor is not on the vehicle: beams from far away are useless, and
/// those from infinity never end.
void checkDistance(const geometry_msgs::Transform& mount, const std::string& name) {
  const auto& t = mount.translation;
  const double distance = std::hypot(t.x, t.y, t.z);
  if (!(distance <= kMaxMountDistance)) {
    throw InputError("mount_too_far", "mount " + name + " is " + std::to_string(distance) +
                                          " m from the vehicle's origin: expected at most " +
                                          std::to_string(kMaxMountDistance) +
                                          " m; correct it on tf");
  }
}

/// The newest mount of a sensor. If it is missing, the error says what to do.
geometry_msgs::Transform lookUpMount(const tf2::BufferCore& transforms,
                                     const std::string& base_frame,
                                     const std::string& sensor_frame) {
  if (sensor_frame.empty()) {
    throw InputError(
        "missing_frame",
        "a message without frame_id: expected its sensor's frame; set frame_id in its driver");
  }
  geometry_msgs::Transform mount;
  try {
    mount = lookUp(transforms, base_frame, sensor_frame, ros::Time(0));
  } catch (const InputError& error) {
    throw InputError(error.reason(),
                     std::string(error.what()) +
                         "; give the sensor's pose on the vehicle (m, rad) "
                         "in the yaml file, mounts: {" +
                         sensor_frame + ": {x: 0.0, y: 0.0, z: 0.0, yaw: 0.0}}, or live with " +
                         "rosrun tf2_ros static_transform_publisher X Y Z YAW PITCH ROLL " +
                         base_frame + " " + sensor_frame);
  }
  checkDistance(mount, base_frame + " -> " + sensor_frame);
  return mount;
}

/// Columns: the child's axes in the parent frame.
tf2::Matrix3x3 axes(const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  return tf2::Matrix3x3(tf2::Quaternion(q.x, q.y, q.z, q.w));
}

/// Planar position and direction of the x axis.
Pose2 fromAbove(const geometry_msgs::Transform& transform) {
  const tf2::Vector3 forward = axes(transform).getColumn(0);
  return {transform.translation.x, transform.translation.y, std::atan2(forward.y(), forward.x())};
}

}  // namespace

ScannerMount scannerMount(const tf2::BufferCore& transforms, const std::string& base_frame,
                          const std::string& scanner_frame) {
  const auto transform = lookUpMount(transforms, base_frame, scanner_frame);
  const double up = axes(transform).getColumn(2).z();
  ScannerMount mount;
  mount.scanner_in_base = fromAbove(transform);
  mount.upside_down = up < 0.0;
  mount.tilt = std::acos(std::min(1.0, std::abs(up)));
  return mount;
}

Eigen::Isometry3d sensorMount(const tf2::BufferCore& transforms, const std::string& base_frame,
                              const std::string& sensor_frame) {
  const auto transform = lookUpMount(transforms, base_frame, sensor_frame);
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return Eigen::Translation3d(t.x, t.y, t.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

Pose2 planarPose(const tf2::BufferCore& transforms, const std::string& parent_frame,
                 const std::string& child_frame, const ros::Time& time) {
  return fromAbove(lookUp(transforms, parent_frame, child_frame, time));
}

}  // namespace datmo
