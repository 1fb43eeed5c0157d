// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// How a sensor is mounted: pose of its frame in the vehicle's.
struct MountOptions {
  double x = 0.0;      ///< m, ahead
  double y = 0.0;      ///< m, to the left
  double z = 0.0;      ///< m, up
  double yaw = 0.0;    ///< rad
  double pitch = 0.0;  ///< rad
  double roll = 0.0;   ///< rad

  void visit(OptionVisitor& visitor);
};

/// Mounts by the sensor's frame: section `mounts` of a sensor set, for recordings and robots
/// without tf.
using Mounts = std::map<std::string, MountOptions>;

/// From the section's keys `<frame>/x`, `<frame>/yaw` and so on; a frame may have slashes in its
/// name, and one at its front is left out. Throws OptionError that names frame and key.
Mounts readMounts(const OptionValues& values);

/// As they would come on /tf_static.
tf2_msgs::TFMessage toMessage(const Mounts& mounts, const std::string& base_frame);

}  // namespace datmo
