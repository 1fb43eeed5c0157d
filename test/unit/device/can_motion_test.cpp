// SPDX-License-Identifier: BSD-3-Clause
// The vehicle's motion from the frames of a made-up bus, and faults of these frames.
#include "datmo_fusion/device/can_motion.h"

#include <cmath>
#include <map>

#include "device/can_samples.h"
#include <gtest/gtest.h>

namespace datmo::can_motion_test {
namespace {

using samples::canFrame;
using samples::canSample;
using samples::speedFrame;
using samples::yawFrame;

constexpr double kDegree = 3.14159265358979 / 180.0;

class CanMotionTest : public testing::Test {
 protected:
  std::optional<CanMotion::Motion> take(const CanFrame& frame) {
    if (!motion_) {
      motion_.emplace(options_, [this](const DeviceError& error) { ++warnings_[error.reason()]; });
    }
    return motion_->update(frame, Stamp::fromSeconds(now_));
  }

  /// Takes speed and yaw rate, with a correct counter.
  std::optional<CanMotion::Motion> takeBoth(double speed, double rate) {
    take(yawFrame(rate));
    return take(speedFrame(speed, counter_++));
  }

  std::string refusal() const {
    try {
      CanMotion(options_, [](const DeviceError& /*error*/) {});
    } catch (const OptionError& error) {
      return error.what();
    }
    return "none";
  }

  CanOptions options_ = canSample();
  double now_ = 1000.0;
  unsigned counter_ = 0;
  std::optional<CanMotion> motion_;
  std::map<std::string, int> warnings_;
};

TEST_F(CanMotionTest, EachSpeedGivesAMotionWithTheNewestYawRate) {
  takeBoth(0.0, 0.0);  // whose counter has not advanced yet
  const auto motion = takeBoth(10.0, -5.0);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->twist.speed, 10.0, 1e-9);
  EXPECT_NEAR(motion->twist.yaw_rate, -5.0 * kDegree, 1e-9);
  EXPECT_EQ(motion->missed, 0U);
  EXPECT_FALSE(take(yawFrame(3.0)));
  EXPECT_FALSE(take(canFrame(0x333, {1, 2, 3})));
  EXPECT_FALSE(take(canFrame(0x800001A0, {0, 0, 0})));  // the same number, 29 bits
  now_ += 0.3;
  const auto later = take(speedFrame(11.0, counter_ + 3));
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->twist.yaw_rate, 3.0 * kDegree, 1e-9);
  EXPECT_EQ(later->missed, 3U);
  EXPECT_EQ(later->twist.other_frames, 2U);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(CanMotionTest, TheCounterWrapsAround) {
  options_.counter_values = 15;  // 0 to 14
  take(yawFrame(0.0));
  take(speedFrame(1.0, 13));
  EXPECT_EQ(take(speedFrame(1.0, 14))->missed, 0U);
  EXPECT_EQ(take(speedFrame(1.0, 0))->missed, 0U);
  EXPECT_EQ(take(speedFrame(1.0, 14))->missed, 13U);
}

TEST_F(CanMotionTest, AMessageWithAFrozenCounterIsNotUsed) {
  takeBoth(1.0, 0.0);
  EXPECT_TRUE(takeBoth(2.0, 0.0));
  for (int i = 0; i < 2; ++i) {  // a repeated message alone is no fault
    EXPECT_TRUE(take(speedFrame(2.0, counter_ - 1)));
  }
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(take(speedFrame(2.0, counter_ - 1)));
  }
  EXPECT_EQ(warnings_["frozen_counter"], 5);
  EXPECT_TRUE(takeBoth(2.0, 0.0));
}

TEST_F(CanMotionTest, AYawRateWithAFrozenCounterIsNotUsed) {
  options_.yaw_counter = "0x1B0 16|4@1+ (1,0)";
  std::uint8_t yaw_counter = 0;
  const auto yaw = [&yaw_counter] { return canFrame(samples::kYawId, {0, 0, yaw_counter}); };
  const auto speed = [this] { return take(speedFrame(1.0, counter_++)); };
  take(yaw());
  speed();
  EXPECT_FALSE(speed());  // it has not advanced yet
  ++yaw_counter;
  take(yaw());
  EXPECT_TRUE(speed());
  for (int i = 0; i < 8; ++i) {
    now_ += 0.1;
    take(yaw());
  }
  EXPECT_FALSE(speed());
  EXPECT_EQ(warnings_["frozen_counter"], 6);
  ++yaw_counter;
  take(yaw());
  EXPECT_TRUE(speed());
}

