// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_drift.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/square.h"

namespace datmo::map_drift_test {
namespace {

constexpr double kPeriod = 0.1;          // s
constexpr double kStep = 0.3;            // m
constexpr double kViewRange = 20.0;      // m
constexpr double kPositionSigma = 0.04;  // m
constexpr double kHeadingSigma = degrees(0.1);
constexpr double kAge = 2.0;  // s: 20 scans

Eigen::Matrix3d matchCovariance() {
  return Eigen::Vector3d(square(kPositionSigma), square(kPositionSigma), square(kHeadingSigma))
      .asDiagonal();
}

/// A vehicle whose scans are matched, one after the other.
class Drive {
 public:
  explicit Drive(bool by_odometry, double scale_sigma = 0.05)
      : Drive(by_odometry, ScalePrior{square(scale_sigma), true}) {}
  Drive(bool by_odometry, const ScalePrior& scale)
      : drift(scale, kStep), by_odometry_(by_odometry) {}

  void scan(const Pose2& pose, double age) {
    drift.moveTo(pose, by_odometry_);
    drift.write({Stamp::fromSeconds(time_), {pose, matchCovariance()}, age, kViewRange});
    time_ += kPeriod;
  }

  /// Adds this many scans, 1 m apart.
  void straight(int scans, double age = kAge) {
    for (int i = 0; i < scans; ++i) {
      x_ += 1.0;
      scan(Pose2(x_, 0.0, 0.0), std::min(age, time_));
    }
  }

  MapDrift drift;

