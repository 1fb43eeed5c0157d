// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Pose2D.h>
#include <geometry_msgs/Vector3.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

template <typename Values>
std::vector<float> toFloats(const Values& values) {
  std::vector<float> result;
  std::transform(values.begin(), values.end(), std::back_inserter(result),
                 [](double value) { return static_cast<float>(value); });
  return result;
}

/// All NaN if the message has another number of them.
template <std::size_t count>
std::array<double, count> fromFloats(const std::vector<float>& values) {
  std::array<double, count> result;
  if (values.size() == count) {
    std::copy(values.begin(), values.end(), result.begin());
  } else {
    result.fill(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// Sets the most likely class of a message of an object or a track, and the probabilities of all.
template <typename Message>
void setClasses(const ClassProbabilities& probabilities, Message& message) {
  const ObjectClass most_likely = mostLikelyClass(probabilities);
  message.classification = static_cast<std::uint8_t>(most_likely);
  message.class_probability =
      static_cast<float>(probabilities[static_cast<std::size_t>(most_likely)]);
  message.class_probabilities = toFloats(probabilities);
}

inline std_msgs::Header header(Stamp stamp, const std::string& frame) {
  std_msgs::Header result;
  result.stamp = toTime(stamp);
  result.frame_id = frame;
  return result;
}

inline geometry_msgs::Vector3 planar(double x, double y) {
  geometry_msgs::Vector3 vector;
  vector.x = x;
  vector.y = y;
  return vector;
}

inline Pose2 toPose2(const geometry_msgs::Pose2D& pose) { return {pose.x, pose.y, pose.theta}; }

inline geometry_msgs::Pose2D toPose2D(const Pose2& pose) {
  geometry_msgs::Pose2D message;
  message.x = pose.x();
  message.y = pose.y();
  message.theta = pose.heading();
  return message;
}

/// Length, width and height of a box, m.
inline geometry_msgs::Vector3 size(const Box2& box, double height) {
  geometry_msgs::Vector3 result;
  result.x = box.length;
  result.y = box.width;
  result.z = height;
  return result;
}

ObjectMessage toMessage(const Object& object);

/// The heading is the rotation about the vertical axis; others are ignored.
inline Pose2 boxCenter(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return {pose.position.x, pose.position.y, 2.0 * std::atan2(q.z, q.w)};
}

}  // namespace datmo
