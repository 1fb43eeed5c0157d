// SPDX-License-Identifier: BSD-3-Clause
// A subscription ends while others of its process still use its decoder.
#include "datmo_fusion/ros/subscription.h"

#include <memory>

#include <gtest/gtest.h>

#include <ros/callback_queue.h>
#include <std_msgs/Time.h>

namespace datmo::subscription_test {
namespace {

constexpr char kTopic[] = "subscription_test";

/// A node handle with a callback queue of its own, as each nodelet has.
struct Node {
  Node() { handle.setCallbackQueue(&queue); }

  ros::CallbackQueue queue;
  ros::NodeHandle handle;
  StageMonitor monitor{"subscription_test"};
};

TEST(SubscriptionTest, ItsEndReleasesItsCallbackWhileMessagesWaitForOthers) {
  Node ending;
  Node staying;
  // Stands for a publisher, which must end before the queue of its node.
  auto captured = std::make_shared<int>();
  const std::weak_ptr<int> watched = captured;
  auto subscription = std::make_unique<Subscription>(Subscription::to<std_msgs::Time>(
      ending.handle, kTopic, 1, ending.monitor, [captured](const auto& /*time*/) {}));
  captured.reset();
  int received = 0;
  const Subscription other =
      Subscription::to<std_msgs::Time>(staying.handle, kTopic, 1, staying.monitor,
                                       [&received](const auto& /*time*/) { ++received; });
  const auto publisher = ros::NodeHandle().advertise<std_msgs::Time>(kTopic, 1, true);
  publisher.publish(std_msgs::Time());
  constexpr double kMaxSeconds = 60.0;
  ASSERT_EQ(ending.queue.callOne(ros::WallDuration(kMaxSeconds)), ros::CallbackQueue::Called);
  subscription.reset();  // waits until the message is in all queues
  EXPECT_FALSE(staying.queue.isEmpty());
  EXPECT_TRUE(watched.expired());
  staying.queue.callAvailable();
  EXPECT_EQ(received, 1);
}

}  // namespace
}  // namespace datmo::subscription_test
