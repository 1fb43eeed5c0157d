// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_track.h"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace datmo::border_track_test {
namespace {

/// State of the line `estimate` relative to the true line at the estimate's anchor: its errors of
/// offset, heading, curvature and curvature rate.
Eigen::Vector4d errorOf(const BorderTrack& estimate, const BorderCurve& truth) {
  const CurveTable table(truth, -5.0, 60.0);
  const CurvePoint foot = table.locate(estimate.curve().anchor.position());
  const BorderCurve there = truth.movedAlong(foot.along);
  return {foot.aside, angleBetween(there.anchor.heading(), estimate.curve().anchor.heading()),
          estimate.curve().curvature - there.curvature,
          estimate.curve().curvature_rate - there.curvature_rate};
}

BorderTrackOptions withoutDrift() {
  BorderTrackOptions options;
  options.offset_drift = 0.0;
  options.heading_drift = 0.0;
  options.curvature_drift = 0.0;
  options.map_drift = 0.0;
  options.curvature_sigma = 0.01;
  options.curvature_rate_sigma = 2e-4;
  options.curvature_rate_length = 1000.0;
  options.gate = 10.0;
  return options;
}

class BorderTrackTest : public testing::TestWithParam<BorderCurve> {
 protected:
  double normal(double sigma) { return sigma * distribution_(engine_); }

  /// An initial state whose error is drawn from its covariance.
  BorderTrack started(const BorderTrackOptions& options, const BorderCurve& truth) {
    const Eigen::Matrix2d covariance = Eigen::Vector2d(0.09, 0.0025).asDiagonal();
    return {options, truth.anchor * Pose2(0.0, normal(0.3), normal(0.05)), covariance};
  }

  /// Hits on the truth up to 20 m ahead of the anchor.
  void see(const BorderCurve& truth, double sigma, BorderTrack& track) {
    const CurveTable seen(track.curve(), -5.0, 30.0);
    const CurveTable true_line(truth, -5.0, 60.0);
    const double anchor = true_line.locate(track.curve().anchor.position()).along;
    std::vector<BorderHit> hits;
    for (double along = 0.0; along <= 20.0; along += 2.5) {
      const Pose2 position = true_line.at(anchor + along);
      hits.push_back({seen.locate(position * Point2(0.0, normal(sigma))), sigma * sigma});
    }
    track.correct(hits);
  }

 private:
  std::mt19937_64 engine_{5};
  std::normal_distribution<double> distribution_{0.0, 1.0};
};

TEST_P(BorderTrackTest, ConvergesToTheTruthWithConsistentErrors) {
  constexpr int kRuns = 200;
  constexpr int kSteps = 30;
  double squares = 0.0;
  double offset = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    BorderTrack track = started(withoutDrift(), GetParam());
    for (int step = 0; step < kSteps; ++step) {
      track.advance(1.0, 0.1);
      see(GetParam(), 0.2, track);
    }
    const Eigen::Vector4d error = errorOf(track, GetParam());
    // Curvature and its rate start at 0, which is no draw from their distribution: the estimate
    // must not be overconfident.
    const Eigen::Vector2d line = error.head<2>();
    squares += line.dot(track.covariance().topLeftCorner<2, 2>().ldlt().solve(line));
    offset += error[0] * error[0];
  }
  EXPECT_LT(std::sqrt(offset / kRuns), 0.08);
  // 99 % bounds of the mean of chi-square with two degrees of freedom, normal for so many.
  const double spread = 2.58 * std::sqrt(2.0 * 2.0 / kRuns);
  EXPECT_GT(squares / kRuns, 2.0 - spread);
  EXPECT_LT(squares / kRuns, 2.0 + spread);
}

INSTANTIATE_TEST_SUITE_P(Lines, BorderTrackTest,
                         testing::Values(BorderCurve{Pose2(3.0, 4.0, 0.3), 0.0, 0.0},
                                         BorderCurve{Pose2(3.0, 4.0, -2.9), 0.01, 0.0},
                                         BorderCurve{Pose2(-1.0, 2.0, 1.5), -0.004, 2e-4}));

TEST(BorderTrack, MovesAlongAnArcExactly) {
  const BorderCurve arc{Pose2(0.0, 0.0, 0.0), 0.02, 0.0};
  const BorderCurve moved = arc.movedAlong(25.0 * kPi);
  EXPECT_NEAR(moved.anchor.x(), 50.0, 2e-3) << "a quarter of a circle of 50 m";
  EXPECT_NEAR(moved.anchor.y(), 50.0, 2e-3);
  EXPECT_NEAR(moved.anchor.heading(), 0.5 * kPi, 1e-9);
}

TEST(BorderTrack, FootOfAPointOnACurve) {
  const BorderCurve arc{Pose2(0.0, 0.0, 0.0), 0.02, 0.0};
  const CurveTable table(arc, -10.0, 40.0);
  const BorderCurve there = arc.movedAlong(20.0);
  const CurvePoint position = table.locate(there.anchor * Point2(0.0, 3.0));
  EXPECT_NEAR(position.along, 20.0, 0.02);
  EXPECT_NEAR(position.aside, 3.0, 0.01);
}

TEST(BorderTrack, OffsetByHand) {
  BorderTrackOptions options = withoutDrift();
  const Eigen::Matrix2d covariance = Eigen::Vector2d(0.09, 1e-12).asDiagonal();
  BorderTrack track(options, Pose2(0.0, 0.0, 0.0), covariance);
  EXPECT_EQ(track.correct({{{0.0, 0.4}, 0.03}}), 1);
  EXPECT_NEAR(track.curve().anchor.y(), 0.4 * 0.75, 1e-9) << "gain 0.09 / 0.12";
  EXPECT_NEAR(track.covariance()(0, 0), 0.0225, 1e-9);
}

TEST(BorderTrack, LeavesOutHitsBeyondTheGate) {
  BorderTrackOptions options = withoutDrift();
  options.gate = 3.0;
  const Eigen::Matrix2d covariance = Eigen::Vector2d(0.01, 1e-6).asDiagonal();
  BorderTrack track(options, Pose2(0.0, 0.0, 0.0), covariance);
  EXPECT_EQ(track.correct({{{0.0, 2.0}, 0.04}}), 0);
  EXPECT_EQ(track.curve().anchor.y(), 0.0);
}

TEST(BorderTrack, UncertaintyGrowsWithDistanceAndTime) {
  const Eigen::Matrix2d covariance = Eigen::Vector2d(0.01, 1e-6).asDiagonal();
  BorderTrack driven(BorderTrackOptions(), Pose2(), covariance);
  BorderTrack standing = driven;
  const double before = driven.varianceAt(0.0);
  driven.advance(10.0, 1.0);
  standing.advance(0.0, 1.0);
  EXPECT_GT(standing.varianceAt(0.0), before);
  EXPECT_GT(driven.varianceAt(0.0), standing.varianceAt(0.0));
  EXPECT_NEAR(driven.arcLength(), 10.0, 1e-12);
}

TEST(BorderTrack, CovarianceStaysPositive) {
  const Eigen::Matrix2d covariance = Eigen::Vector2d(100.0, 1.0).asDiagonal();
  BorderTrack track(BorderTrackOptions(), Pose2(), covariance);
  for (int i = 0; i < 500; ++i) {
    track.advance(0.6, 0.06);
    track.correct({{{5.0, 0.0}, 1e-4}, {{30.0, 0.0}, 1e-4}});
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(track.covariance());
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
}

}  // namespace
}  // namespace datmo::border_track_test
