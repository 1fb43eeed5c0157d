// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/transform_subscription.h"

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

namespace {

/// As in tf2_ros: one second of many fast publishers.
constexpr std::uint32_t kQueue = 100;

}  // namespace

TransformSubscription::TransformSubscription(ros::NodeHandle node, TransformBuffer& buffer,
                                             StageMonitor& monitor, std::function<void()> changed) {
  using Message = tf2_msgs::TFMessage;
  transforms_ = Subscription::to<Message>(
      node, kTransformTopic, kQueue, monitor,
      [&buffer, &monitor, changed](const tf2_msgs::TFMessageConstPtr& message) {
        monitor.setTime(toStamp(ros::Time::now()));
        buffer.add(*withPlainFrames(kTransformTopic, message, monitor));
        changed();
      });
  static_transforms_ = Subscription::to<Message>(
      node, kStaticTransformTopic, kQueue, monitor,
      [&buffer, &monitor, changed](const tf2_msgs::TFMessageConstPtr& message) {
        buffer.addStatic(*withPlainFrames(kStaticTransformTopic, message, monitor));
        changed();
      });
}

}  // namespace datmo
