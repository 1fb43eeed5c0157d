// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>

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

TEST(Standing, AStationaryObjectHasNoVelocityAndStaysInTheMode) {
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

TEST(Standing, SlowWalkingIsNotMistakenForIt) {
  const auto path = [](double t) { return Point2(0.6 * t, 0.0); };
  constexpr int kRuns = 20;
  double standing = 0.0;
  double speed = 0.0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    const ImmFilter filter = follow(path, 10.0, ImmOptions(), seed);
    standing += filter.modeProbabilities()[kStanding] / kRuns;
    speed += filter.estimate().mean[2] / kRuns;
  }
  EXPECT_LT(standing, 0.2);
  EXPECT_NEAR(speed, 0.6, 0.1);
}

TEST(Standing, DisabledItHasNoProbability) {
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

TEST(Standing, AMeasuredVelocityDistinguishesAWalkerFromAStationaryObject) {
  const ImmOptions options;
  for (const double speed : {0.0, 1.4}) {
    ImmFilter filter(startAt(Point2::Zero()), priorModeProbabilities(options));
    const MeasuredVelocity measured{{speed, 0.0}, 0.04 * Eigen::Matrix2d::Identity()};
    const double expected = filter.logLikelihood(measured);
    EXPECT_EQ(filter.update(measured, options.outlier_probability), expected);
    filter.predict(immStep(options, kPeriod));
    filter.update(measured, options.outlier_probability);
    EXPECT_NEAR(filter.estimate().mean[2], speed, 0.2);
    EXPECT_EQ(filter.modeProbabilities()[kStanding] > 0.5, speed == 0.0);
  }
}

TEST(Standing, AnUncertainMeasuredStandstillIsLessInformative) {
  const ImmOptions options;
  ImmFilter before(startAt(Point2::Zero()), priorModeProbabilities(options));
  before.predict(immStep(options, kPeriod));
  double standing = 1.0;
  for (const double sigma : {0.1, 0.3, 0.6, 1.0, 2.0, 5.0, 100.0}) {
    ImmFilter filter = before;
    filter.update(MeasuredVelocity{{0.0, 0.0}, sigma * sigma * Eigen::Matrix2d::Identity()},
                  options.outlier_probability);
    EXPECT_LT(filter.modeProbabilities()[kStanding], standing) << sigma;
    standing = filter.modeProbabilities()[kStanding];
    EXPECT_GT(standing, before.modeProbabilities()[kStanding]) << sigma;
  }
  EXPECT_NEAR(standing, before.modeProbabilities()[kStanding], 5e-3) << "it tells nothing";
}

TEST(Standing, TheShareThatStopsDependsOnTheVelocity) {
  const ImmOptions options;
  const ImmStep step = immStep(options, kPeriod);
  const ModeVector prior = priorModeProbabilities(options);
  const auto standingAt = [&](double speed, double sigma) {
    StateEstimate start = startAt(Point2::Zero());
    start.mean[2] = speed;
    start.covariance.block<2, 2>(2, 2) = sigma * sigma * Eigen::Matrix2d::Identity();
    ImmFilter filter(start, prior);
    filter.predict(step);
    return filter.modeProbabilities()[kStanding];
  };
  const double stays = prior[kStanding] * step.transition(kStanding, kStanding);
  const double stops = prior.dot(step.transition.col(kStanding)) - stays;
  // All modes have one velocity: the mean of exp(-v^2 / (2 s^2)) over it, in both components.
  const double s = step.stop_variance;
  const double slow = s / (s + 0.04);
  EXPECT_NEAR(standingAt(0.0, 0.2), stays + stops * slow, 1e-12);
  EXPECT_NEAR(standingAt(3.0, 0.2), stays + stops * slow * std::exp(-4.5 / (s + 0.04)), 1e-12);
  EXPECT_NEAR(standingAt(3.0, 2.0), stays + stops * s / (s + 4.0) * std::exp(-4.5 / (s + 4.0)),
              1e-12);
}

TEST(Standing, AFastObjectIsNotStationaryInTheNextScan) {
  ImmFilter filter = follow([](double t) { return Point2(8.0 * t, 1.2 * t); }, 3.0);
  // For a parked car to the side: the speed along the line of sight is uncertain, that across it is
  // not.
  const Eigen::Vector2d variance(13.7, 0.09);
  const MeasuredVelocity of_another{{1.7, 0.0}, variance.asDiagonal()};
  filter.predict(immStep(ImmOptions(), kPeriod));
  filter.update(of_another, ImmOptions().outlier_probability);
  EXPECT_LT(filter.modeProbabilities()[kStanding], 0.1);
  EXPECT_GT(filter.estimate().mean[2], 6.0);
}

TEST(Standing, AnObjectThatBrakesToAStopIsStationary) {
  constexpr double kDeceleration = 4.0;  // m/s^2
  constexpr double kStopTime = 2.0;      // s
  const auto braking = [=](double t) {
    const double braked = std::min(t, kStopTime);
    return Point2(kDeceleration * (kStopTime - 0.5 * braked) * braked, 0.0);
  };
  EXPECT_LT(follow(braking, 1.5).modeProbabilities()[kStanding], 0.1);
  EXPECT_GT(follow(braking, kStopTime + 1.0).modeProbabilities()[kStanding], 0.5);
}

}  // namespace
}  // namespace datmo::imm_standing_test
