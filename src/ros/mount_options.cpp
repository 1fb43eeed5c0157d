// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/mount_options.h"

#include <tf2/LinearMath/Quaternion.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/frames.h"

namespace datmo {

namespace {

geometry_msgs::TransformStamped toMessage(const std::string& base_frame, const std::string& frame,
                                          const MountOptions& mount) {
  tf2::Quaternion rotation;
  rotation.setRPY(mount.roll, mount.pitch, mount.yaw);
  geometry_msgs::TransformStamped message;
  message.header.frame_id = base_frame;
  message.child_frame_id = frame;
  message.transform.translation.x = mount.x;
  message.transform.translation.y = mount.y;
  message.transform.translation.z = mount.z;
  message.transform.rotation.x = rotation.x();
  message.transform.rotation.y = rotation.y();
  message.transform.rotation.z = rotation.z();
  message.transform.rotation.w = rotation.w();
  return message;
}

}  // namespace

void MountOptions::visit(OptionVisitor& visitor) {
  visitor.number({"x", "m", "the sensor's origin in the vehicle's frame, forward", Tier::kPublic},
                 x, {-kMaxMountDistance, kMaxMountDistance});
  visitor.number({"y", "m", "to the left", Tier::kPublic}, y,
                 {-kMaxMountDistance, kMaxMountDistance});
  visitor.number({"z", "m", "up", Tier::kPublic}, z, {-kMaxMountDistance, kMaxMountDistance});
  visitor.number({"yaw", "rad", "about the vehicle's z axis, after pitch and roll", Tier::kPublic},
                 yaw, {-kPi, kPi});
  visitor.number(
      {"pitch", "rad", "about its y axis, after roll; positive: looking down", Tier::kPublic},
      pitch, {-kPi, kPi});
  visitor.number({"roll", "rad", "about its x axis", Tier::kPublic}, roll, {-kPi, kPi});
}

Mounts readMounts(const OptionValues& values) {
  std::map<std::string, OptionValues> by_frame;
  for (const auto& [key, value] : values) {
    const std::size_t slash = key.find_last_of('/');
    const std::string frame = slash == std::string::npos ? "" : withoutSlash(key.substr(0, slash));
    if (frame.empty()) {
      throw OptionError(key + " = " + toText(value) +
                        ": expected a frame with its mount, as in laser: {x: 1.0, yaw: 0.0}");
    }
    by_frame[frame][key.substr(slash + 1)] = value;
  }
  Mounts mounts;
  for (const auto& [frame, mount] : by_frame) {
    try {
      mounts[frame] = readOptions<MountOptions>(mount);
    } catch (const OptionError& error) {
      throw OptionError(frame + ": " + error.what());
    }
  }
  return mounts;
}

tf2_msgs::TFMessage toMessage(const Mounts& mounts, const std::string& base_frame) {
  tf2_msgs::TFMessage message;
  for (const auto& [frame, mount] : mounts) {
    message.transforms.push_back(toMessage(base_frame, frame, mount));
  }
  return message;
}

}  // namespace datmo
