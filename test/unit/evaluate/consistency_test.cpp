// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/consistency.h"

#include <cmath>
#include <limits>
#include <random>

#include "made_frames.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace datmo::evaluation::consistency_test {
namespace {

Eigen::Matrix2d matrix(double xx, double xy, double yy) {
  Eigen::Matrix2d result;
  result << xx, xy, xy, yy;
  return result;
}

/// Errors drawn from `truth`, evaluated with the covariance `claimed`.
Consistency ofRandomErrors(const Eigen::Matrix2d& truth, const Eigen::Matrix2d& claimed) {
  std::mt19937_64 engine(17);
  std::normal_distribution<double> normal;
  const Eigen::Matrix2d root = truth.llt().matrixL();
  NeesSum sum(2);
  for (int i = 0; i < 2000; ++i) {
    const double first = normal(engine);
    const double second = normal(engine);
    sum.add(normalizedErrorSquared<2>(root * Eigen::Vector2d(first, second), claimed));
  }
  return sum.result();
}

TEST(Consistency, QuantilesAsInTheTables) {
  // With two degrees of freedom the quantile of p is -2 ln(1 - p).
  EXPECT_NEAR(chiSquareQuantile(0.95, 2.0), -2.0 * std::log(0.05), 1e-12);
  // Bar-Shalom, Li and Kirubarajan 2001, table 1.5.4-1.
  EXPECT_NEAR(chiSquareQuantile(0.025, 100.0), 74.2, 0.05);
  EXPECT_NEAR(chiSquareQuantile(0.975, 100.0), 129.6, 0.05);
  EXPECT_NEAR(chiSquareQuantile(0.975, 1.0), 5.02, 0.005);
  // Many samples: the normal approximation, 1 +- 1.96 sqrt(2 / n).
  EXPECT_NEAR(chiSquareQuantile(0.975, 3e5) / 3e5, 1.0 + 1.96 * std::sqrt(2.0 / 3e5), 1e-4);
}

TEST(Consistency, NoneWithoutSamples) {
  const Consistency result = NeesSum(2).result();
  EXPECT_FALSE(result.mean_nees || result.lower || result.upper || result.inside_share);
  EXPECT_EQ(result.samples, 0U);
}

TEST(Consistency, MeanOfHandComputedSamples) {
  NeesSum sum(2);
  // 2^2 / 4 + 1^2 / 1 = 2.
  sum.add(normalizedErrorSquared<2>({2.0, 1.0}, matrix(4.0, 0.0, 1.0)));
  // The inverse is [[2, -1], [-1, 2]] / 3: (2 - 1 - 1 + 2) / 3 = 2 / 3.
  sum.add(normalizedErrorSquared<2>({1.0, 1.0}, matrix(2.0, 1.0, 2.0)));
  // 3^2 = 9, beyond 5.99.
  sum.add(normalizedErrorSquared<2>({0.0, 3.0}, matrix(1.0, 0.0, 1.0)));
  const Consistency result = sum.result();
  EXPECT_NEAR(result.mean_nees.value(), (2.0 + 2.0 / 3.0 + 9.0) / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(result.inside_share.value(), 2.0 / 3.0);
  EXPECT_EQ(result.degrees_of_freedom, 2);
}

TEST(Consistency, BoundsOfTheMeanOfFiftySamples) {
  // The hundred degrees of freedom of the tables: [74.2, 129.6] / 50.
  NeesSum sum(2);
  for (int i = 0; i < 50; ++i) {
    sum.add(normalizedErrorSquared<2>({1.0, 0.0}, matrix(1.0, 0.0, 1.0)));
  }
  EXPECT_NEAR(sum.result().lower.value(), 1.484, 0.001);
  EXPECT_NEAR(sum.result().upper.value(), 2.591, 0.001);
}

TEST(Consistency, AConsistentFilterIsWithinTheBounds) {
  const Eigen::Matrix2d covariance = matrix(4.0, 1.0, 0.5);
  const Consistency result = ofRandomErrors(covariance, covariance);
  EXPECT_GT(result.mean_nees.value(), result.lower.value());
  EXPECT_LT(result.mean_nees.value(), result.upper.value());
  EXPECT_NEAR(result.inside_share.value(), 0.95, 0.015);
}

TEST(Consistency, OverconfidentAndConservative) {
  const Eigen::Matrix2d covariance = matrix(4.0, 1.0, 0.5);
  const Consistency too_sure = ofRandomErrors(covariance, 0.8 * covariance);
  EXPECT_GT(too_sure.mean_nees.value(), too_sure.upper.value());
  const Consistency too_cautious = ofRandomErrors(covariance, 1.25 * covariance);
  EXPECT_LT(too_cautious.mean_nees.value(), too_cautious.lower.value());
}

TEST(Consistency, InvalidCovariancesAreCounted) {
  NeesSum sum(2);
  sum.add(normalizedErrorSquared<2>({1.0, 1.0}, Eigen::Matrix2d::Zero()));
  sum.add(normalizedErrorSquared<2>({1.0, 1.0}, matrix(1.0, 2.0, 1.0)));
  sum.add(normalizedErrorSquared<2>({1.0, 1.0},
                                    matrix(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0)));
  EXPECT_EQ(sum.result().samples, 0U);
  EXPECT_EQ(sum.result().unusable, 3U);
}

TEST(Consistency, PositionAndVelocityOfTheMatches) {
  TrackState track = trackAt(1, 1.0, 0.0);
  track.velocity = Point2(0.0, 6.0);
  track.covariance.diagonal() << 4.0, 1.0, 1.0, 9.0;
  const Frames frames = FrameMaker()
                            .add({truthAt(1, 0.0), optionalAt(2, 9.0)},
                                 {track, trackAt(2, 9.0, 1.0), trackAt(3, 50.0)})
                            .frames();
  const TrackConsistency result = scoreConsistency(frames, matchFrames(frames, MatchOptions()));
  EXPECT_EQ(result.position.samples, 1U);
  EXPECT_DOUBLE_EQ(result.position.mean_nees.value(), 1.0 / 4.0);
  EXPECT_DOUBLE_EQ(result.velocity.mean_nees.value(), 36.0 / 9.0);
}

}  // namespace
}  // namespace datmo::evaluation::consistency_test
