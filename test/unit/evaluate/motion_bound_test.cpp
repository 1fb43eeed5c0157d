// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/motion_bound.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::evaluation::motion_bound_test {
namespace {

constexpr double kSigma = 0.2;   // m
constexpr double kPeriod = 0.1;  // s

const Point2 kAlongX(1.0, 0.0);
const Point2 kAlongY(0.0, 1.0);

TEST(MotionBound, OneScanIsUninformative) {
  MotionBound bound;
  EXPECT_DOUBLE_EQ(bound.logRatio(), 0.0);
  bound.addRange(Point2::Zero(), kAlongX, -kAlongX, kSigma);
  EXPECT_DOUBLE_EQ(bound.logRatio(), 0.0);
}

TEST(MotionBound, AWallApproachingAlongTheBeam) {
  // Slope of a line through n points: variance 12 sigma^2 / (n (n^2 - 1) dt^2).
  constexpr double kSpeed = 3.0;  // m/s
  MotionBound bound;
  for (int n = 1; n <= 8; ++n) {
    bound.addRange(-kSpeed * kPeriod * (n - 1) * kAlongX, kAlongX, -kAlongX, kSigma);
    const double variance =
        n < 2 ? INFINITY : 12.0 * kSigma * kSigma / (n * (n * n - 1.0) * kPeriod * kPeriod);
    EXPECT_NEAR(bound.logRatio(), 0.5 * kSpeed * kSpeed / variance, 1e-9) << n;
  }
}

TEST(MotionBound, MotionAlongASideWithoutEndsIsUnobservable) {
  MotionBound bound;
  const Point2 oblique = Point2(1.0, 1.0).normalized();
  for (int n = 0; n < 100; ++n) {
    bound.addRange(10.0 * n * kPeriod * kAlongY, oblique, -kAlongX, kSigma);
  }
  EXPECT_NEAR(bound.logRatio(), 0.0, 1e-6);
}

TEST(MotionBound, AnObliqueBeamIsMoreInformative) {
  // At 60 degrees to the normal the range changes by twice the displacement along it.
  MotionBound bound;
  const Point2 oblique(0.5, std::sqrt(0.75));
  bound.addRange(Point2::Zero(), oblique, -kAlongX, kSigma);
  bound.addRange(0.3 * kAlongX, oblique, -kAlongX, kSigma);
  // Difference of two with the deviation 0.1 m each: 0.3^2 / (2 * 0.1^2), halved.
  EXPECT_NEAR(bound.logRatio(), 2.25, 1e-9);
}

TEST(MotionBound, EndsRevealLateralMotion) {
  MotionBound bound;
  bound.addInterval(Point2::Zero(), kAlongY, 1.2);
  bound.addInterval(2.4 * kAlongY, kAlongY, 1.2);
  // Variance of the difference 2 * 1.2^2 / 12 = 0.24: 2.4^2 / 0.24, halved.
  EXPECT_NEAR(bound.logRatio(), 12.0, 1e-9);
}

TEST(MotionBound, NoiseInOneScanCountsAgainstTheOthers) {
  // There and back: the mean is the most likely position if it was stationary.
  MotionBound bound;
  for (const double x : {0.0, 0.6, 0.0}) {
    bound.addRange(x * kAlongX, kAlongX, -kAlongX, kSigma);
  }
  // Squares about the mean 0.2: 0.04 + 0.16 + 0.04 = 0.24; / 0.04, halved.
  EXPECT_NEAR(bound.logRatio(), 3.0, 1e-9);
}

}  // namespace
}  // namespace datmo::evaluation::motion_bound_test
