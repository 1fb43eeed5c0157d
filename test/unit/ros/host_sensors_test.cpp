// SPDX-License-Identifier: BSD-3-Clause
// The risk stage with measured steering and acceleration of the host.
#include <cmath>
#include <limits>
#include <utility>

#include "labeled_scan_samples.h"
#include "monitor_counts.h"
#include "risk_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/risk_stage.h"

namespace datmo::host_sensors_test {
namespace {

/// A drive straight ahead at 5 m/s according to the odometry, without any track.
class HostSensorsTest : public testing::Test {
 protected:
  void steeringAt(double seconds, double angle) {
    sensor_msgs::JointState message;
    message.header.stamp = ros::Time(samples::kStart + seconds);
    message.position = {angle};
    stage_.handleSteering(message);
  }

  void accelerationAt(double seconds, double along, double variance = 0.01) {
    geometry_msgs::AccelWithCovarianceStamped message;
    message.header.stamp = ros::Time(samples::kStart + seconds);
    message.header.frame_id = "base_link";
    message.accel.accel.linear.x = along;
    message.accel.covariance[0] = variance;
    stage_.handleAcceleration(message);
  }

  /// The host's expected path: from the center of its outline now to that 4 s later.
  std::vector<geometry_msgs::Pose2D> pathAt(double seconds) {
    stage_.handleOdometry(samples::odometry(samples::kStart + seconds, samples::kHostSpeed));
    stage_.handleLabeledScan(toMessage(samples::scanBetweenWalls(seconds), "base_link", "map"));
    TrackArray none = samples::standingCar(seconds, 50.0);
    none.tracks.clear();
    const RiskArrayPtr risks = stage_.handleTracks(none);
    EXPECT_NE(risks, nullptr);
    return risks->host_path;
  }

  static double lengthOf(const std::vector<geometry_msgs::Pose2D>& path) {
    return std::hypot(path.back().x - path.front().x, path.back().y - path.front().y);
  }

