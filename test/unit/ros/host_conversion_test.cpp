// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/host_conversion.h"

#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::host_conversion_test {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const SteeringFormat kWheels{"steer", 0.01, 0.6};
const AccelerationFormat kAlong{"base_link", 0.3, 12.0};

sensor_msgs::JointState joints() {
  sensor_msgs::JointState message;
  message.name = {"rear_left_wheel", "front_left_steer", "front_right_steer"};
  message.position = {250.0, 0.22, 0.18};
  return message;
}

geometry_msgs::AccelWithCovarianceStamped acceleration(double along, double variance) {
  geometry_msgs::AccelWithCovarianceStamped message;
  message.header.frame_id = "base_link";
  message.accel.accel.linear.x = along;
  message.accel.covariance[0] = variance;
  return message;
}

/// The reason for which a conversion rejects its message; empty: it does not.
std::string reasonOf(const std::function<void()>& convert) {
  try {
    convert();
  } catch (const InputError& error) {
    return error.reason();
  }
  return "";
}

std::string reasonOf(const sensor_msgs::JointState& message, const SteeringFormat& format) {
  return reasonOf([&] { steeringFrom(message, format); });
}

std::string reasonOf(const geometry_msgs::AccelWithCovarianceStamped& message) {
  return reasonOf([&] { accelerationFrom(message, kAlong); });
}

TEST(Steering, IsTheMeanOfTheFrontWheels) {
  const Estimate angle = steeringFrom(joints(), kWheels);
  EXPECT_NEAR(angle.value, 0.2, 1e-12);
  EXPECT_NEAR(angle.variance, 1e-4, 1e-12);
}

TEST(Steering, ABicycleNeedsNoNames) {
  sensor_msgs::JointState message;
  message.position = {-0.1};
  EXPECT_NEAR(steeringFrom(message, {"", 0.01, 0.6}).value, -0.1, 1e-12);
}

TEST(Steering, OtherJointsAloneAreRejected) {
  sensor_msgs::JointState message = joints();
  message.position.resize(1);  // that of a wheel that turns
  EXPECT_EQ(reasonOf(message, kWheels), "no_steering");
  EXPECT_EQ(reasonOf(sensor_msgs::JointState(), {"", 0.01, 0.6}), "no_steering");
}

// A steering wheel, degrees, or nothing.
TEST(Steering, WhatNoFrontWheelReachesIsRejected) {
  for (const double angle : {3.2, -12.0, kNan, 1e300}) {
    sensor_msgs::JointState message = joints();
    message.position[1] = angle;
    EXPECT_EQ(reasonOf(message, kWheels), "bad_steering") << angle;
  }
  sensor_msgs::JointState lock = joints();
  lock.position = {250.0, 0.62, 0.62};  // at full lock, with noise
  EXPECT_EQ(reasonOf(lock, kWheels), "");
}

// An Ackermann steering at full lock.
TEST(Steering, TheInnerWheelMayTurnFartherThanTheBicycle) {
  sensor_msgs::JointState message = joints();
  message.position = {250.0, 0.65, 0.49};
  EXPECT_NEAR(steeringFrom(message, kWheels).value, 0.57, 1e-12);
  message.position = {250.0, 0.75, 0.6};
  EXPECT_EQ(reasonOf(message, kWheels), "bad_steering");
}

TEST(Acceleration, HasTheVarianceOfItsMessage) {
  const Estimate along = accelerationFrom(acceleration(-6.0, 0.04), kAlong).value();
  EXPECT_EQ(along.value, -6.0);
  EXPECT_EQ(along.variance, 0.04);
  EXPECT_NEAR(accelerationFrom(acceleration(-6.0, 0.0), kAlong)->variance, 0.09, 1e-12);
}

// As drivers write for what they do not measure.
TEST(Acceleration, ALargeVarianceMeansNotMeasured) {
  for (const double variance : {1e6, 1e300}) {
    EXPECT_FALSE(accelerationFrom(acceleration(0.0, variance), kAlong)) << variance;
    EXPECT_EQ(reasonOf(acceleration(1000.0, variance)), "bad_acceleration") << variance;
  }
  EXPECT_TRUE(accelerationFrom(acceleration(0.0, 143.0), kAlong));
}

TEST(Acceleration, AnotherFrameIsRejected) {
  geometry_msgs::AccelWithCovarianceStamped message = acceleration(1.0, 0.04);
  message.header.frame_id = "imu";
  EXPECT_EQ(reasonOf(message), "wrong_frame");
  message.header.frame_id.clear();
  EXPECT_EQ(reasonOf(message), "") << "the vehicle's";
}

TEST(Acceleration, BadNumbersAreRejected) {
  EXPECT_EQ(reasonOf(acceleration(kNan, 0.04)), "bad_acceleration");
  EXPECT_EQ(reasonOf(acceleration(40.0, 0.04)), "bad_acceleration");
  EXPECT_EQ(reasonOf(acceleration(1.0, -1.0)), "bad_acceleration");
  EXPECT_EQ(reasonOf(acceleration(1.0, kNan)), "bad_acceleration");
  EXPECT_EQ(reasonOf(acceleration(1.0, std::numeric_limits<double>::infinity())),
            "bad_acceleration");
}

TEST(HostConversion, WhatADriverSendsIsRead) {
  const Stamp stamp = Stamp::fromSeconds(1000.0);
  const auto steering = toSteering(0.1, stamp);
  EXPECT_EQ(steering->header.stamp, ros::Time(1000.0));
  EXPECT_EQ(steeringFrom(*steering, {"", 0.01, 0.6}).value, 0.1);
  const Estimate along = accelerationFrom(*toAcceleration({-2.0, 0.5}, stamp), kAlong).value();
  EXPECT_EQ(along.value, -2.0);
  EXPECT_EQ(along.variance, 0.5);
}

}  // namespace
}  // namespace datmo::host_conversion_test
