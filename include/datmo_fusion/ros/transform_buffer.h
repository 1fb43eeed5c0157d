// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include <tf2_msgs/TFMessage.h>

#include <tf2/buffer_core.h>

#include "datmo_fusion/common/stamp_gate.h"
#include "datmo_fusion/ros/shared_options.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// A tf buffer fed by its owner, so that a stage sees transforms in order with its other messages:
/// live from the nodelet's callback queue, in batch from the bag.
///
/// When the clock jumps back (a looped bag), as confirmed by a second transform or ROS time, all
/// but the static transforms are forgotten, so that no pose is interpolated between two runs. A
/// transform that is not finite, has a non-unit quaternion or an impossible stamp is ignored, and
/// the monitor is warned. Thread safe only as far as tf2::BufferCore is.
class TransformBuffer {
 public:
  explicit TransformBuffer(double restart_after) : restart_after_(restart_after) {}

  /// With mounts that are used as if received on /tf_static until tf has the frame: then tf takes
  /// precedence, and `monitor`, which must outlive this, is warned once of a mount that differs.
  TransformBuffer(double restart_after, const SharedOptions& shared, StageMonitor& monitor);

  void add(const tf2_msgs::TFMessage& message);
  void addStatic(const tf2_msgs::TFMessage& message);

  const tf2::BufferCore& core() const { return core_; }

 private:
  /// Whether it is a rigid motion at a valid time; warns the monitor if not.
  bool isGood(const geometry_msgs::TransformStamped& transform);

  /// Whether it is neither repeated nor stray; forgets the old run if the clock has jumped back.
  bool isNew(const geometry_msgs::TransformStamped& transform);

  /// Adds it to tf2, replacing the mount of that frame if there is one.
  void set(const geometry_msgs::TransformStamped& transform, bool is_static);

  double restart_after_;
  StageMonitor* monitor_ = nullptr;                                ///< null without mounts
  std::map<std::string, geometry_msgs::TransformStamped> mounts_;  ///< by frame; not from tf yet
  tf2::BufferCore core_;
  std::map<std::string, StampGate> gates_;  ///< by child frame
};

}  // namespace datmo
