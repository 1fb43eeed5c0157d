// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// Pose of a sensor's frame in the vehicle's.
struct MountOptions {
  double x = 0.0;      ///< m, forward
  double y = 0.0;      ///< m, to the left
  double z = 0.0;      ///< m, up
  double yaw = 0.0;    ///< rad
  double pitch = 0.0;  ///< rad
  double roll = 0.0;   ///< rad

  void visit(OptionVisitor& visitor);
};

/// Mounts by sensor frame: section `mounts` of a sensor set, for recordings and robots without tf.
using Mounts = std::map<std::string, MountOptions>;

/// Reads the section's keys `<frame>/x`, `<frame>/yaw` and so on; a frame name may contain slashes,
/// and a leading one is stripped. Throws OptionError that names frame and key.
Mounts readMounts(const OptionValues& values);

/// Converts the mounts to a message as on /tf_static.
tf2_msgs::TFMessage toMessage(const Mounts& mounts, const std::string& base_frame);

}  // namespace datmo
