// SPDX-License-Identifier: BSD-3-Clause
// Which messages of two cameras belong together.
#include "datmo_fusion/ros/stage/stereo_pairs.h"

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::stereo_pairs_test {
namespace {

const Stamp kStart = Stamp::fromSeconds(100.0);
constexpr double kTolerance = 0.01;  // s
constexpr double kPeriod = 0.1;      // s

template <typename Message>
boost::shared_ptr<Message> at(Stamp stamp) {
  auto message = boost::make_shared<Message>();
  message->header.stamp = toTime(stamp);
  return message;
}

std::optional<StereoPair> handleFrame(StereoPairs& pairs, StereoSide side, Stamp stamp) {
  EXPECT_FALSE(pairs.handleImage(side, at<sensor_msgs::Image>(stamp)));
  return pairs.handleInfo(side, at<sensor_msgs::CameraInfo>(stamp));
}

TEST(StereoPairs, AllFourMessagesOfAStampAreAPair) {
  StereoPairs pairs(0.0);
  EXPECT_FALSE(pairs.handleInfo(StereoSide::kRight, at<sensor_msgs::CameraInfo>(kStart)));
  EXPECT_FALSE(pairs.handleInfo(StereoSide::kLeft, at<sensor_msgs::CameraInfo>(kStart)));
  EXPECT_FALSE(pairs.handleImage(StereoSide::kLeft, at<sensor_msgs::Image>(kStart)));
  const auto pair = pairs.handleImage(StereoSide::kRight, at<sensor_msgs::Image>(kStart));
  ASSERT_TRUE(pair);
  EXPECT_TRUE(pair->left.complete());
  EXPECT_TRUE(pair->right.complete());
  EXPECT_EQ(pairs.unpaired(), 0U);
}

TEST(StereoPairs, StampsMayDifferByTheTolerance) {
  for (const double difference : {-0.009, 0.009}) {
    StereoPairs pairs(kTolerance);
    EXPECT_FALSE(handleFrame(pairs, StereoSide::kLeft, kStart));
    const auto pair = handleFrame(pairs, StereoSide::kRight, kStart + difference);
    ASSERT_TRUE(pair) << difference;
    EXPECT_EQ(pair->left.stamp, kStart);
    EXPECT_EQ(pair->right.stamp, kStart + difference);
  }
  StereoPairs pairs(kTolerance);
  handleFrame(pairs, StereoSide::kLeft, kStart);
  EXPECT_FALSE(handleFrame(pairs, StereoSide::kRight, kStart + 0.011));
}

TEST(StereoPairs, FrameWithoutPartnerIsDroppedWithTheNextPair) {
  StereoPairs pairs(kTolerance);
  handleFrame(pairs, StereoSide::kLeft, kStart);
  handleFrame(pairs, StereoSide::kLeft, kStart + kPeriod);
  EXPECT_TRUE(handleFrame(pairs, StereoSide::kRight, kStart + kPeriod));
  EXPECT_EQ(pairs.unpaired(), 1U);
}

TEST(StereoPairs, OneCameraAloneFillsNoMemory) {
  StereoPairs pairs(kTolerance);
  constexpr int kFrames = 100;
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_FALSE(handleFrame(pairs, StereoSide::kLeft, kStart + i * kPeriod));
  }
  EXPECT_EQ(pairs.unpaired(), 95U);  // five wait
  EXPECT_FALSE(handleFrame(pairs, StereoSide::kRight, kStart));
  EXPECT_TRUE(handleFrame(pairs, StereoSide::kRight, kStart + 99 * kPeriod));
}

TEST(StereoPairs, LateFrameOfAFullQueueIsDroppedItself) {
  StereoPairs pairs(kTolerance);
  for (int i = 1; i <= 5; ++i) {
    handleFrame(pairs, StereoSide::kLeft, kStart + i * kPeriod);
  }
  EXPECT_FALSE(handleFrame(pairs, StereoSide::kLeft, kStart));
  EXPECT_FALSE(handleFrame(pairs, StereoSide::kRight, kStart));
  for (int i = 1; i <= 5; ++i) {
    const Stamp stamp = kStart + i * kPeriod;
    const auto pair = handleFrame(pairs, StereoSide::kRight, stamp);
    ASSERT_TRUE(pair) << i;
    EXPECT_EQ(pair->left.stamp, stamp);
    EXPECT_EQ(toStamp(pair->left.image->header.stamp), stamp);
    EXPECT_EQ(toStamp(pair->left.info->header.stamp), stamp);
  }
}

TEST(StereoPairs, NothingIsLeftAfterClear) {
  StereoPairs pairs(kTolerance);
  handleFrame(pairs, StereoSide::kLeft, kStart);
  pairs.clear();
  EXPECT_FALSE(handleFrame(pairs, StereoSide::kRight, kStart));
}

}  // namespace
}  // namespace datmo::stereo_pairs_test
