// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/target_motion.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace datmo::target_motion_test {
namespace {

TrackState state(double x, double y, double vx, double vy, double ax, double ay) {
  TrackState result;
  result << x, y, vx, vy, ax, ay;
  return result;
}

TEST(TargetMotion, ConstantVelocityMovesAlongTheVelocityAndForgetsTheAcceleration) {
  TargetMotionOptions options;
  options.acceleration_fading = 2.0;
  const LinearMotion motion = coordinatedTurn(0.0, options, 2.0);
  const TrackState next = motion.transition * state(1, 2, 3, -4, 5, 6);
  const double kept = std::exp(-1.0);
  EXPECT_TRUE(next.isApprox(state(7, -6, 3, -4, 5 * kept, 6 * kept), 1e-12)) << next;
}

TEST(TargetMotion, ConstantVelocityNoiseIsThatOfWhiteAcceleration) {
  TargetMotionOptions options;
  options.acceleration_density = 3.0;
  const LinearMotion motion = coordinatedTurn(0.0, options, 2.0);
  EXPECT_NEAR(motion.noise(0, 0), 3.0 * 8.0 / 3.0, 1e-9);
  EXPECT_NEAR(motion.noise(0, 2), 3.0 * 4.0 / 2.0, 1e-9);
  EXPECT_NEAR(motion.noise(2, 2), 3.0 * 2.0, 1e-9);
  EXPECT_NEAR(motion.noise(0, 3), 0.0, 1e-12);
}

TEST(TargetMotion, ConstantAccelerationIsTheParabola) {
  const LinearMotion motion = constantAcceleration(TargetMotionOptions(), 2.0);
  const TrackState next = motion.transition * state(0, 0, 1, 2, 3, -4);
  EXPECT_TRUE(next.isApprox(state(8, -4, 7, -6, 3, -4), 1e-12)) << next;
}

TEST(TargetMotion, ConstantAccelerationNoiseIsThatOfWhiteJerk) {
  TargetMotionOptions options;
  options.jerk_density = 6.0;
  const LinearMotion motion = constantAcceleration(options, 2.0);
  EXPECT_NEAR(motion.noise(1, 1), 6.0 * 32.0 / 20.0, 1e-12);
  EXPECT_NEAR(motion.noise(1, 5), 6.0 * 8.0 / 6.0, 1e-12);
  EXPECT_NEAR(motion.noise(5, 5), 12.0, 1e-12);
}

TEST(TargetMotion, LeftTurnByAQuarterCircle) {
  const double rate = 0.5;
  const double quarter = 0.5 * kPi / rate;
  // Speed 2 m/s on a circle of radius 4 m, from its lowest point; the acceleration points inward.
  const LinearMotion motion = coordinatedTurn(rate, TargetMotionOptions(), quarter);
  const TrackState next = motion.transition * state(0, 0, 2, 0, 0, 1);
  EXPECT_TRUE(next.isApprox(state(4, 4, 0, 2, -1, 0), 1e-9)) << next;
}

TEST(TargetMotion, RightTurnIsTheMirrorImage) {
  const auto motions = targetMotions(TargetMotionOptions(), 0.3);
  TrackCovariance mirror = TrackCovariance::Identity();
  for (const int y : {1, 3, 5}) {
    mirror(y, y) = -1.0;
  }
  const LinearMotion& left = motions[static_cast<int>(MotionMode::kLeftTurn)];
  const LinearMotion& right = motions[static_cast<int>(MotionMode::kRightTurn)];
  EXPECT_TRUE((mirror * left.transition * mirror).isApprox(right.transition, 1e-12));
  EXPECT_TRUE((mirror * left.noise * mirror).isApprox(right.noise, 1e-12));
}

TEST(TargetMotion, TurnNoiseAgreesWithIntegrationInSmallSteps) {
  const TargetMotionOptions options;
  const double rate = 1.5;
  const int steps = 20000;
  const double seconds = 1.0;
  // White acceleration acts on the velocity; its effect in between follows from the linear motion.
  Eigen::Matrix4d flow = Eigen::Matrix4d::Zero();
  flow(0, 2) = flow(1, 3) = 1.0;
  flow(2, 3) = -rate;
  flow(3, 2) = rate;
  const double dt = seconds / steps;
  const Eigen::Matrix4d small =
      Eigen::Matrix4d::Identity() + flow * dt + flow * flow * (dt * dt / 2);
  Eigen::Matrix4d expected = Eigen::Matrix4d::Zero();
  for (int i = 0; i < steps; ++i) {
    expected = small * expected * small.transpose();
    expected.diagonal().tail<2>().array() += options.acceleration_density * dt;
  }
  const LinearMotion motion = coordinatedTurn(rate, options, seconds);
  const Eigen::Matrix4d noise = motion.noise.topLeftCorner<4, 4>();
  EXPECT_TRUE(noise.isApprox(expected, 1e-3)) << noise << "\n\n" << expected;
}

class EveryMotion : public testing::TestWithParam<int> {
 protected:
  LinearMotion motion(double seconds) const {
    return targetMotions(TargetMotionOptions(), seconds)[static_cast<std::size_t>(GetParam())];
  }
};

TEST_P(EveryMotion, TwoStepsEqualOne) {
  const LinearMotion first = motion(0.07);
  const LinearMotion second = motion(0.23);
  const LinearMotion whole = motion(0.30);
  EXPECT_TRUE((second.transition * first.transition).isApprox(whole.transition, 1e-9));
  const TrackCovariance noise =
      second.transition * first.noise * second.transition.transpose() + second.noise;
  EXPECT_TRUE(noise.isApprox(whole.noise, 1e-9)) << noise << "\n\n" << whole.noise;
}

TEST_P(EveryMotion, ZeroTimeChangesNothing) {
  EXPECT_TRUE(motion(0.0).transition.isApprox(TrackCovariance::Identity(), 1e-12));
  EXPECT_TRUE(motion(0.0).noise.isZero(1e-12));
}

TEST_P(EveryMotion, NoiseIsSymmetricAndPositive) {
  for (const double seconds : {1e-4, 0.06, 0.1, 1.0, 10.0}) {
    const TrackCovariance noise = motion(seconds).noise;
    EXPECT_TRUE(noise.isApprox(noise.transpose(), 1e-12));
    const Eigen::SelfAdjointEigenSolver<TrackCovariance> solver(noise);
    EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-9 * noise.norm()) << seconds;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, EveryMotion, testing::Range(0, kMotionModes));

}  // namespace
}  // namespace datmo::target_motion_test
