// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/motion_model.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::motion_model_test {
namespace {

TEST(VelocityMotionModelTest, StandardDeviationsGrowWithTimeAndSpeed) {
  MotionModelOptions options;
  const VelocityMotionModel model(options);
  const Eigen::Matrix3d slow = model.covariance({0.0, 0.0}, 0.1);
  const Eigen::Matrix3d fast = model.covariance({10.0, 0.0}, 0.1);
  EXPECT_NEAR(std::sqrt(slow(0, 0)), 0.1 * 0.1, 1e-12);
  EXPECT_NEAR(std::sqrt(fast(0, 0)), 0.1 * (0.1 + 0.05 * 10.0), 1e-12);
  EXPECT_NEAR(std::sqrt(fast(2, 2)), 0.1 * 0.02, 1e-12);
}

TEST(VelocityMotionModelTest, AgreesWithArcsOfNoisyTwists) {
  MotionModelOptions options;
  options.side_slip_noise = 0.0001;
  const VelocityMotionModel model(options);
  const Twist2 twist{8.0, 0.0};
  const double seconds = 0.5;
  const Eigen::Matrix3d expected = model.covariance(twist, seconds);
  const Pose2 mean = arc(twist, seconds);
  Random random(3);
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const Pose2 pose =
        arc({twist.forward_speed + random.normal(0.5), random.normal(0.02)}, seconds);
    const Eigen::Vector3d error(pose.x() - mean.x(), pose.y() - mean.y(), pose.heading());
    sampled += error * error.transpose() / kSamples;
  }
  EXPECT_NEAR(sampled(0, 0) / expected(0, 0), 1.0, 0.05);
  EXPECT_NEAR(sampled(1, 1) / expected(1, 1), 1.0, 0.05);
  EXPECT_NEAR(sampled(2, 2) / expected(2, 2), 1.0, 0.05);
  EXPECT_NEAR(sampled(1, 2) / expected(1, 2), 1.0, 0.05);
}

TEST(VelocityMotionModelTest, WithoutOdometryTheVelocityIsARandomWalk) {
  const VelocityMotionModel model(MotionModelOptions{});
  EXPECT_TRUE(
      (model.velocityChange(0.2) + model.velocityChange(0.3)).isApprox(model.velocityChange(0.5)));
  EXPECT_NEAR(model.velocityChange(0.25)(0, 0), 3.0 * 3.0 * 0.25, 1e-12);
}

TEST(VelocityMotionModelTest, TheInitialUncertaintyIsAnOption) {
  const auto options = readOptions<MotionModelOptions>(
      {{"initial_speed_sigma", 2.0}, {"initial_yaw_rate_sigma", 0.5}});
  const Eigen::Matrix2d start = VelocityMotionModel(options).initialVelocityCovariance();
  EXPECT_NEAR(start(0, 0), 2.0 * 2.0, 1e-12);
  EXPECT_NEAR(start(1, 1), 0.5 * 0.5, 1e-12);
}

TEST(VelocityMotionModelTest, RefusesBadOptions) {
  MotionModelOptions options;
  options.speed_noise = -1.0;
  EXPECT_THROW(VelocityMotionModel{options}, OptionError);
}

}  // namespace
}  // namespace datmo::motion_model_test
