// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/imm_filter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "followed_path.h"
#include "jump_system.h"
#include <gtest/gtest.h>

namespace datmo::imm_filter_test {
namespace {

using samples::follow;
using samples::kPeriod;
using samples::startAt;

constexpr int kStanding = static_cast<int>(MotionMode::kStanding);

MotionMode likeliest(const ImmFilter& filter) {
  int mode = 0;
  filter.modeProbabilities().maxCoeff(&mode);
  return static_cast<MotionMode>(mode);
}

TEST(ImmStep, RowsSumToOneAndSojournIsKept) {
  ImmOptions options;
  options.transitions.straight_sojourn = 5.0;
  for (const double seconds : {0.0, 0.06, 0.1, 2.0, 1000.0}) {
    const ImmStep step = immStep(options, seconds);
    EXPECT_TRUE(step.transition.rowwise().sum().isOnes(1e-12));
    EXPECT_GE(step.transition.minCoeff(), 0.0);
    EXPECT_NEAR(step.transition(0, 0), std::exp(-seconds / 5.0), 1e-12);
  }
}

TEST(ImmFilter, ChoosesTheModeOfTheMotion) {
  EXPECT_EQ(likeliest(follow([](double t) { return Point2(5.0 * t, -2.0 * t); }, 6.0)),
            MotionMode::kConstantVelocity);
  EXPECT_EQ(likeliest(follow([](double t) { return Point2(2.0 * t + 1.5 * t * t, 0.0); }, 4.0)),
            MotionMode::kConstantAcceleration);
  const double rate = ImmOptions().motion.turn_rate;
  const auto turn = [rate](double sign) {
    return [rate, sign](double t) {
      return Point2(10.0 / rate * std::sin(rate * t),
                    sign * 10.0 / rate * (1.0 - std::cos(rate * t)));
    };
  };
  EXPECT_EQ(likeliest(follow(turn(1.0), 4.0)), MotionMode::kLeftTurn);
  EXPECT_EQ(likeliest(follow(turn(-1.0), 4.0)), MotionMode::kRightTurn);
}

TEST(ImmFilter, EstimatesVelocityAndAccelerationOfABrakingCar) {
  const ImmFilter filter = follow([](double t) { return Point2(12.0 * t - t * t, 3.0); }, 4.0);
  EXPECT_NEAR(filter.estimate().mean[2], 12.0 - 2.0 * 3.9, 0.4);
  EXPECT_NEAR(filter.estimate().mean[4], -2.0, 0.7);
}

/// A step in which the velocity does not affect the modes.
ImmStep withStopFromAnySpeed() {
  ImmStep step = immStep(ImmOptions(), kPeriod);
  step.stop_variance = 1e12;
  return step;
}

TEST(ImmFilter, MissesGrowTheCovarianceAndLeadToThePriorModes) {
  ImmFilter filter = follow([](double t) { return Point2(5.0 * t, 0.0); }, 4.0);
  const ImmStep step = withStopFromAnySpeed();
  double trace = filter.estimate().covariance.topLeftCorner<4, 4>().trace();
  for (int i = 0; i < 20; ++i) {
    const ModeVector expected = step.transition.transpose() * filter.modeProbabilities();
    filter.predict(step);
    EXPECT_TRUE(filter.modeProbabilities().isApprox(expected, 1e-12));
    const double expand = filter.estimate().covariance.topLeftCorner<4, 4>().trace();
    EXPECT_GT(expand, trace);
    trace = expand;
  }
}

TEST(ImmFilter, OneMixingByHand) {
  // Two steps of zero time: only the mixing remains, and for equal modes it changes nothing.
  const ImmOptions options;
  ImmFilter filter(startAt(Point2(1.0, 2.0)), priorModeProbabilities(options));
  filter.predict(immStep(options, 0.0));
  EXPECT_TRUE(filter.estimate().mean.isApprox(startAt(Point2(1.0, 2.0)).mean, 1e-12));
  EXPECT_TRUE(filter.estimate().covariance.isApprox(startAt(Point2::Zero()).covariance, 1e-12));
  EXPECT_TRUE(filter.modeProbabilities().isApprox(priorModeProbabilities(options), 1e-12));
}

TEST(ImmFilter, WithEqualModesItIsOneKalmanFilter) {
  ImmStep step = withStopFromAnySpeed();
  step.motions.fill(step.motions[0]);
  step.start_variance.setZero();
  ImmFilter filter(startAt(Point2::Zero()), priorModeProbabilities(ImmOptions()));
  StateEstimate single = startAt(Point2::Zero());
  for (int i = 1; i < 30; ++i) {
    const PositionMeasurement seen{Point2(0.3 * i, std::sin(0.2 * i)),
                                   Eigen::Matrix2d::Identity() * 0.01};
    filter.predict(step);
    single = predict(single, step.motions[0]);
    EXPECT_NEAR(filter.logLikelihood(seen), innovationOf(single, seen).logLikelihood(), 1e-9);
    filter.update(seen, 0.0);
    single = update(single, seen);
  }
  EXPECT_TRUE(filter.estimate().mean.isApprox(single.mean, 1e-9));
  EXPECT_TRUE(filter.estimate().covariance.isApprox(single.covariance, 1e-9));
  // Shares of time are unchanged, except for the discretization of the jumps.
  EXPECT_TRUE(filter.modeProbabilities().isApprox(priorModeProbabilities(ImmOptions()), 0.02));
}

TEST(ImmFilter, AMeasurementFarAwayUnderflowsNothing) {
  const ImmOptions options;
  ImmFilter filter = follow([](double t) { return Point2(5.0 * t, 0.0); }, 4.0);
  filter.predict(withStopFromAnySpeed());
  const PositionMeasurement far{Point2(1e4, -1e4), Eigen::Matrix2d::Identity() * 1e-4};
  EXPECT_TRUE(std::isfinite(filter.logLikelihood(far)));
  const ModeVector before = filter.modeProbabilities();
  filter.update(far, options.outlier_probability);
  EXPECT_NEAR(filter.modeProbabilities().sum(), 1.0, 1e-12);
  const ModeVector kept = filter.modeProbabilities().cwiseQuotient(before);
  EXPECT_GE(kept.minCoeff(), 0.999 * options.outlier_probability);
  EXPECT_TRUE(filter.estimate().mean.allFinite());
  EXPECT_TRUE(filter.estimate().covariance.allFinite());
}

TEST(ImmFilter, OneMeasurementMayBeAnOutlierOfStandingTwoMayNot) {
  const ImmOptions options;
  ImmFilter filter = follow([](double) { return Point2(20.0, 5.0); }, 3.0);
  ASSERT_GT(filter.modeProbabilities()[kStanding], 0.9);
  std::vector<double> standing;
  for (const double jump : {2.0, 3.0}) {  // of what is seen of it, m
    filter.predict(immStep(options, kPeriod));
    filter.update(PositionMeasurement{Point2(20.0 + jump, 5.0), Eigen::Matrix2d::Identity() * 0.01},
                  options.outlier_probability);
    standing.push_back(filter.modeProbabilities()[kStanding]);
  }
  EXPECT_GT(standing[0], 0.9 * options.outlier_probability * 0.9);
  EXPECT_LT(standing[1], 0.01);
}

TEST(ImmFilter, UpdateReturnsTheLogLikelihood) {
  const ImmOptions options;
  ImmFilter filter = follow([](double t) { return Point2(5.0 * t, 0.0); }, 2.0);
  filter.predict(immStep(options, kPeriod));
  const PositionMeasurement seen{Point2(10.1, 0.2), Eigen::Matrix2d::Identity() * 0.04};
  const double expected = filter.logLikelihood(seen);
  EXPECT_NEAR(filter.update(seen, options.outlier_probability), expected, 1e-12);
}

TEST(ImmFilter, AShiftMovesThePositionAndNothingElse) {
  const ImmStep step = immStep(ImmOptions(), kPeriod);
  ImmFilter filter = follow([](double t) { return Point2(5.0 * t, 0.0); }, 2.0);
  ImmFilter shifted = filter;
  const Point2 offset(0.7, -0.3);
  shifted.shift(offset);
  for (ImmFilter* each : {&filter, &shifted}) {
    each->predict(step);
    const Point2 seen = Point2(10.0, 0.1) + (each == &shifted ? offset : Point2::Zero());
    each->update(PositionMeasurement{seen, Eigen::Matrix2d::Identity() * 0.04}, 1e-3);
  }
  TrackState expected = filter.estimate().mean;
  expected.head<2>() += offset;
  EXPECT_TRUE(shifted.estimate().mean.isApprox(expected, 1e-9));
  EXPECT_TRUE(shifted.estimate().covariance.isApprox(filter.estimate().covariance, 1e-9));
  EXPECT_TRUE(shifted.modeProbabilities().isApprox(filter.modeProbabilities(), 1e-9));
}

TEST(ImmFilter, FarFromTheOriginNoDigitsAreLost) {
  const Point2 far(1e6, -2e6);
  const auto path = [](double t) { return Point2(5.0 * t, 0.3 * t * t); };
  const ImmFilter here = follow(path, 5.0);
  const ImmFilter there = follow([&](double t) { return Point2(far + path(t)); }, 5.0);
  EXPECT_TRUE(there.estimate().covariance.isApprox(here.estimate().covariance, 1e-6));
  EXPECT_TRUE(there.modeProbabilities().isApprox(here.modeProbabilities(), 1e-6));
}

TEST(ImmFilter, WithoutAdaptationTransitionsAreFixed) {
  ImmOptions options;
  options.transitions.adaptive = true;
  options.transitions.learning.prior_exposure = 1e5;
  const ImmStep step = immStep(options, kPeriod);
  const ModeVector prior = priorModeProbabilities(options);
  ImmFilter fixed(startAt(Point2::Zero()), prior);
  ImmFilter adaptive(startAt(Point2::Zero()), prior,
                     TransitionPriors(options.transitions).modelOf(ObjectClass::kUnknown));
  for (int i = 1; i < 50; ++i) {
    for (ImmFilter* filter : {&fixed, &adaptive}) {
      filter->predict(step);
      filter->update(
          PositionMeasurement{Point2(0.02 * i * i, 0.0), Eigen::Matrix2d::Identity() * 0.01}, 1e-3);
    }
  }
  EXPECT_TRUE(adaptive.modeProbabilities().isApprox(fixed.modeProbabilities(), 1e-3));
  EXPECT_TRUE(adaptive.estimate().mean.isApprox(fixed.estimate().mean, 1e-4));
}

/// Objects that jump between the models with the filter's own transition probabilities.
class JumpingModes : public testing::TestWithParam<bool> {};

TEST_P(JumpingModes, ErrorsAndInnovationsAreConsistent) {
  constexpr int kRuns = 1000;
  constexpr int kSteps = 60;
  ImmOptions options;
  options.transitions.standing = GetParam();
  const ImmStep step = immStep(options, kPeriod);
  const ModeVector prior = priorModeProbabilities(options);
  std::vector<double> errors;
  std::vector<double> innovations;
  for (int run = 0; run < kRuns; ++run) {
    JumpSystem object(static_cast<std::uint64_t>(run), prior);
    ImmFilter filter(JumpSystem::start(), prior);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      object.move(step, step.transition);
      filter.predict(step);
      const PositionMeasurement seen = object.measure();
      sum += innovationOf(filter.estimate(), seen).squaredDistance();
      filter.update(seen, 0.0);
    }
    innovations.push_back(sum / kSteps);
    errors.push_back(normalizedError(object.truth(), filter.estimate()));
  }
  // With correct covariances the means are 4 and 2 whatever the distribution, but its spread is not
  // that of chi-square: a mixture is not normal, least of all one of stationary and moving.
  const SampleMean error(errors);
  EXPECT_NEAR(error.mean, 4.0, error.bound);
  const SampleMean innovation(innovations);
  EXPECT_NEAR(innovation.mean, 2.0, innovation.bound);
}

INSTANTIATE_TEST_SUITE_P(Standing, JumpingModes, testing::Bool());

}  // namespace
}  // namespace datmo::imm_filter_test