TEST_F(CanMotionTest, ACounterOfAnotherMessageIsRefused) {
  options_.counter = "0x1B0 16|4@1+ (1,0)";
  EXPECT_NE(refusal().find("can/counter is in the message 0x1B0"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("0x1A0 of can/speed"), std::string::npos) << refusal();
  options_ = canSample();
  options_.yaw_counter = "0x1A0 0|4@1+ (1,0)";
  EXPECT_NE(refusal().find("can/yaw_counter is in the message 0x1A0"), std::string::npos)
      << refusal();
  EXPECT_NE(refusal().find("0x1B0 of can/yaw_rate"), std::string::npos) << refusal();
  options_ = canSample();
  options_.yaw_rate.clear();
  options_.yaw_from = CanYaw::kNone;
  options_.yaw_counter = "0x1B0 16|4@1+ (1,0)";
  EXPECT_NE(refusal().find("none"), std::string::npos);
  EXPECT_NE(refusal().find("can/yaw_counter"), std::string::npos) << refusal();
}

TEST_F(CanMotionTest, AnIdWithoutXIsDecimal) {
  options_.speed = "0416 8|16@1+ (0.01,0) [0|250] \"km/h\"";  // 0x1A0
  takeBoth(1.0, 0.0);
  EXPECT_TRUE(takeBoth(1.0, 0.0));
}

TEST_F(CanMotionTest, BadFramesAndSignalsAreNamedAndTheRestIsUsed) {
  takeBoth(1.0, 0.0);
  EXPECT_FALSE(take(canFrame(samples::kSpeedId, {static_cast<std::uint8_t>(counter_), 0})));
  EXPECT_EQ(warnings_["bad_frame"], 1);
  counter_ += 1;
  EXPECT_FALSE(take(speedFrame(655.35 / 3.6, counter_++)));  // all ones: not valid
  EXPECT_EQ(warnings_["bad_signal"], 1);
  EXPECT_FALSE(take(canFrame(samples::kSpeedId, {})));
  EXPECT_EQ(warnings_["bad_frame"], 2);
  EXPECT_TRUE(takeBoth(1.0, 0.0));
  take(yawFrame(200.0));
  EXPECT_EQ(warnings_["bad_signal"], 2);
  EXPECT_FALSE(take(speedFrame(1.0, counter_++)));
  EXPECT_EQ(warnings_["stale_signal"], 1);
  EXPECT_TRUE(takeBoth(1.0, 0.0));
}

TEST_F(CanMotionTest, AnOldYawRateIsNotUsed) {
  takeBoth(1.0, 0.0);
  take(yawFrame(1.0));
  now_ += 0.49;
  EXPECT_TRUE(take(speedFrame(1.0, counter_++)));
  now_ += 0.02;
  EXPECT_FALSE(take(speedFrame(1.0, counter_++)));
  EXPECT_EQ(warnings_["stale_signal"], 1);
}

TEST_F(CanMotionTest, TheDirectionGivesTheSpeedASign) {
  options_.direction = "0x1C0 0|4@1+ (1,0)";
  options_.reverse = 7.0;
  takeBoth(1.0, 0.0);
  EXPECT_FALSE(takeBoth(1.0, 0.0));  // it is not known yet
  take(canFrame(0x1C0, {7}));
  EXPECT_NEAR(takeBoth(2.0, 0.0)->twist.speed, -2.0, 1e-9);
  take(canFrame(0x1C0, {3}));
  EXPECT_NEAR(takeBoth(2.0, 0.0)->twist.speed, 2.0, 1e-9);
}

TEST_F(CanMotionTest, WheelsGiveSpeedAndYawRate) {
  options_ = CanOptions();
  options_.rear_left = "0x0F0 0|16@1+ (0.01,0) [0|0] \"rad/s\"";
  options_.rear_right = "0x0F0 16|16@1+ (0.01,0) [0|0] \"rad/s\"";
  options_.yaw_from = CanYaw::kWheels;
  options_.wheel_radius = 0.25;
  options_.track_width = 1.6;
  // 40 rad/s and 44 rad/s: 10 m/s and 11 m/s.
  const CanFrame frame = canFrame(0x0F0, {0xA0, 0x0F, 0x30, 0x11});
  const auto ahead = take(frame);
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->twist.speed, 10.5, 1e-9);
  EXPECT_NEAR(ahead->twist.yaw_rate, 1.0 / 1.6, 1e-9);
  options_.direction = "0x0F0 32|1@1+ (1,0)";
  motion_.reset();
  const auto back = take(canFrame(0x0F0, {0xA0, 0x0F, 0x30, 0x11, 1}));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->twist.speed, -10.5, 1e-9);
  // Backward, and the right wheel is the faster one: it turns to the right.
  EXPECT_NEAR(back->twist.yaw_rate, -1.0 / 1.6, 1e-9);
}

TEST_F(CanMotionTest, TheSpeedOfWheelsInTwoMessagesIsThatOfTheLastOne) {
  options_ = CanOptions();
  options_.front_left = "0x0F0 0|8@1+ (1,0) [0|0] \"km/h\"";
  options_.rear_right = "0x0F1 0|8@1+ (1,0) [0|0] \"km/h\"";
  options_.yaw_from = CanYaw::kNone;
  EXPECT_FALSE(take(canFrame(0x0F0, {36})));
  const auto motion = take(canFrame(0x0F1, {72}));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->twist.speed, 15.0, 1e-9);
  EXPECT_TRUE(std::isnan(motion->twist.yaw_rate));
}