  StageMonitor monitor_{"risk"};
  RiskStage stage_{RiskStageOptions(), monitor_};
};

TEST_F(HostSensorsTest, AHostThatBrakesStopsSooner) {
  EXPECT_NEAR(lengthOf(pathAt(0.0)), 20.0, 0.01);
  accelerationAt(0.1, -6.0);
  // 5^2 / (2 6) m, although the odometry shows no braking yet; the last step of the model stops.
  EXPECT_NEAR(lengthOf(pathAt(0.1)), 2.08, 0.1);
}

TEST_F(HostSensorsTest, AnAccelerationOfALargeVarianceIsNotUsed) {
  accelerationAt(0.0, -6.0);
  for (const auto& [seconds, variance] : {std::make_pair(0.1, 1e6), std::make_pair(0.2, 1e300)}) {
    accelerationAt(seconds, -6.0, variance);
    EXPECT_NEAR(lengthOf(pathAt(seconds)), 20.0, 0.01) << variance;
  }
  EXPECT_EQ(samples::warnings(monitor_, "unknown_acceleration"), 2U);
}

// Without odometry, a yaw rate from poses is as certain as these.
TEST_F(HostSensorsTest, SteeringIsWeighedAgainstTheNoiseOfThePoses) {
  const auto turnWith = [this](double sigma, double start) {
    for (const double seconds : {start, start + 0.1}) {
      LabeledScan scan = samples::scanBetweenWalls(seconds);
      scan.base_in_map.covariance = 1e-4 * Eigen::Matrix3d::Identity();
      scan.base_in_map.covariance(2, 2) = sigma * sigma;
      stage_.handleLabeledScan(toMessage(scan, "base_link", "map"));
    }
    steeringAt(start + 0.1, 0.2);
    TrackArray none = samples::standingCar(start + 0.1, 50.0);
    none.tracks.clear();
    const auto path = stage_.handleTracks(none)->host_path;
    return path[5].theta - path[0].theta;
  };
  // Differences of headings over 0.1 s: 14 and 0.014 rad/s; the angle itself 0.01 rad.
  EXPECT_NEAR(turnWith(1.0, 0.0), 5.0 * std::tan(0.2) / 2.7, 0.01);
  EXPECT_NEAR(turnWith(1e-4, 0.2), 0.0, 0.01);
}

TEST_F(HostSensorsTest, ASteeringAngleTurnsThePathAtOnce) {
  constexpr double kAngle = 0.2;
  steeringAt(0.0, kAngle);
  const auto path = pathAt(0.0);
  // Yaw rate 0 +- 0.02 rad/s at 5 m/s and a wheelbase of 2.7 m: 0.0108 rad; the angle itself 0.01.
  const double weight = 0.0108 * 0.0108 / (0.0108 * 0.0108 + 0.01 * 0.01);
  const double yaw_rate = 5.0 * std::tan(weight * kAngle) / 2.7;
  EXPECT_NEAR(path[5].theta - path[0].theta, yaw_rate, 1e-3) << "in 1 s";
  EXPECT_GT(path[5].y, 0.2);
}

TEST_F(HostSensorsTest, ASlowHostHasTheSteeringThatIsMeasured) {
  steeringAt(0.0, 0.2);
  stage_.handleOdometry(samples::odometry(samples::kStart, 0.6));
  stage_.handleLabeledScan(toMessage(samples::scanBetweenWalls(0.0), "base_link", "map"));
  TrackArray none = samples::standingCar(0.0, 50.0);
  none.tracks.clear();
  const auto path = stage_.handleTracks(none)->host_path;
  // At 0.6 m/s the yaw rate tells 0.09 rad: hardly anything.
  EXPECT_NEAR(path.back().theta, 4.0 * 0.6 * std::tan(0.2) / 2.7, 0.01);
}

TEST_F(HostSensorsTest, StaleInputsFallBackToOdometryAndAreReported) {
  steeringAt(0.0, 0.2);
  accelerationAt(0.0, -6.0);
  EXPECT_LT(lengthOf(pathAt(0.4)), 3.0);
  EXPECT_EQ(monitor_.warningCount(), 0U);
  const auto path = pathAt(0.6);
  EXPECT_NEAR(lengthOf(path), 20.0, 0.01);
  EXPECT_NEAR(path.back().theta, 0.0, 1e-9);
  EXPECT_EQ(samples::warnings(monitor_, "old_steering"), 1U);
  EXPECT_EQ(samples::warnings(monitor_, "old_acceleration"), 1U);
}

TEST_F(HostSensorsTest, InputsThatNeverCameAreNotMissed) {
  pathAt(0.0);
  EXPECT_EQ(monitor_.warningCount(), 0U);
}

TEST_F(HostSensorsTest, BadMessagesAreCountedAndNotUsed) {
  steeringAt(0.0, 8.0);
  accelerationAt(0.0, std::numeric_limits<double>::quiet_NaN());
  steeringAt(0.02, 0.0);
  steeringAt(0.01, 0.2);
  EXPECT_EQ(samples::drops(monitor_, "bad_steering"), 1U);
  EXPECT_EQ(samples::drops(monitor_, "bad_acceleration"), 1U);
  EXPECT_EQ(samples::drops(monitor_, "old_stamp"), 1U);
  EXPECT_NEAR(lengthOf(pathAt(0.1)), 20.0, 0.01);
}

TEST_F(HostSensorsTest, AClockJumpBackForgetsThem) {
  steeringAt(20.0, 0.2);
  accelerationAt(20.0, -6.0);
  pathAt(20.0);
  EXPECT_NEAR(lengthOf(pathAt(0.0)), 20.0, 0.01);
  EXPECT_EQ(samples::warnings(monitor_, "old_steering"), 0U);
}

}  // namespace
}  // namespace datmo::host_sensors_test