 private:
  bool by_odometry_;
  double time_ = 0.0;
  double x_ = 0.0;
};

TEST(MapDriftTest, TheMapTakesOverOneErrorOfTheMatchInEachRenewal) {
  Drive drive(false);
  drive.straight(100);
  const Eigen::Matrix3d before = drive.drift.covariance();
  drive.straight(200);  // 10 renewals of 20 scans
  const Eigen::Matrix3d after = drive.drift.covariance();
  EXPECT_NEAR(after(2, 2) - before(2, 2), 10.0 * square(kHeadingSigma),
              0.1 * 10.0 * square(kHeadingSigma));
  EXPECT_NEAR(after(0, 0) - before(0, 0), 10.0 * square(kPositionSigma),
              0.1 * 10.0 * square(kPositionSigma));
}

TEST(MapDriftTest, OfSurfacesOfTwoAgesTheMeanAgeCoversTheDriftWithinAFactorOfTwenty) {
  // Nine tenths of the matched points are one scan old, one tenth is 101 scans old: 11 on average.
  // Each error of a match, one per scan, enters the map unchanged; how large is the drift after
  // 3000?
  constexpr int kOld = 101;
  constexpr int kScans = 3000;
  constexpr int kRuns = 200;
  Random random(7);
  double squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<double> error(kOld, 0.0);
    for (int i = 0; i < kScans; ++i) {
      error.push_back(0.9 * error.back() + 0.1 * error[error.size() - kOld] +
                      random.normal(kPositionSigma));
    }
    squares += square(error.back()) / kRuns;
  }
  Drive drive(false, ScalePrior{0.0, false});
  drive.straight(kScans, 11.0 * kPeriod);
  const double by_mean_age = drive.drift.covariance()(0, 0);
  // It covers errors that are correlated over one renewal, 11 scans; here they are independent.
  EXPECT_GT(by_mean_age, squares);
  EXPECT_LT(by_mean_age, 20.0 * squares);
  Drive by_rate(false, ScalePrior{0.0, false});
  by_rate.straight(kScans, kPeriod / (0.9 + 0.1 / kOld));
  EXPECT_GT(by_rate.drift.covariance()(0, 0), 20.0 * squares) << "the rates' mean is far off";
}

TEST(MapDriftTest, AHeadingErrorCausesLateralDrift) {
  Drive drive(false);
  drive.straight(100);
  const double heading_variance = drive.drift.covariance()(2, 2);
  const double before = drive.drift.covariance()(1, 1);
  drive.straight(200);
  EXPECT_GT(drive.drift.covariance()(1, 1), before + square(200.0) * heading_variance);
  EXPECT_GT(drive.drift.covariance()(1, 2), 0.0) << "to the left, and turned to the left";
}

TEST(MapDriftTest, AtRestNothingDrifts) {
  Drive drive(true);
  drive.straight(100);
  const Eigen::Matrix3d before = drive.drift.covariance();
  for (int i = 0; i < 5000; ++i) {
    const double noise = i % 2 == 0 ? 0.01 : -0.01;
    drive.scan(Pose2(100.0 + noise, noise, 0.1 * noise), kAge);
  }
  EXPECT_TRUE(drive.drift.covariance().isApprox(before, 1e-2));
}

TEST(MapDriftTest, ATurnOnTheSpotRenewsTheViewToo) {
  Drive drive(true);
  drive.straight(100);
  const double before = drive.drift.covariance()(2, 2);
  for (int i = 1; i <= 200; ++i) {
    drive.scan(Pose2(100.0, 0.0, degrees(3.0) * i), kAge);
  }
  EXPECT_NEAR(drive.drift.covariance()(2, 2) - before, 10.0 * square(kHeadingSigma),
              0.1 * 10.0 * square(kHeadingSigma));
}

TEST(MapDriftTest, TheScaleOfOdometryIsKnownAsOneRenewalShowsIt) {
  Drive drive(true);
  EXPECT_DOUBLE_EQ(drive.drift.scaleSigma(), 0.05);
  drive.straight(100);
  // Two matches, 20 m apart.
  EXPECT_NEAR(drive.drift.scaleSigma(), std::sqrt(2.0) * kPositionSigma / 20.0, 1e-4);
  drive.straight(100, 1.0);
  EXPECT_NEAR(drive.drift.scaleSigma(), std::sqrt(2.0) * kPositionSigma / 20.0, 1e-4)
      << "what was learned stays";
}

TEST(MapDriftTest, AScaleThatIsNotEstimatedStaysUnknown) {
  Drive drive(true, ScalePrior{square(0.05), false});
  drive.straight(100);
  EXPECT_DOUBLE_EQ(drive.drift.scaleSigma(), 0.05);
}

TEST(MapDriftTest, OldSurfacesShowTheScaleOnlyOverTheDistanceDrivenSince) {
  constexpr double kLongAgo = 1e6;  // s
  Drive drive(true);
  for (int i = 1; i <= 100; ++i) {
    drive.scan(Pose2(i, 0.0, 0.0), kLongAgo);
  }
  EXPECT_NEAR(drive.drift.scaleSigma(), std::sqrt(2.0) * kPositionSigma / 99.0, 1e-4);
}

TEST(MapDriftTest, TheScaleMakesTheDistanceUncertainInProportionToIt) {
  const auto alongAfter = [](bool by_odometry, int scans) {
    Drive drive(by_odometry);
    drive.straight(scans);
    return std::sqrt(drive.drift.covariance()(0, 0));
  };
  EXPECT_NEAR(alongAfter(true, 2000) / alongAfter(true, 1000), 2.0, 0.1);
  EXPECT_NEAR(alongAfter(false, 2000) / alongAfter(false, 1000), std::sqrt(2.0), 0.1);
  EXPECT_GT(alongAfter(true, 1000), 2.0 * alongAfter(false, 1000));
}

TEST(MapDriftTest, APriorMapHoldsThePose) {
  constexpr double kLongAgo = 1e6;  // s
  Drive drive(true, 0.0);
  for (int i = 1; i <= 1000; ++i) {
    drive.scan(Pose2(i, 0.0, 0.0), kLongAgo);
  }
  EXPECT_LT(drive.drift.covariance()(2, 2), 0.01 * square(kHeadingSigma));
  EXPECT_LT(drive.drift.covariance()(0, 0), 0.01 * square(kPositionSigma));
}

TEST(MapDriftTest, UnmatchedScansHaveTheErrorOfThePrediction) {
  Drive drive(false);
  drive.straight(100);
  const double before = drive.drift.covariance()(0, 0);
  drive.drift.writeUnmatched(Eigen::Vector3d(1.0, 0.0, 0.0).asDiagonal());
  drive.drift.writeUnmatched(Eigen::Vector3d(4.0, 0.0, 0.0).asDiagonal());
  drive.straight(2);
  EXPECT_NEAR(drive.drift.covariance()(0, 0) - before, 4.0, 0.01) << "the last one's, once";
}

TEST(MapDriftTest, WithoutMatchesItIsPropagated) {
  Drive drive(false);
  drive.straight(100);
  const Eigen::Matrix3d before = drive.drift.covariance();
  drive.drift.moveTo(Pose2(100.0, 50.0, 1.0), false);
  const Eigen::Matrix3d after = drive.drift.covariance();
  EXPECT_NEAR(after(2, 2), before(2, 2), 1e-12);
  EXPECT_NEAR(after(0, 0), before(0, 0) + square(50.0) * before(2, 2), 1e-9)
      << "50 m to the left the heading's error leads along x";
}

}  // namespace
}  // namespace datmo::map_drift_test
