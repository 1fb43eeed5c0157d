// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/motion_stage.h"

#include <cmath>
#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::motion_stage_test {
namespace {

using samples::drops;

sensor_msgs::Imu imu(double seconds, double yaw_rate, const std::string& frame = "base_link") {
  sensor_msgs::Imu message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = frame;
  message.angular_velocity.z = yaw_rate;
  return message;
}

geometry_msgs::TwistStamped twist(double seconds, double speed, double yaw_rate = 0.0) {
  geometry_msgs::TwistStamped message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = "base_link";
  message.twist.linear.x = speed;
  message.twist.angular.z = yaw_rate;
  return message;
}

sensor_msgs::JointState wheels(double seconds, const std::vector<double>& rates) {
  sensor_msgs::JointState message;
  message.header.stamp = ros::Time(seconds);
  message.velocity = rates;
  return message;
}

class MotionStageTest : public testing::Test {
 protected:
  MotionStage stageOf(MotionSource source) {
    MotionStageOptions options;
    options.motion.source = source;
    options.motion.wheel_radius = 0.25;
    return {options, buffer_, monitor_};
  }

  static SharedOptions upsideDown() {
    SharedOptions shared;
    shared.mounts["imu_link"].roll = kPi;
    return shared;
  }

  StageMonitor monitor_{"motion"};
  TransformBuffer buffer_{1.0, upsideDown(), monitor_};
};

TEST_F(MotionStageTest, ATwistBecomesOdometryThatCountsTheDistance) {
  MotionStage stage = stageOf(MotionSource::kTwist);
  ASSERT_TRUE(stage.handleTwist(twist(100.0, 2.0)));
  const auto odometry = stage.handleTwist(twist(100.5, 4.0, 0.1));
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->header.stamp, ros::Time(100.5));
  EXPECT_EQ(odometry->header.frame_id, "odom");
  EXPECT_EQ(odometry->child_frame_id, "base_link");
  EXPECT_EQ(odometry->twist.twist.linear.x, 4.0);
  EXPECT_EQ(odometry->twist.twist.angular.z, 0.1);
  EXPECT_NEAR(odometry->pose.pose.position.x, 1.0, 1e-9) << "half a second at 2 m/s";
  geometry_msgs::TwistWithCovarianceStamped with_covariance;
  with_covariance.header.stamp = ros::Time(100.6);
  with_covariance.twist.twist.linear.x = 3.0;
  EXPECT_EQ(stage.handleTwist(with_covariance)->twist.twist.linear.x, 3.0) << "without frame_id";
}

TEST_F(MotionStageTest, YawRateOfTheImuAndSpeedOfTheTwist) {
  MotionStage stage = stageOf(MotionSource::kImuAndTwist);
  EXPECT_FALSE(stage.handleImu(imu(100.0, 0.2)));
  EXPECT_EQ(drops(monitor_, "no_speed"), 1U);
  EXPECT_FALSE(stage.handleTwist(twist(100.01, 5.0, 9.0))) << "the Imu sets the pace";
  const auto odometry = stage.handleImu(imu(100.02, 0.2));
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->twist.twist.linear.x, 5.0);
  EXPECT_EQ(odometry->twist.twist.angular.z, 0.2);
  EXPECT_EQ(odometry->twist.covariance[0], 0.0);
  EXPECT_FALSE(stage.handleImu(imu(101.0, 0.2))) << "the speed is older than hold";
  EXPECT_EQ(drops(monitor_, "no_speed"), 2U);
}

TEST_F(MotionStageTest, WheelsGiveTheSpeedByTheirRadius) {
  MotionStage stage = stageOf(MotionSource::kImuAndWheels);
  EXPECT_FALSE(stage.handleWheels(wheels(100.0, {10.0, 12.0})));
  EXPECT_NEAR(stage.handleImu(imu(100.01, 0.0))->twist.twist.linear.x, 0.25 * 11.0, 1e-12);
  EXPECT_FALSE(stage.handleWheels(wheels(100.1, {})));
  EXPECT_EQ(drops(monitor_, "no_wheel_speed"), 1U);
}

TEST_F(MotionStageTest, WithAnImuAloneTheSpeedIsUnknown) {
  MotionStage stage = stageOf(MotionSource::kImu);
  const auto odometry = stage.handleImu(imu(100.0, 0.3));
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->twist.twist.angular.z, 0.3);
  EXPECT_EQ(odometry->twist.twist.linear.x, 0.0);
  EXPECT_GT(odometry->twist.covariance[0], 1e4);
}

TEST_F(MotionStageTest, TheImuIsRotatedByItsMount) {
  MotionStage stage = stageOf(MotionSource::kImu);
  EXPECT_NEAR(stage.handleImu(imu(100.0, 0.3, "imu_link"))->twist.twist.angular.z, -0.3, 1e-9)
      << "it hangs upside down";
  EXPECT_FALSE(stage.handleImu(imu(100.1, 0.3, "somewhere")));
  EXPECT_EQ(drops(monitor_, "missing_transform"), 1U);
  EXPECT_FALSE(stage.handleImu(imu(100.2, 0.3, "odom")));
  EXPECT_EQ(drops(monitor_, "wrong_frame"), 1U);
}

TEST_F(MotionStageTest, BadMotionIsRefused) {
  MotionStage stage = stageOf(MotionSource::kImu);
  EXPECT_FALSE(stage.handleImu(imu(100.0, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE(stage.handleImu(imu(100.1, 1000.0)));
  EXPECT_EQ(drops(monitor_, "bad_motion"), 2U);
  sensor_msgs::Imu without = imu(100.2, 0.1);
  without.angular_velocity_covariance[0] = -1.0;
  EXPECT_FALSE(stage.handleImu(without));
  EXPECT_EQ(drops(monitor_, "no_angular_velocity"), 1U);
  EXPECT_TRUE(stage.handleImu(imu(100.0, 0.1))) << "what was refused has not moved the time";
  EXPECT_FALSE(stage.handleImu(imu(100.0, 0.1)));
  EXPECT_EQ(drops(monitor_, "repeated_stamp"), 1U);
}

TEST_F(MotionStageTest, AJumpBackStartsOver) {
  MotionStage stage = stageOf(MotionSource::kTwist);
  stage.handleTwist(twist(200.0, 10.0));
  stage.handleTwist(twist(200.5, 10.0));
  EXPECT_EQ(stage.handleTwist(twist(100.0, 10.0))->pose.pose.position.x, 0.0);
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_NEAR(stage.handleTwist(twist(100.1, 10.0))->pose.pose.position.x, 1.0, 1e-9);
}

}  // namespace
}  // namespace datmo::motion_stage_test
