// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "fusion_stage_sample.h"
#include "message_samples.h"
#include "seen_object.h"

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"

namespace datmo {

/// A car that `sensor` saw well, ahead and to the side in the vehicle's frame (m).
inline Object car(const std::string& sensor, double ahead, double left) {
  return samples::seenObject(sensor, {{ahead, left, 0.0}, 4.0, 1.8});
}

class ObjectFusionStageTest : public FusionStageTest<ObjectFusionStage> {
 protected:
  static constexpr char kLists[] = "object list";
  static constexpr char kFrame[] = "base_link";

  explicit ObjectFusionStageTest(const ObjectFusionStageOptions& options = {})
      : FusionStageTest("object_fusion", options) {}

  static nav_msgs::Odometry odometry(double seconds) { return samples::odometry(seconds, 20.0); }

  static ObjectArray list(double seconds, const std::vector<Object>& objects) {
    return toMessage(ObjectList{Stamp::fromSeconds(seconds), objects, {}}, "base_link");
  }

  /// A list of one car, which this source sees.
  void handle(const std::string& source, double seconds, double ahead = 20.0, double left = 0.0) {
    handle(source, list(seconds, {car(source, ahead, left)}));
  }

  void handle(const std::string& source, const ObjectArray& objects) {
    handle(source, objects, toStamp(objects.header.stamp));
  }
  void handle(const std::string& source, const ObjectArray& objects, Stamp now) {
    stage_.handleObjects(source, objects, now);
  }

  /// Both sources see the same car at this time.
  ObjectArrayPtr bothAt(double seconds) {
    handle("lidar", seconds);
    handle("stereo", seconds);
    return nextAt(seconds);
  }
};

using Sensors = std::vector<std::string>;

/// Returns the sensors of all objects of a list, in no particular order.
inline std::vector<Sensors> sensorsOf(const ObjectArray& list) {
  std::vector<Sensors> result;
  for (const ObjectMessage& object : list.objects) {
    result.push_back(object.sensors);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace datmo
