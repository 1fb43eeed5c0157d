// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "followed_path.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/imm_filter.h"

namespace datmo::imm_standing_test {
namespace {

using samples::follow;
using samples::kPeriod;
using samples::startAt;

constexpr int kStanding = static_cast<int>(MotionMode::kStanding);

double speedOf(const ImmFilter& filter) { return filter.estimate().mean.segment<2>(2).norm(); }

double velocityStd(const ImmFilter& filter) {
  return std::sqrt(filter.estimate().covariance.diagonal().segment<2>(2).maxCoeff());
}

ImmOptions withoutStanding() {
  ImmOptions options;
  options.transitions.standing = false;
  return options;
}

TEST(Standing, AnObjectThatStandsHasNoVelocityAndStaysInTheMode) {
  const auto point = [](double) { return Point2(3.0, 4.0); };
  for (const double seconds : {3.0, 10.0, 60.0}) {
    const ImmFilter filter = follow(point, seconds);
    EXPECT_GT(filter.modeProbabilities()[kStanding], 0.9) << seconds;
    EXPECT_LT(speedOf(filter), 0.1) << seconds;
    EXPECT_LT(velocityStd(filter), 0.15) << seconds;
    EXPECT_LT((filter.estimate().mean.head<2>() - point(0.0)).norm(), 0.05) << seconds;
  }
  EXPECT_GT(velocityStd(follow(point, 10.0, withoutStanding())), 0.2);
}

TEST(Standing, TheEstimateFollowsWithinASecondOfTheStart) {
  const double start = 10.0;
  for (const double speed : {0.8, 1.5, 3.0}) {
    const auto path = [&](double t) { return Point2(1.0, speed * std::max(0.0, t - start)); };
    const ImmFilter filter = follow(path, start + 1.05);
    EXPECT_NEAR(filter.estimate().mean[3], speed, 0.25 * speed);
    EXPECT_LT(filter.modeProbabilities()[kStanding], 0.05) << speed;
    EXPECT_LT((filter.estimate().mean.head<2>() - path(start + 1.0)).norm(), 0.15);
  }
}

TEST(Standing, ACarThatPullsAwayIsFollowed) {
  const double start = 10.0;
  const auto path = [&](double t) {
    const double driven = std::max(0.0, t - start);
    return Point2(driven * driven, 0.0);
  };
  EXPECT_NEAR(follow(path, start + 1.05).estimate().mean[2], 2.0, 0.7);
  EXPECT_NEAR(follow(path, start + 2.05).estimate().mean[2], 4.0, 0.5);
}

TEST(Standing, ComingToRestEndsInTheMode) {
  const auto path = [](double t) {
    const double braking = std::min(t, 4.0);
    return Point2(8.0 * braking - braking * braking, 0.0);
  };
  const ImmFilter filter = follow(path, 6.0);
  EXPECT_GT(filter.modeProbabilities()[kStanding], 0.8);
  EXPECT_LT(speedOf(filter), 0.1);
}

TEST(Standing, SlowWalkingIsNotTakenForIt) {
  const ImmFilter filter = follow([](double t) { return Point2(0.6 * t, 0.0); }, 10.0);
  EXPECT_LT(filter.modeProbabilities()[kStanding], 0.2);
  EXPECT_NEAR(filter.estimate().mean[2], 0.6, 0.2);
}

TEST(Standing, SwitchedOffItHasNoProbability) {
  const ImmOptions options = withoutStanding();
  ImmFilter filter(startAt(Point2::Zero()), priorModeProbabilities(options));
  for (int i = 0; i < 50; ++i) {
    filter.predict(immStep(options, kPeriod));
    EXPECT_EQ(filter.modeProbabilities()[kStanding], 0.0);
    filter.update(PositionMeasurement{Point2::Zero(), Eigen::Matrix2d::Identity() * 0.01},
                  options.outlier_probability);
    EXPECT_EQ(filter.modeProbabilities()[kStanding], 0.0);
    EXPECT_NEAR(filter.modeProbabilities().sum(), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace datmo::imm_standing_test
