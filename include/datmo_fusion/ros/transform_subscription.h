// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include <ros/node_handle.h>

#include "datmo_fusion/ros/subscription.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// Feeds a TransformBuffer from /tf and /tf_static, in the callback queue of `node` (unlike
/// tf2_ros::TransformListener, which has its own thread), so that messages waiting for a transform
/// are processed as soon as it is received.
class TransformSubscription {
 public:
  /// `buffer` and `monitor` must outlive the subscription; `changed` is called after each message.
  TransformSubscription(
      ros::NodeHandle node, TransformBuffer& buffer, StageMonitor& monitor,
      std::function<void()> changed = [] {});

 private:
  Subscription transforms_;
  Subscription static_transforms_;
};

}  // namespace datmo
