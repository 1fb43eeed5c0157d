// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/point_velocity.h"

#include <limits>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::point_velocity_test {
namespace {

// Focal length times baseline: 200 px m.
const StereoRig kRig{{500.0, 500.0, 320.0, 240.0}, 0.4, 0.2, 0.5};
constexpr double kInterval = 0.1;  // s

StereoFeature project(const Eigen::Vector3d& point) {
  return {{320.0 + 500.0 * point.x() / point.z(), 240.0 + 500.0 * point.y() / point.z()},
          200.0 / point.z()};
}

/// Optical frame of a camera that faces along the fixed frame's x, turned to the left by `heading`.
Exposure exposure(double seconds, double x, double heading) {
  Exposure result;
  result.stamp = Stamp::fromSeconds(seconds);
  Eigen::Matrix3d optical_in_base;
  optical_in_base << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  result.camera_in_fixed.linear() =
      Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * optical_in_base;
  result.camera_in_fixed.translation() = Eigen::Vector3d(x, 0.0, 1.2);
  return result;
}

const Exposure kEarlier = exposure(10.0, 0.0, 0.0);
const Exposure kLater = exposure(10.0 + kInterval, 1.0, 0.02);  // 10 m/s, in a bend

StereoFeature seen(const Eigen::Vector3d& point, const Exposure& from) {
  return project(from.camera_in_fixed.inverse() * point);
}

/// The measured velocity of a point of the fixed frame, with the pair's noise.
PointVelocity measured(const Eigen::Vector3d& point, const Eigen::Vector3d& velocity,
                       Random& random) {
  StereoFeature from = seen(point, kEarlier);
  StereoFeature to = seen(point + kInterval * velocity, kLater);
  from.disparity += random.normal(kRig.disparity_sigma);
  to.disparity += random.normal(kRig.disparity_sigma);
  to.pixel += Eigen::Vector2d(random.normal(kRig.flow_sigma), random.normal(kRig.flow_sigma));
  return pointVelocity(kRig, from, kEarlier, to, kLater).value();
}

/// Features of an object as large as a pedestrian, this far ahead.
std::vector<PointVelocity> pedestrian(double distance, const Eigen::Vector3d& velocity, int count,
                                      Random& random) {
  std::vector<PointVelocity> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d point(distance, random.uniform(-0.3, 0.3), random.uniform(0.2, 1.7));
    points.push_back(measured(point, velocity, random));
  }
  return points;
}

/// With a known center.
BodyCenter centerAt(double distance) { return {{distance, 0.0}, Eigen::Matrix2d::Zero()}; }

/// With independent errors only.
std::vector<PointVelocity> independent(std::vector<PointVelocity> points) {
  for (PointVelocity& point : points) {
    point.common_covariance.setZero();
  }
  return points;
}

TEST(PointVelocity, IsAsComputedByHand) {
  Exposure earlier;  // the optical frame itself
  Exposure later;
  later.stamp = earlier.stamp + kInterval;
  // 20 m ahead, 0.15 m to the right within 0.1 s: 3.75 px.
  const auto result =
      pointVelocity(kRig, {{320.0, 240.0}, 10.0}, earlier, {{323.75, 240.0}, 10.0}, later);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->position.isApprox(Eigen::Vector3d(0.15, 0.0, 20.0), 1e-9));
  EXPECT_TRUE(result->velocity.isApprox(Eigen::Vector3d(1.5, 0.0, 0.0), 1e-9));
  // To the side: 20 m / 500 px * 0.2 px = 8 mm of flow, 0.15 m / 10 px * 0.5 px = 7.5 mm of depth.
  EXPECT_NEAR(result->covariance(0, 0), 0.08 * 0.08 + 0.075 * 0.075, 1e-9);
  EXPECT_NEAR(result->covariance(1, 1), 0.08 * 0.08, 1e-9);
  // Along the line of sight: 20 m / 10 px * 0.5 px = 1 m, twice.
  EXPECT_NEAR(result->covariance(2, 2), 200.0, 1e-9);
}

