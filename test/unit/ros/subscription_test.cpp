// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/subscription.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "raw_message.h"
#include <gtest/gtest.h>

#include <ros/callback_queue.h>
#include <sensor_msgs/LaserScan.h>

namespace datmo::subscription_test {
namespace {

using sensor_msgs::LaserScan;

/// What a subscription to a topic is told, without a connection.
struct Told {
  explicit Told(const std::string& topic)
      : errors(queue, {topic, "sensor_msgs/LaserScan"},
               [this](const DecodeError& error) { list.push_back(error); }) {}

  void spin() { queue.callAvailable(); }

  ros::CallbackQueue queue;
  std::vector<DecodeError> list;
  DecodeErrors errors;
};

class SubscriptionTest : public testing::Test {
 protected:
  SubscriptionTest() {
    scan_.header.seq = 7;
    scan_.header.frame_id = "laser";
    scan_.ranges = {1.0F, 2.0F, 3.0F};
  }

  /// Decodes these bytes for the topic /scan, as roscpp does.
  static ros::VoidConstPtr decode(std::vector<std::uint8_t> bytes) {
    BoundedDecoder<LaserScan> decoder("/scan",
                                      [](const ros::MessageEvent<const LaserScan>& /*event*/) {});
    ros::SubscriptionCallbackHelperDeserializeParams params;
    params.buffer = bytes.data();
    params.length = static_cast<std::uint32_t>(bytes.size());
    params.connection_header = boost::make_shared<ros::M_string>();
    (*params.connection_header)["callerid"] = "/driver";
    return decoder.deserialize(params);
  }

  /// The scan, cut after its header.
  std::vector<std::uint8_t> cutScan() const {
    std::vector<std::uint8_t> bytes = toRaw(scan_).bytes;
    bytes.resize(40);
    return bytes;
  }

  LaserScan scan_;
};

TEST_F(SubscriptionTest, AGoodMessageIsDecoded) {
  Told told("/scan");
  const auto message = boost::static_pointer_cast<const LaserScan>(decode(toRaw(scan_).bytes));
  ASSERT_TRUE(message);
  EXPECT_EQ(*message, scan_);
  told.spin();
  EXPECT_TRUE(told.list.empty());
}

TEST_F(SubscriptionTest, AllSubscriptionsToTheTopicAreToldOfACutMessage) {
  Told one("/scan");
  Told other("/scan");
  Told elsewhere("/scan_2");
  EXPECT_FALSE(decode(cutScan()));
  EXPECT_TRUE(one.list.empty()) << "only in its own queue";
  for (Told* const told : {&one, &other}) {
    told->spin();
    ASSERT_EQ(told->list.size(), 1U);
    EXPECT_EQ(told->list[0].publisher, "/driver");
    EXPECT_EQ(told->list[0].sequence, 7U);
    EXPECT_EQ(told->list[0].count, 1U);
  }
  elsewhere.spin();
  EXPECT_TRUE(elsewhere.list.empty());
}

TEST_F(SubscriptionTest, ACorruptLengthIsDetectedBeforeAllocation) {
  Told told("/scan");
  std::vector<std::uint8_t> bytes = toRaw(scan_).bytes;
  const std::size_t ranges_and_intensities = 4 + 3 * sizeof(float) + 4;
  std::fill_n(bytes.end() - static_cast<std::ptrdiff_t>(ranges_and_intensities), 4,
              std::uint8_t{0xFF});
  EXPECT_FALSE(decode(bytes));
  told.spin();
  ASSERT_EQ(told.list.size(), 1U);
  EXPECT_NE(told.list[0].why.find("4294967295 elements"), std::string::npos) << told.list[0].why;
}

TEST_F(SubscriptionTest, WithoutAHeaderTheNumberIsUnknown) {
  Told told("/scan");
  EXPECT_FALSE(decode({1, 2}));
  told.spin();
  ASSERT_EQ(told.list.size(), 1U);
  EXPECT_EQ(told.list[0].sequence, 0U);
}

TEST_F(SubscriptionTest, AnErrorIsDeliveredOnceBeforeTheNextMessageOrByItself) {
  Told told("/scan");
  decode(cutScan());
  decode(cutScan());
  told.errors.deliver();
  EXPECT_EQ(told.list.size(), 2U);
  told.spin();
  EXPECT_EQ(told.list.size(), 2U);
  decode(cutScan());
  told.spin();
  EXPECT_EQ(told.list.size(), 3U);
}

TEST_F(SubscriptionTest, ABusySubscriptionCountsWhatItCannotKeep) {
  Told told("/scan");
  constexpr std::uint64_t kErrors = 5000;
  for (std::uint64_t i = 0; i < kErrors; ++i) {
    decode(cutScan());
  }
  told.spin();
  EXPECT_LT(told.list.size(), kErrors);
  std::uint64_t count = 0;
  for (const DecodeError& error : told.list) {
    count += error.count;
  }
  EXPECT_EQ(count, kErrors);
}

TEST_F(SubscriptionTest, AfterItsEndNothingIsDelivered) {
  ros::CallbackQueue queue;
  int delivered = 0;
  auto errors =
      std::make_unique<DecodeErrors>(queue, InputTopic{"/scan", "sensor_msgs/LaserScan"},
                                     [&delivered](const DecodeError& /*error*/) { ++delivered; });
  decode(cutScan());
  errors.reset();
  decode(cutScan());
  queue.callAvailable();
  EXPECT_EQ(delivered, 0);
}

}  // namespace
}  // namespace datmo::subscription_test
