// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_filter.h"

#include <cmath>
#include <optional>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::pose_filter_test {
namespace {

/// Returns a match with this noise combined with a prior: the product of the two normal
/// distributions.
PoseWithCovariance fuse(const PoseWithCovariance& prior, const Pose2& measured,
                        const Eigen::Matrix3d& noise) {
  const Eigen::Vector3d error(measured.x() - prior.pose.x(), measured.y() - prior.pose.y(),
                              angleBetween(prior.pose.heading(), measured.heading()));
  const Eigen::Matrix3d gain = prior.covariance * (prior.covariance + noise).inverse();
  const Eigen::Vector3d step = gain * error;
  return {{prior.pose.x() + step[0], prior.pose.y() + step[1], prior.pose.heading() + step[2]},
          (Eigen::Matrix3d::Identity() - gain) * prior.covariance};
}

/// Drives with biased odometry and unbiased, noisy pose measurements.
class BiasedDrive {
 public:
  BiasedDrive(double speed_scale, double yaw_rate_bias, std::uint64_t seed)
      : speed_scale_(speed_scale), yaw_rate_bias_(yaw_rate_bias), random_(seed) {}

  void run(PoseFilter& filter, int steps) {
    const double seconds = 0.1;
    const Eigen::Matrix3d noise =
        Eigen::Vector3d(0.03 * 0.03, 0.03 * 0.03, 0.004 * 0.004).asDiagonal();
    for (int i = 0; i < steps; ++i) {
      const Twist2 twist{8.0, 0.3 * std::sin(0.05 * i)};
      truth = truth * arc(twist, seconds);
      const Twist2 measured{(1.0 + speed_scale_) * twist.forward_speed + random_.normal(0.1),
                            twist.yaw_rate + yaw_rate_bias_ + random_.normal(0.01)};
      filter.predictMeasured(arc(filter.errors().correct(measured), seconds), seconds);
      const Pose2 seen(truth.x() + random_.normal(0.03), truth.y() + random_.normal(0.03),
                       truth.heading() + random_.normal(0.004));
      filter.correct(fuse(filter.pose(), seen, noise));
    }
  }

  Pose2 truth;

 private:
  double speed_scale_;
  double yaw_rate_bias_;
  Random random_;
};

TEST(PoseFilterTest, LearnsScaleAndBias) {
  PoseFilter filter({}, {});
  BiasedDrive drive(0.03, degrees(0.5), 7);
  drive.run(filter, 600);
  EXPECT_NEAR(filter.errors().speed_scale, 0.03, 0.005);
  EXPECT_NEAR(filter.errors().yaw_rate_bias, degrees(0.5), degrees(0.1));
}

TEST(PoseFilterTest, WithoutCalibrationNothingIsLearned) {
  PoseFilterOptions options;
  options.calibrate_odometry = false;
  PoseFilter filter(options, {});
  BiasedDrive drive(0.03, degrees(0.5), 7);
  drive.run(filter, 200);
  EXPECT_DOUBLE_EQ(filter.errors().speed_scale, 0.0);
  EXPECT_DOUBLE_EQ(filter.errors().yaw_rate_bias, 0.0);
}

TEST(PoseFilterTest, TheCovarianceHoldsTheError) {
  // Normalized estimation error squared of the pose over independent drives: 3 on average; 200 runs
  // have a mean between 2.67 and 3.35 with 95 % if the covariance is exact. The filter's odometry
  // noise is larger than the drive's, so the filter can only be conservative.
  double sum = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    PoseFilter filter({}, {});
    BiasedDrive drive(0.02, 0.005, 100 + static_cast<std::uint64_t>(run));
    drive.run(filter, 60);
    const PoseWithCovariance pose = filter.pose();
    const Eigen::Vector3d error(pose.pose.x() - drive.truth.x(), pose.pose.y() - drive.truth.y(),
                                angleBetween(drive.truth.heading(), pose.pose.heading()));
    sum += error.dot(pose.covariance.inverse() * error);
  }
  EXPECT_LT(sum / kRuns, 3.35);
  EXPECT_GT(sum / kRuns, 1.0);
}

TEST(PoseFilterTest, PredictionAloneGrowsTheCovariance) {
  PoseFilter filter({}, {});
  double last = -1.0;
  for (int i = 0; i < 20; ++i) {
    filter.predictUnmeasured(0.1);
    const double now = filter.pose().covariance.determinant();
    EXPECT_GT(now, last);
    last = now;
  }
}

TEST(PoseFilterTest, WithoutOdometryTheVelocityIsLearnedFromTheMatches) {
  PoseFilter filter({}, {});
  const Eigen::Matrix3d noise =
      Eigen::Vector3d(0.03 * 0.03, 0.03 * 0.03, 0.004 * 0.004).asDiagonal();
  Pose2 truth;
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    truth = truth * arc({8.0, 0.2}, 0.1);
    filter.predictUnmeasured(0.1);
    const Pose2 seen(truth.x() + random.normal(0.03), truth.y() + random.normal(0.03),
                     truth.heading() + random.normal(0.004));
    filter.correct(fuse(filter.pose(), seen, noise));
  }
  // Half a second without a match: it is predicted with the velocity.
  filter.predictUnmeasured(0.5);
  truth = truth * arc({8.0, 0.2}, 0.5);
  EXPECT_LT((filter.pose().pose.position() - truth.position()).norm(), 0.3);
  EXPECT_DOUBLE_EQ(filter.errors().speed_scale, 0.0);
}

