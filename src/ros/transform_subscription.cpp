#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

namespace {

/// As in tf2_ros: a second of many fast publishers.
constexpr std::uint32_t kQueue = 100;

}  // namespace

TransformSubscription::TransformSubscription(ros::NodeHandle node, TransformBuffer& buffer,
                                             std::function<void()> changed) {
  using Callback = boost::function<void(const tf2_msgs::TFMessageConstPtr&)>;
  const Callback add = [&buffer, changed](const tf2_msgs::TFMessageConstPtr& message) {
    buffer.add(*message);
    changed();
  };
  const Callback add_static = [&buffer, changed](const tf2_msgs::TFMessageConstPtr& message) {
    buffer.addStatic(*message);
    changed();
  };
  const ros::VoidConstPtr untracked;
  const auto hints = ros::TransportHints().tcpNoDelay();
  transforms_ = node.subscribe<tf2_msgs::TFMessage>("/tf", kQueue, add, untracked, hints);
  static_transforms_ =
      node.subscribe<tf2_msgs::TFMessage>("/tf_static", kQueue, add_static, untracked, hints);
}

}  // namespace datmo
