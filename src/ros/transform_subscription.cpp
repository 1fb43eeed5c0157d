// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/transform_subscription.h"

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/guard.h"

namespace datmo {

namespace {

/// As in tf2_ros: one second of many fast publishers.
constexpr std::uint32_t kQueue = 100;

constexpr char kTransforms[] = "/tf";
constexpr char kStaticTransforms[] = "/tf_static";

}  // namespace

TransformSubscription::TransformSubscription(ros::NodeHandle node, TransformBuffer& buffer,
                                             StageMonitor& monitor, std::function<void()> changed) {
  using Callback = boost::function<void(const tf2_msgs::TFMessageConstPtr&)>;
  const Callback add = [&buffer, &monitor, changed](const tf2_msgs::TFMessageConstPtr& message) {
    guarded(monitor, kTransforms, [&] {
      monitor.setTime(toStamp(ros::Time::now()));
      buffer.add(*withPlainFrames(kTransforms, message, monitor));
      changed();
    });
  };
  const Callback add_static = [&buffer, &monitor,
                               changed](const tf2_msgs::TFMessageConstPtr& message) {
    guarded(monitor, kStaticTransforms, [&] {
      buffer.addStatic(*withPlainFrames(kStaticTransforms, message, monitor));
      changed();
    });
  };
  const ros::VoidConstPtr untracked;
  const auto hints = ros::TransportHints().tcpNoDelay();
  transforms_ = node.subscribe<tf2_msgs::TFMessage>(kTransforms, kQueue, add, untracked, hints);
  static_transforms_ =
      node.subscribe<tf2_msgs::TFMessage>(kStaticTransforms, kQueue, add_static, untracked, hints);
}

}  // namespace datmo
