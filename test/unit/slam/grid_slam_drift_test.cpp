// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "yard.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::grid_slam_drift_test {
namespace {

/// Drives a gentle curve with odometry, or is stationary, 10 scans per second.
class Vehicle {
 public:
  SlamResult step(GridSlam& slam, const Twist2& twist) {
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds_), measured(twist)});
    pose_ = pose_ * arc(twist, 0.1);
    const SlamResult result = slam.process(Yard().scan(pose_, seconds_));
    seconds_ += 0.1;
    return result;
  }

  /// The same without a hit in any of the scans.
  SlamResult blind(GridSlam& slam, const Twist2& twist, int scans) {
    SlamResult result;
    for (int i = 0; i < scans; ++i) {
      slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds_), measured(twist)});
      pose_ = pose_ * arc(twist, 0.1);
      Scan scan = Yard().scan(pose_, seconds_);
      scan.rays.clear();
      result = slam.process(scan);
      seconds_ += 0.1;
    }
    return result;
  }

  SlamResult go(GridSlam& slam, const Twist2& twist, int scans) {
    SlamResult result;
    for (int i = 0; i < scans; ++i) {
      result = step(slam, twist);
    }
    return result;
  }

  /// From now on odometry has this additional error.
  void errOdometry(const Twist2& error) { odometry_error_ = error; }

  /// m.
  double distanceFrom(const SlamResult& result) const { return errorOf(result).head<2>().norm(); }

  /// Normalized squared error of the pose since the start; three degrees of freedom.
  double neesOf(const SlamResult& result) const {
    const Eigen::Matrix3d covariance = result.labeled_scan.base_in_map.covariance + result.drift;
    const Eigen::Vector3d error = errorOf(result);
    return error.dot(covariance.llt().solve(error));
  }

 private:
  Twist2 measured(const Twist2& twist) const {
    return {twist.forward_speed + odometry_error_.forward_speed,
            twist.yaw_rate + odometry_error_.yaw_rate};
  }
  Eigen::Vector3d errorOf(const SlamResult& result) const {
    const Pose2& estimate = result.labeled_scan.base_in_map.pose;
    return {estimate.x() - pose_.x(), estimate.y() - pose_.y(),
            angleBetween(pose_.heading(), estimate.heading())};
  }

  Twist2 odometry_error_;
  Pose2 pose_;
  double seconds_ = 0.0;
};

TEST(GridSlamDriftTest, TheMapDriftsWithTheDistance) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle;
  EXPECT_TRUE(vehicle.step(slam, {}).drift.isZero());
  const SlamResult half = vehicle.go(slam, {4.0, 0.05}, 30);
  const SlamResult end = vehicle.go(slam, {4.0, 0.05}, 30);
  EXPECT_GT(half.drift(2, 2), 0.0);
  EXPECT_GT(end.drift(2, 2), half.drift(2, 2));
  EXPECT_GT(end.drift(1, 1), 2.0 * half.drift(1, 1)) << "the heading's error leads aside";
  EXPECT_LT(end.drift(2, 2), square(degrees(2.0)));
  const auto local = [](const SlamResult& result) {
    return result.labeled_scan.base_in_map.covariance(2, 2);
  };
  EXPECT_LT(local(end), 2.0 * local(half)) << "in the map as it is nothing grows";
}

TEST(GridSlamDriftTest, AtRestItDoesNot) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle;
  const SlamResult end = vehicle.go(slam, {4.0, 0.05}, 60);
  const SlamResult rest = vehicle.go(slam, {}, 200);
  EXPECT_NEAR(rest.drift(2, 2), end.drift(2, 2), 0.1 * end.drift(2, 2));
}

TEST(GridSlamDriftTest, DistanceDrivenWithoutAMatchStaysUncertain) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle;
  vehicle.go(slam, {4.0, 0.0}, 20);
  const SlamResult before = vehicle.blind(slam, {4.0, 0.0}, 10);
  const SlamResult after = vehicle.go(slam, {4.0, 0.0}, 2);
  ASSERT_TRUE(after.match.accepted);
  const auto sinceStart = [](const SlamResult& result) {
    return result.labeled_scan.base_in_map.covariance(0, 0) + result.drift(0, 0);
  };
  EXPECT_GT(sinceStart(after), 0.9 * sinceStart(before));
}

TEST(GridSlamDriftTest, ItCoversTheErrorOfAGapWithOnlyBiasedOdometry) {
  // Errors of 4 % of the speed and 1 degree/s, unknown to the SLAM, and 2 s without a hit.
  double nees = 0.0;
  const std::vector<Twist2> errors = {
      {0.16, degrees(1.0)}, {-0.16, degrees(1.0)}, {0.16, degrees(-1.0)}, {-0.16, degrees(-1.0)}};
  for (const Twist2& error : errors) {
    GridSlam slam{GridSlamOptions{}};
    Vehicle vehicle;
    vehicle.go(slam, {4.0, 0.0}, 20);
    vehicle.errOdometry(error);
    const SlamResult blind = vehicle.blind(slam, {4.0, 0.0}, 20);
    const SlamResult after = vehicle.go(slam, {4.0, 0.0}, 5);
    ASSERT_TRUE(after.match.accepted);
    EXPECT_GT(vehicle.distanceFrom(blind), 0.15) << "the gap has done something";
    const double own = vehicle.neesOf(after);
    EXPECT_LT(own, 11.3) << "99 % of chi-square with three degrees of freedom";
    nees += own / static_cast<double>(errors.size());
  }
  EXPECT_LT(nees, 6.0);
}

TEST(GridSlamDriftTest, AResetForgetsIt) {
  GridSlam slam{GridSlamOptions{}};
  Vehicle().go(slam, {4.0, 0.05}, 30);
  slam.reset();
  EXPECT_TRUE(Vehicle().step(slam, {}).drift.isZero());
}

}  // namespace
}  // namespace datmo::grid_slam_drift_test
