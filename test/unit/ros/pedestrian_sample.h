// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// Another system's report: a pedestrian 8 m ahead of the vehicle, wherever that is.
inline ObjectArray pedestrianAt(Stamp stamp) {
  ObjectMessage pedestrian;
  pedestrian.pose.position.x = 8.0;
  pedestrian.pose.orientation.w = 1.0;
  pedestrian.size.x = 0.5;
  pedestrian.size.y = 0.5;
  pedestrian.position_covariance = {0.1, 0.0, 0.0, 0.1};
  pedestrian.classification = ObjectMessage::CLASS_PEDESTRIAN;
  pedestrian.class_probability = 0.9F;
  ObjectArray list;
  list.header.stamp = toTime(stamp);
  list.header.frame_id = "base_link";
  list.objects = {pedestrian};
  return list;
}

}  // namespace datmo
