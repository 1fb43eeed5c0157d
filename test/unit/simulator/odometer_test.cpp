// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/odometer.h"

#include <cmath>

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::odometer_test {
namespace {

OdometerOptions idealOdometer() {
  OdometerOptions options;
  options.speed_scale_error = 0.0;
  options.speed_noise = 0.0;
  options.yaw_rate_bias = 0.0;
  options.yaw_rate_noise = 0.0;
  return options;
}

Odometry drive(const World& world, const OdometerOptions& options, double seconds) {
  Odometer odometer(options, RandomStream(1, "odometer"));
  Odometry last;
  for (int i = 0; i <= std::lround(seconds * options.rate); ++i) {
    last = odometer.measure(world.at(i / options.rate));
  }
  return last;
}

TEST(Odometer, WithoutErrorsFollowsTheTruth) {
  const Mover ego{objectKind("car"), Path({{0.0, 0.0}, {30.0, 0.0}, {30.0, 50.0}}, 10.0),
                  SpeedProfile({{0.0, 8.0}}), 0.0};
  const World world(RoadNetwork(), ego);
  const Odometry odometry = drive(world, idealOdometer(), 6.0);
  const Pose2 truth = world.at(6.0).base;
  EXPECT_NEAR((odometry.pose.pose.position() - truth.position()).norm(), 0.0, 0.01);
  EXPECT_NEAR(odometry.pose.pose.heading(), truth.heading(), 1e-9);
}

TEST(Odometer, ScaleErrorMakesTheDistanceLonger) {
  OdometerOptions options = idealOdometer();
  options.speed_scale_error = 0.03;
  const World world(RoadNetwork(), egoAlongX(10.0));
  EXPECT_NEAR(drive(world, options, 10.0).pose.pose.x(), 103.0, 1e-6);
}

TEST(Odometer, BiasTurnsThePath) {
  OdometerOptions options = idealOdometer();
  options.yaw_rate_bias = 0.5;
  const World world(RoadNetwork(), egoAlongX(10.0));
  EXPECT_NEAR(drive(world, options, 10.0).pose.pose.heading(), degrees(5.0), 1e-9);
}

TEST(Odometer, NoiseHasTheVarianceThatItStates) {
  OdometerOptions options = idealOdometer();
  options.speed_noise = 0.2;
  options.yaw_rate_noise = 1.0;
  const World world(RoadNetwork(), egoAlongX(10.0));
  Odometer odometer(options, RandomStream(1, "odometer"));
  double speed_square_sum = 0.0;
  double yaw_square_sum = 0.0;
  constexpr int kMeasurements = 20000;
  Odometry odometry;
  for (int i = 0; i < kMeasurements; ++i) {
    odometry = odometer.measure(world.at(i / options.rate));
    speed_square_sum += std::pow(odometry.twist.forward_speed - 10.0, 2);
    yaw_square_sum += std::pow(odometry.twist.yaw_rate, 2);
  }
  EXPECT_NEAR(speed_square_sum / kMeasurements / odometry.speed_variance, 1.0, 0.05);
  EXPECT_NEAR(yaw_square_sum / kMeasurements / odometry.yaw_rate_variance, 1.0, 0.05);
}

TEST(Odometer, UncertaintyOfThePoseGrows) {
  const World world(RoadNetwork(), egoAlongX(10.0));
  const Odometry early = drive(world, OdometerOptions(), 1.0);
  const Odometry late = drive(world, OdometerOptions(), 5.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(early.pose.covariance(i, i), 0.0);
    EXPECT_GT(late.pose.covariance(i, i), early.pose.covariance(i, i));
  }
}

}  // namespace
}  // namespace datmo::simulator::odometer_test