TEST(PointVelocity, OwnMotionIsCompensated) {
  const Eigen::Vector3d point(15.0, 3.0, 0.7);
  const auto result =
      pointVelocity(kRig, seen(point, kEarlier), kEarlier, seen(point, kLater), kLater);
  ASSERT_TRUE(result);
  EXPECT_LT(result->velocity.norm(), 1e-6);
  EXPECT_TRUE(result->position.isApprox(point, 1e-9));
}

TEST(PointVelocity, OfAStaticSceneIsZeroWithinItsCovariance) {
  constexpr int kPoints = 4000;
  Random random(1);
  double squared_errors = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d point(random.uniform(6.0, 10.0), random.uniform(-3.0, 3.0),
                                random.uniform(0.0, 2.0));
    const PointVelocity point_velocity = measured(point, Eigen::Vector3d::Zero(), random);
    squared_errors +=
        point_velocity.velocity.dot(point_velocity.covariance.inverse() * point_velocity.velocity);
  }
  EXPECT_NEAR(squared_errors / kPoints, 3.0, 0.2) << "mean NEES of three dimensions";
}

TEST(PointVelocity, BadInputGivesNothing) {
  const StereoFeature feature{{320.0, 240.0}, 10.0};
  const StereoFeature far{{320.0, 240.0}, 1.4};  // less than 3 * 0.5 px
  const StereoFeature hole{{320.0, 240.0}, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FALSE(pointVelocity(kRig, far, kEarlier, feature, kLater));
  EXPECT_FALSE(pointVelocity(kRig, feature, kEarlier, hole, kLater));
  EXPECT_FALSE(pointVelocity(kRig, feature, kEarlier, feature, kEarlier)) << "no time between";
  EXPECT_FALSE(pointVelocity(kRig, feature, kLater, feature, kEarlier)) << "time runs back";
  StereoRig no_baseline = kRig;
  no_baseline.baseline = 0.0;
  EXPECT_THROW(pointVelocity(no_baseline, feature, kEarlier, feature, kLater),
               std::invalid_argument);
}

TEST(SharedVelocity, APedestrianAt20MetersRevealsItsWalkInOnePair) {
  Random random(2);
  const auto shared = sharedVelocity(pedestrian(20.0, {0.0, 1.4, 0.0}, 20, random), centerAt(20.0),
                                     SharedVelocityOptions());
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->velocity.y(), 1.4, 0.3);
  EXPECT_GT(1.4 * 1.4 / shared->covariance(1, 1), 9.0) << "three standard deviations";
}

TEST(SharedVelocity, CovarianceIsConsistentWithOutliers) {
  SharedVelocityOptions rigid;
  rigid.turn_rate = 0.0;
  constexpr int kObjects = 400;
  const Eigen::Vector3d velocity(1.0, 1.0, 0.0);
  Random random(3);
  double squared_errors = 0.0;
  for (int i = 0; i < kObjects; ++i) {
    auto points = independent(pedestrian(8.0, velocity, 16, random));
    const auto background = pedestrian(9.0, {-10.0, 15.0, 0.0}, 4, random);
    points.insert(points.end(), background.begin(), background.end());
    const auto shared = sharedVelocity(points, centerAt(8.0), rigid);
    ASSERT_TRUE(shared);
    EXPECT_NEAR(shared->inliers, 16.0, 2.0);
    const Eigen::Vector2d error = shared->velocity - velocity.head<2>();
    squared_errors += error.dot(shared->covariance.inverse() * error);
  }
  const double nees = squared_errors / kObjects;
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 3.0);
}

TEST(SharedVelocity, CommonErrorsDoNotAverageOut) {
  Random random(4);
  auto points = independent(pedestrian(8.0, Eigen::Vector3d::Zero(), 20, random));
  const auto own = sharedVelocity(points, centerAt(8.0), SharedVelocityOptions());
  for (PointVelocity& point : points) {
    point.common_covariance = 0.25 * Eigen::Matrix3d::Identity();
  }
  const auto common = sharedVelocity(points, centerAt(8.0), SharedVelocityOptions());
  ASSERT_TRUE(own && common);
  const Eigen::Matrix2d expected = own->covariance + 0.25 * Eigen::Matrix2d::Identity();
  EXPECT_TRUE(common->covariance.isApprox(expected));
}

