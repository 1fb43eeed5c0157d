// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/object_check.h"

#include <limits>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::object_check_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ObjectCheck, TransformTurnsPositionCovarianceAndPoints) {
  Object object = objectAt(2.0, 0.0);
  object.position_covariance = Eigen::Vector2d(4.0, 1.0).asDiagonal();
  object.points = {Point2(1.0, 0.0)};
  const Object turned = transformed(Pose2(10.0, 0.0, 0.5 * kPi), object);
  EXPECT_TRUE(turned.box.center.position().isApprox(Point2(10.0, 2.0), 1e-12));
  EXPECT_NEAR(turned.box.center.heading(), 0.5 * kPi, 1e-12);
  const Eigen::Matrix2d expected = Eigen::Vector2d(1.0, 4.0).asDiagonal();
  EXPECT_TRUE(turned.position_covariance.isApprox(expected, 1e-12));
  EXPECT_TRUE(turned.points[0].isApprox(Point2(10.0, 1.0), 1e-12));
}

TEST(ObjectCheck, TransformTurnsTheVelocity) {
  Object object = objectAt(2.0, 0.0);
  object.velocity = {Eigen::Vector2d(3.0, 0.0), Eigen::Vector2d(4.0, 1.0).asDiagonal()};
  const Object turned = transformed(Pose2(10.0, 0.0, 0.5 * kPi), object);
  ASSERT_TRUE(turned.velocity);
  EXPECT_TRUE(turned.velocity->velocity.isApprox(Point2(0.0, 3.0), 1e-12));
  const Eigen::Matrix2d expected = Eigen::Vector2d(1.0, 4.0).asDiagonal();
  EXPECT_TRUE(turned.velocity->covariance.isApprox(expected, 1e-12));
}

TEST(ObjectCheck, RefusesAnImpossibleVelocity) {
  Object object = objectAt(2.0, 0.0);
  object.velocity = MeasuredVelocity{{3.0, 0.0}, Eigen::Matrix2d::Identity()};
  EXPECT_TRUE(isValid(object));
  for (const double speed : {kNan, 1e4}) {
    object.velocity->velocity = {speed, 0.0};
    EXPECT_FALSE(isValid(object)) << speed;
  }
  object.velocity = MeasuredVelocity{{3.0, 0.0}, -Eigen::Matrix2d::Identity()};
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, AcceptsAGoodObjectAndRefusesAnAsymmetricCovariance) {
  Object object = objectAt(1.0, 2.0);
  EXPECT_TRUE(isValid(object));
  object.position_covariance << 1.0, 0.5, 0.0, 1.0;
  EXPECT_FALSE(isValid(object));
  object.position_covariance << -1.0, 0.0, 0.0, -1.0;
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, SharesAreFromZeroToOne) {
  Object object = objectAt(1.0, 2.0);
  object.moving_fraction = 1.0;
  object.class_probabilities = {0.0, 0.3, 0.0, 0.7, 0.0};
  EXPECT_TRUE(isValid(object));
  object.moving_fraction = 1000.0;  // would outweigh all other evidence of motion
  EXPECT_FALSE(isValid(object));
  object.moving_fraction = 1.0;
  object.class_probabilities = {0.0, -0.5, 0.0, 0.7, 0.0};
  EXPECT_FALSE(isValid(object));
  object.class_probabilities = {0.0, 0.7, 0.0, 0.7, 0.0};
  EXPECT_FALSE(isValid(object)) << "more than one in all";
}

TEST(ObjectCheck, ItWasSeenAboutTheTimeOfItsList) {
  Object object = objectAt(1.0, 2.0);
  object.delay = -0.1;
  EXPECT_TRUE(isValid(object));
  object.delay = 1e6;  // its present position would be arbitrary
  EXPECT_FALSE(isValid(object));
  object.delay = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, RefusesACovarianceWithoutSpread) {
  Object object = objectAt(1.0, 2.0);
  object.position_covariance.setZero();
  EXPECT_FALSE(isValid(object));
  object.position_covariance << 1.0, 1.0, 1.0, 1.0;
  EXPECT_FALSE(isValid(object)) << "semidefinite";
  object.position_covariance = kNan * Eigen::Matrix2d::Identity();
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, RefusesErrorsBeyondAKilometer) {
  for (const double variance : {1e9, 1e308}) {
    Object object = objectAt(1.0, 2.0);
    object.position_covariance(1, 1) = variance;
    EXPECT_FALSE(isValid(object)) << "sums with others lose all digits: " << variance;
    object = objectAt(1.0, 2.0);
    object.velocity = MeasuredVelocity{{3.0, 0.0}, variance * Eigen::Matrix2d::Identity()};
    EXPECT_FALSE(isValid(object)) << variance;
  }
}

TEST(ObjectCheck, SidesAreKnownOrHidden) {
  Object object = objectAt(1.0, 2.0);
  object.side_variance = {0.0, kHiddenSide, 0.25, kHiddenSide};
  EXPECT_TRUE(isValid(object));
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    for (const double bad : {-0.1, kNan, -kHiddenSide, 1e308}) {
      Object spoiled = object;
      spoiled.side_variance[side] = bad;
      EXPECT_FALSE(isValid(spoiled)) << "side " << side << ": " << bad;
    }
  }
}

TEST(ObjectCheck, LogOddsAreFiniteAndTheirSumsToo) {
  Object object = objectAt(1.0, 2.0);
  object.log_odds = -12.5;
  EXPECT_TRUE(isValid(object));
  object.motion_log_odds = kNan;
  EXPECT_FALSE(isValid(object));
  object.motion_log_odds = -3.0;
  EXPECT_TRUE(isValid(object));
  object.log_odds = kNan;
  EXPECT_FALSE(isValid(object));
  for (const double bad : {std::numeric_limits<double>::infinity(), 3e38}) {
    object.log_odds = bad;
    EXPECT_FALSE(isValid(object)) << bad;
  }
}

TEST(ObjectCheck, PointsAreFinite) {
  Object object = objectAt(1.0, 2.0);
  object.points = {Point2(1.0, 2.0), Point2(1.5, 2.0)};
  EXPECT_TRUE(isValid(object));
  object.points[1].y() = kNan;
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, NothingIsLargerThanATrainOrBeyondTheEarth) {
  Object object = objectAt(1.0, 2.0);
  object.box.width = 1e6;
  EXPECT_FALSE(isValid(object));
  object = objectAt(1.0, 3e7);
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, RefusesPositionsAndSizesWhoseSquaresOverflow) {
  Object object = objectAt(1.0, 2.0);
  object.box.length = 1e200;
  EXPECT_FALSE(isValid(object));
  object = objectAt(1e200, 2.0);
  EXPECT_FALSE(isValid(object));
}

}  // namespace
}  // namespace datmo::object_check_test