TEST_F(CanMotionTest, TheSteeringGivesTheYawRateOfABicycle) {
  options_.steering = "0x1D0 7|16@0- (0.1,0) [-720|720] \"deg\"";
  options_.yaw_from = CanYaw::kSteering;
  options_.wheelbase = 2.5;
  options_.steering_ratio = 16.0;
  takeBoth(1.0, 0.0);
  take(canFrame(0x1D0, {0x03, 0x20}));  // 80 deg: 5 deg of the road wheels
  const auto motion = take(speedFrame(10.0, counter_++));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->twist.yaw_rate, 10.0 * std::tan(5.0 * kDegree) / 2.5, 1e-9);
}

TEST_F(CanMotionTest, SteeringAndAccelerationComeWithTheMotion) {
  options_.steering = "0x1D0 7|16@0- (0.1,0) [-720|720] \"deg\"";
  options_.acceleration = "0x1E0 0|8@1- (0.01,0) [-1|1] \"g\"";
  options_.steering_ratio = 16.0;
  takeBoth(1.0, 0.0);  // the first counter gives no motion
  const auto without = takeBoth(1.0, 0.0);
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->twist.steering);
  EXPECT_FALSE(without->twist.acceleration);
  take(canFrame(0x1D0, {0x03, 0x20}));  // 80 deg: 5 deg of the road wheels
  take(canFrame(0x1E0, {0xCE}));        // -50
  const auto motion = take(speedFrame(10.0, counter_++));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->twist.steering.value().value, 5.0 * kDegree, 1e-9);
  EXPECT_NEAR(motion->twist.acceleration.value().value, -0.5 * 9.80665, 1e-9);
}

TEST_F(CanMotionTest, AnAccelerationIsPassedOnOnceWithItsOwnStamp) {
  options_.acceleration = "0x1E0 0|8@1- (0.01,0) [-1|1] \"g\"";
  takeBoth(1.0, 0.0);
  take(canFrame(0x1E0, {0xCE}));
  now_ += 0.1;
  const auto motion = takeBoth(1.0, 0.0);
  ASSERT_TRUE(motion && motion->twist.acceleration);
  EXPECT_EQ(motion->twist.acceleration->stamp, Stamp::fromSeconds(1000.0));
  for (int i = 0; i < 3; ++i) {  // its message has stopped
    now_ += 0.1;
    EXPECT_FALSE(takeBoth(1.0, 0.0)->twist.acceleration);
  }
  take(canFrame(0x1E0, {0xCE}));
  EXPECT_TRUE(takeBoth(1.0, 0.0)->twist.acceleration) << "the same value, but a new message";
  take(canFrame(0x1E0, {0xCE}));
  take(canFrame(0x1E0, {0x7F}));  // 1.27 g: not valid
  EXPECT_FALSE(takeBoth(1.0, 0.0)->twist.acceleration);
}

TEST_F(CanMotionTest, ASteeringThatGivesTheYawRateTellsNothingMore) {
  options_.steering = "0x1D0 7|16@0- (0.1,0) [-720|720] \"deg\"";
  options_.yaw_from = CanYaw::kSteering;
  takeBoth(1.0, 0.0);
  take(canFrame(0x1D0, {0x03, 0x20}));
  const auto motion = take(speedFrame(10.0, counter_++));
  ASSERT_TRUE(motion);
  EXPECT_FALSE(motion->twist.steering);
}

TEST_F(CanMotionTest, OptionsThatDoNotFitAreRefusedByName) {
  EXPECT_EQ(refusal(), "none");
  options_.yaw_rate.clear();
  EXPECT_NE(refusal().find("can/yaw_rate is empty"), std::string::npos) << refusal();
  options_ = canSample();
  options_.speed.clear();
  EXPECT_NE(refusal().find("can/speed is empty"), std::string::npos) << refusal();
  options_ = canSample();
  options_.speed = "Speed";
  EXPECT_NE(refusal().find("can/dbc"), std::string::npos) << refusal();
  options_.speed = "8|16@1+ (0.01,0) [0|250] \"km/h\"";
  EXPECT_NE(refusal().find("the message's id first"), std::string::npos) << refusal();
  options_.speed = "0x1A0 8|16@1+ (0.01,0) [0|250] \"knots\"";
  EXPECT_NE(refusal().find("is in 'knots': expected one of km/h, kph, m/s, mph"), std::string::npos)
      << refusal();
  options_ = canSample();
  options_.yaw_from = CanYaw::kWheels;
  EXPECT_NE(refusal().find("can/rear_left is empty"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace datmo::can_motion_test
