// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/transform_subscription.h"

#include "datmo_fusion/ros/frame_ids.h"

namespace datmo {

namespace {

/// As in tf2_ros: one second of many fast publishers.
constexpr std::uint32_t kQueue = 100;

constexpr char kTransforms[] = "/tf";
constexpr char kStaticTransforms[] = "/tf_static";

}  // namespace

TransformSubscription::TransformSubscription(ros::NodeHandle node, TransformBuffer& buffer,
                                             StageMonitor& monitor, std::function<void()> changed) {
  using Message = tf2_msgs::TFMessage;
  transforms_ = Subscription::to<Message>(
      node, kTransforms, kQueue, monitor,
      [&buffer, &monitor, changed](const tf2_msgs::TFMessageConstPtr& message) {
        monitor.setTime(toStamp(ros::Time::now()));
        buffer.add(*withPlainFrames(kTransforms, message, monitor));
        changed();
      });
  static_transforms_ = Subscription::to<Message>(
      node, kStaticTransforms, kQueue, monitor,
      [&buffer, &monitor, changed](const tf2_msgs::TFMessageConstPtr& message) {
        buffer.addStatic(*withPlainFrames(kStaticTransforms, message, monitor));
        changed();
      });
}

}  // namespace datmo