TEST(PoseFilterTest, AMatchThatOnlyRepeatsThePriorChangesNothing) {
  PoseFilter filter({}, {});
  filter.predictMeasured(arc({5.0, 0.1}, 0.1), 0.1);
  const PoseWithCovariance before = filter.pose();
  filter.correct(before);
  EXPECT_TRUE(filter.pose().pose.position().isApprox(before.pose.position()));
  EXPECT_TRUE(filter.pose().covariance.isApprox(before.covariance, 1e-9));
  EXPECT_DOUBLE_EQ(filter.errors().speed_scale, 0.0);
}

TEST(PoseFilterTest, AMeasuredTurnLeavesTheSpeedToTheMatches) {
  PoseFilter by_turn({}, {});
  PoseFilter unmeasured({}, {});
  for (int i = 0; i < 5; ++i) {
    by_turn.predictTurn(arc({by_turn.velocity().forward_speed, 0.1}, 0.1), 0.1);
    unmeasured.predictUnmeasured(0.1);
  }
  EXPECT_NEAR(by_turn.pose().pose.heading(), 0.05, 1e-9);
  EXPECT_NEAR(by_turn.velocity().yaw_rate, 0.1, 1e-9);
  EXPECT_EQ(by_turn.velocity().forward_speed, 0.0) << "nothing told it";
  EXPECT_NEAR(by_turn.pose().covariance(0, 0), unmeasured.pose().covariance(0, 0), 0.1)
      << "as little is known of how far it went";
  EXPECT_LT(by_turn.pose().covariance(2, 2), 0.1 * unmeasured.pose().covariance(2, 2));
  by_turn.correct({arc({4.0, 0.1}, 0.5), 1e-4 * Eigen::Matrix3d::Identity()});
  EXPECT_NEAR(by_turn.velocity().forward_speed, 4.0, 1.0) << "2 m in 0.5 s";
}

/// A filter that knows its pose, and has just measured this twist.
PoseFilter measuredAt(const Twist2& twist) {
  PoseFilter filter({}, {});
  filter.predictMeasured(arc(twist, 0.01), 0.01);
  filter.restartAt({Pose2(), 1e-6 * Eigen::Matrix3d::Identity()});
  return filter;
}

TEST(PoseFilterTest, AnOldVelocityIsHardlyInformative) {
  // Once 10 m/s; since then the matches may have seen it brake. A random walk of 3 m/s^1.5.
  const auto speedAfter = [](double age) {
    PoseFilter filter = measuredAt({4.0, 0.0});
    filter.observeVelocity({10.0, 0.0}, age);
    return filter.velocity().forward_speed;
  };
  // Variances: of the known velocity (0.1 + 0.05 * 4)^2, of the measured one (0.1 + 0.05 * 10)^2.
  EXPECT_NEAR(speedAfter(0.0), 4.0 + 6.0 * 0.09 / (0.09 + 0.36), 1e-9);
  EXPECT_NEAR(speedAfter(0.25), 4.0 + 6.0 * 0.09 / (0.09 + 0.36 + 2.25), 1e-9);
}

TEST(PoseFilterTest, AGapIsAsWideAsRandomWalksOfTheVelocity) {
  // Position of an integrated Wiener process of 3 m/s^1.5 after 2 s: 3 * sqrt(8 / 3) = 4.9 m; with
  // both ends known a quarter of that variance: 2.45 m. The noise of the odometry adds 0.6 m/s.
  PoseFilter open = measuredAt({10.0, 0.0});
  open.predictGap(2.0, std::nullopt);
  EXPECT_NEAR(open.pose().covariance(0, 0), 24.0 + std::pow(2.0 * 0.6, 2), 0.2);
  PoseFilter bounded = measuredAt({10.0, 0.0});
  bounded.predictGap(2.0, Twist2{10.0, 0.0});
  EXPECT_GT(bounded.pose().covariance(0, 0), 6.0);
  EXPECT_LT(bounded.pose().covariance(0, 0), 7.0);
  EXPECT_NEAR(bounded.pose().pose.x(), 20.0, 1e-9);
  EXPECT_GT(open.pose().covariance(2, 2), 3.0 * bounded.pose().covariance(2, 2));
}

TEST(PoseFilterTest, OverAGapTheMeanVelocityOfBothEndsHolds) {
  PoseFilter filter = measuredAt({10.0, 0.0});
  filter.predictGap(2.0, Twist2{4.0, 0.2});
  EXPECT_NEAR(filter.pose().pose.heading(), 0.2, 1e-9);
  EXPECT_NEAR(filter.pose().pose.position().norm(), 14.0, 0.1);
  EXPECT_EQ(filter.velocity().forward_speed, 4.0);
}

TEST(PoseFilterTest, ARestartKeepsTheOdometrysCalibration) {
  PoseFilter filter({}, {});
  BiasedDrive drive(0.03, degrees(0.5), 7);
  drive.run(filter, 600);
  const OdometryErrors errors = filter.errors();
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.04, 0.09, 0.01).asDiagonal();
  filter.restartAt({Pose2(5.0, 6.0, 1.0), covariance});
  EXPECT_EQ(filter.pose().pose.x(), 5.0);
  EXPECT_TRUE(filter.pose().covariance.isApprox(covariance));
  EXPECT_EQ(filter.errors().speed_scale, errors.speed_scale);
}

}  // namespace
}  // namespace datmo::pose_filter_test
