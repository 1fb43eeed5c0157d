#pragma once

#include <string>

#include <geometry_msgs/Pose2D.h>
#include <geometry_msgs/Vector3.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

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

inline geometry_msgs::Pose2D toPose2D(const Pose2& pose) {
  geometry_msgs::Pose2D message;
  message.x = pose.x();
  message.y = pose.y();
  message.theta = pose.heading();
  return message;
}

}  // namespace datmo