/// The rear of a van, seen from behind: its points move sideways while it turns about its middle.
std::vector<PointVelocity> turningRear(double speed, double turn_rate, int count, Random& random) {
  constexpr double kRear = 12.0;
  constexpr double kMiddle = 14.5;
  std::vector<PointVelocity> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d point(kRear, random.uniform(-0.9, 0.9), random.uniform(0.4, 1.8));
    points.push_back(measured(
        point, {speed - turn_rate * point.y(), turn_rate * (kRear - kMiddle), 0.0}, random));
  }
  return independent(points);
}

TEST(SharedVelocity, OfATurningBodyIsThatOfItsCenterAndConsistent) {
  constexpr int kBodies = 400;
  constexpr double kHiddenMiddle = 1.3;
  Random random(6);
  BodyCenter center{{14.5, 0.0}, Eigen::Matrix2d::Zero()};
  center.covariance(0, 0) = kHiddenMiddle * kHiddenMiddle;
  SharedVelocityOptions options;
  double squared_errors = 0.0;
  for (int i = 0; i < kBodies; ++i) {
    // Its middle differs from the box's.
    const double hidden = random.normal(kHiddenMiddle);
    const double turn_rate = random.normal(options.turn_rate);
    const auto shared = sharedVelocity(turningRear(5.0, turn_rate, 12, random), center, options);
    ASSERT_TRUE(shared);
    const Eigen::Vector2d error = shared->velocity - Eigen::Vector2d(5.0, turn_rate * hidden);
    squared_errors += error.dot(shared->covariance.inverse() * error);
  }
  const double nees = squared_errors / kBodies;
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 3.0);
}

TEST(SharedVelocity, StationaryBodiesDoNotTurnAndSlowOnesTurnLittle) {
  PointVelocity point;
  point.position = {12.0, 0.0, 1.0};
  point.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  const auto acrossVariance = [&](double speed) {
    point.velocity.x() = speed;
    const std::vector<PointVelocity> points(4, point);
    return sharedVelocity(points, centerAt(14.0), SharedVelocityOptions())->covariance(1, 1);
  };
  EXPECT_NEAR(acrossVariance(0.0), 0.25e-4, 1e-6);
  EXPECT_NEAR(acrossVariance(0.5), 0.25e-4 + 0.05 * 0.05 * 4.0, 1e-4) << "0.1 / m x 0.5 m/s";
  EXPECT_NEAR(acrossVariance(20.0), 0.25e-4 + 0.2 * 0.2 * 4.0, 1e-4) << "0.2 rad/s";
}

TEST(SharedVelocity, ErrorProbabilityFallsWithAgreement) {
  EXPECT_FALSE(sharedVelocity({}, centerAt(8.0), SharedVelocityOptions())) << "of nothing";
  const auto wrongOf = [](int points) {
    Random random(5);
    return sharedVelocity(pedestrian(8.0, Eigen::Vector3d::Zero(), points, random), centerAt(8.0),
                          SharedVelocityOptions())
        ->wrong_probability;
  };
  EXPECT_NEAR(wrongOf(1), 0.2, 0.01) << "the share of outliers";
  EXPECT_NEAR(wrongOf(2), 0.04, 0.004);
}

TEST(SharedVelocity, OptionsOutOfRangeAreRefused) {
  SharedVelocityOptions options;
  options.outlier_share = 1.0;
  EXPECT_THROW(sharedVelocity({}, centerAt(8.0), options), std::invalid_argument);
  options = {};
  options.max_speed = 0.0;
  EXPECT_THROW(sharedVelocity({}, centerAt(8.0), options), std::invalid_argument);
}

}  // namespace
}  // namespace datmo::point_velocity_test
