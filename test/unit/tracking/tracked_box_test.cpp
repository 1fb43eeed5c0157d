#include "datmo_fusion/tracking/tracked_box.h"

#include <cmath>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

Object boxOf(double heading, double length, double width) {
  Object object = objectAt(0.0, 0.0);
  object.box = {Pose2(0.0, 0.0, heading), length, width};
  object.heading_variance = 0.01;
  return object;
}

double headingOf(const TrackedBox& box) { return box.at(Point2::Zero()).centre.heading(); }

TEST(TrackedBox, FollowsALargerSizeQuicklyAndASmallerOneSlowly) {
  const TrackedBoxOptions options;
  TrackedBox box(boxOf(0.0, 1.0, 0.5));
  box.update(boxOf(0.0, 4.0, 2.0), options.growth_time, options);
  const double grown = 4.0 - 3.0 * std::exp(-1.0);
  EXPECT_NEAR(box.at(Point2::Zero()).length, grown, 1e-9);
  EXPECT_NEAR(box.at(Point2::Zero()).width, 2.0 - 1.5 * std::exp(-1.0), 1e-9);
  box.update(boxOf(0.0, 1.0, 2.0), options.growth_time, options);
  EXPECT_NEAR(box.at(Point2::Zero()).length,
              1.0 + (grown - 1.0) * std::exp(-options.growth_time / options.shrink_time), 1e-9);
}

TEST(TrackedBox, TheRearOfACarIsItsWidth) {
  const TrackedBoxOptions options;
  TrackedBox box(boxOf(0.0, 4.5, 1.8));
  box.update(boxOf(0.5 * kPi, 1.8, 0.1), 0.1, options);
  EXPECT_NEAR(box.at(Point2::Zero()).width, 1.8, 1e-9);
  EXPECT_GT(box.at(Point2::Zero()).length, 4.3);
}

TEST(TrackedBox, AHiddenPartMakesThePlaceUncertainAlongItselfOnly) {
  const TrackedBox box(boxOf(0.5 * kPi, 4.0, 2.0));
  const Object part = boxOf(0.5 * kPi, 1.0, 2.0);
  const Eigen::Matrix2d added = box.measurementOf(part).covariance - part.position_covariance;
  EXPECT_NEAR(added(0, 0), 0.0, 1e-9);
  EXPECT_NEAR(added(1, 1), 3.0 * 3.0 / 12.0, 1e-9);
  EXPECT_TRUE(box.measurementOf(boxOf(0.5 * kPi, 4.0, 2.0))
                  .covariance.isApprox(part.position_covariance, 1e-12));
}

TEST(TrackedBox, HeadingDoesNotFlipWithTheObjects) {
  const TrackedBoxOptions options;
  TrackedBox box(boxOf(0.1, 4.0, 2.0));
  for (int i = 0; i < 20; ++i) {
    box.predict(0.1, options);
    box.update(boxOf(normalizeAngle(0.1 + (i % 2 == 0 ? kPi : 0.0)), 4.0, 2.0), 0.1, options);
  }
  EXPECT_NEAR(headingOf(box), 0.1, 1e-6);
}

TEST(TrackedBox, MotionTellsTheLengthFromTheWidth) {
  const TrackedBoxOptions options;
  TrackedBox box(boxOf(0.0, 1.8, 0.3));
  box.followVelocity(Eigen::Vector2d(0.0, 5.0), Eigen::Matrix2d::Identity() * 0.01, options);
  EXPECT_NEAR(headingOf(box), 0.5 * kPi, 1e-6);
  EXPECT_NEAR(box.at(Point2::Zero()).length, 0.3, 1e-12);
  EXPECT_NEAR(box.at(Point2::Zero()).width, 1.8, 1e-12);
}

TEST(TrackedBox, MotionGivesTheSignAndReversingKeepsIt) {
  const TrackedBoxOptions options;
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() * 0.01;
  TrackedBox box(boxOf(0.0, 4.0, 2.0));
  box.followVelocity(Eigen::Vector2d(-5.0, 0.0), covariance, options);
  EXPECT_NEAR(std::abs(headingOf(box)), kPi, 1e-6);
  box.followVelocity(Eigen::Vector2d(1.0, 0.0), covariance, options);
  EXPECT_NEAR(std::abs(headingOf(box)), kPi, 1e-6);
  box.followVelocity(Eigen::Vector2d(6.0, 0.0), covariance, options);
  EXPECT_NEAR(headingOf(box), 0.0, 1e-6);
}

}  // namespace
}  // namespace datmo
