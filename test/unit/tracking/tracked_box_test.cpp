// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/tracked_box.h"

#include <cmath>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::tracked_box_test {
namespace {

constexpr double kSideVariance = 0.01;

/// All four sides are visible.
Object wholeBox(double heading, double length, double width) {
  Object object = objectAt(0.0, 0.0);
  object.box = {Pose2(0.0, 0.0, heading), length, width};
  object.heading_variance = 0.001;
  object.side_variance.fill(kSideVariance);
  return object;
}

/// The rear of a car 1.8 m wide, seen from behind: across x, as scanners report it along the longer
/// side.
Object rearAt(double x) {
  Object object = wholeBox(0.5 * kPi, 1.8, 0.0);
  object.box.center = Pose2(x, 0.0, 0.5 * kPi);
  object.side_variance[static_cast<std::size_t>(BoxSide::kRight)] = kHiddenSide;  // at larger x
  return object;
}

/// Its front, seen from ahead: the same line, but the car extends to smaller x.
Object frontAt(double x) {
  Object object = rearAt(x);
  std::swap(object.side_variance[static_cast<std::size_t>(BoxSide::kRight)],
            object.side_variance[static_cast<std::size_t>(BoxSide::kLeft)]);
  return object;
}

double headingOf(const TrackedBox& box) { return box.at(Point2::Zero()).center.heading(); }

TrackedBox convergedOn(const Object& object, const TrackedBoxOptions& options, int scans = 30) {
  TrackedBox box(object, options);
  for (int i = 0; i < scans; ++i) {
    box.predict(0.1, options);
    box.update(object, 0.1, options);
  }
  return box;
}

const Eigen::Matrix2d kVelocityCovariance = Eigen::Matrix2d::Identity();

/// A car that is seen from behind while it drives along x.
TrackedBox drivingAhead(const TrackedBoxOptions& options) {
  TrackedBox box(rearAt(10.0), options);
  for (int i = 0; i < 30; ++i) {
    box.predict(0.1, options);
    box.update(rearAt(10.0), 0.1, options);
    box.followVelocity(Eigen::Vector2d(6.0, 0.0), kVelocityCovariance, options);
  }
  return box;
}

TEST(TrackedBox, SizeConvergesToTheMeasurements) {
  const TrackedBoxOptions options;
  const TrackedBox box = convergedOn(wholeBox(0.3, 4.9, 2.0), options);
  EXPECT_NEAR(box.at(Point2::Zero()).length, 4.9, 0.02);
  EXPECT_NEAR(box.at(Point2::Zero()).width, 2.0, 0.02);
  EXPECT_LT(std::sqrt(box.sizeVariance().maxCoeff()), 0.08) << "2.5 scans of 0.1 s are as one";
}

TEST(TrackedBox, BetweenTwoSidesTheCenterIsMeasuredByBoth) {
  const TrackedBoxOptions options;
  Object object = wholeBox(0.0, 4.9, 2.0);
  const TrackedBox box(object, options);
  const PositionMeasurement measured = box.measurementOf(object);
  EXPECT_TRUE(measured.position.isZero(1e-12));
  // Mean of two sides, each with half the weight.
  EXPECT_NEAR(measured.covariance(0, 0), object.position_covariance(0, 0) + 0.5 * kSideVariance,
              1e-9);
  EXPECT_NEAR(box.centerCovariance()(0, 0), 0.0, 1e-9) << "the size does not matter to it";
}

TEST(TrackedBox, OfTwoSidesTheMoreCertainOneCountsMoreIfTheSizeIsKnown) {
  const TrackedBoxOptions options;
  const TrackedBox box = convergedOn(wholeBox(0.0, 4.4, 1.8), options, 200);
  Object object = wholeBox(0.0, 4.0, 1.8);  // the front appears nearer than it is
  object.side_variance[static_cast<std::size_t>(BoxSide::kFront)] = 1.0;
  const PositionMeasurement measured = box.measurementOf(object);
  // 2 m behind the measured center is the rear, and 2.2 m ahead of that the center.
  EXPECT_NEAR(measured.position.x(), 0.2, 0.02);
  EXPECT_LT(measured.covariance(0, 0) - object.position_covariance(0, 0), 1.2 * kSideVariance);
}

TEST(TrackedBox, BehindOneSideTheCenterIsHalfTheSizeAway) {
  const TrackedBoxOptions options;
  const TrackedBox box = drivingAhead(options);
  const double depth = box.at(Point2::Zero()).length;
  const PositionMeasurement measured = box.measurementOf(rearAt(10.0));
  EXPECT_NEAR(measured.position.x(), 10.0 + 0.5 * depth, 1e-9);
  EXPECT_NEAR(measured.position.y(), 0.0, 1e-9);
  EXPECT_NEAR(depth, options.size.vehicle.length, 0.6);
  // The unknown length is the same in every scan: no noise, but a part of the covariance.
  EXPECT_NEAR(measured.covariance(0, 0), rearAt(10.0).position_covariance(0, 0) + kSideVariance,
              1e-9);
  EXPECT_NEAR(box.centerCovariance()(0, 0), 0.25 * box.sizeVariance().maxCoeff(), 1e-9);
  EXPECT_GT(box.centerCovariance()(0, 0), 0.2 * 0.2);
}

TEST(TrackedBox, TheOtherSideIsTrustedOnlyAsFarAsTheSizeIsKnown) {
  const TrackedBoxOptions options;
  TrackedBox box = convergedOn(rearAt(10.0), options);
  const double unknown = box.sizeVariance().maxCoeff();
  const double before = box.measurementOf(rearAt(10.0)).covariance(0, 0);
  const Object front = frontAt(14.0);
  EXPECT_NEAR(box.measurementOf(front).covariance(0, 0), before + unknown, 1e-9)
      << "half the size's error to the other half";
  for (int i = 0; i < 20; ++i) {
    box.update(front, 0.1, options);
  }
  EXPECT_NEAR(box.measurementOf(front).covariance(0, 0), before, 1e-3)
      << "by then the filter's center rests on the front";
}

TEST(TrackedBox, WithNeitherSideSeenItIsAnywhereInTheRemainingLength) {
  const TrackedBoxOptions options;
  const TrackedBox box = convergedOn(wholeBox(0.0, 4.4, 1.8), options, 200);
  Object middle = wholeBox(0.0, 1.4, 1.8);
  middle.side_variance[static_cast<std::size_t>(BoxSide::kFront)] = kHiddenSide;
  middle.side_variance[static_cast<std::size_t>(BoxSide::kRear)] = kHiddenSide;
  const PositionMeasurement measured = box.measurementOf(middle);
  EXPECT_NEAR(measured.position.x(), 0.0, 1e-9);
  EXPECT_NEAR(measured.covariance(0, 0) - middle.position_covariance(0, 0), 3.0 * 3.0 / 12.0, 0.02);
}

TEST(TrackedBox, GrowthMovesTheCenterAndKeepsTheVisibleSide) {
  const TrackedBoxOptions options;
  TrackedBox box = convergedOn(rearAt(10.0), options);
  Object longer = wholeBox(0.0, 8.0, 1.8);
  longer.side_variance[static_cast<std::size_t>(BoxSide::kFront)] = kHiddenSide;
  longer.box.center = Pose2(14.0, 0.0, 0.0);
  const Point2 before = box.measurementOf(longer).position;
  const Point2 shift = box.update(longer, 0.1, options);
  const Point2 after = box.measurementOf(longer).position;
  EXPECT_GT(shift.x(), 0.3);
  EXPECT_TRUE((after - before).isApprox(shift, 1e-6))
      << "a filter that has the shift is not surprised by the next measurement";
}

TEST(TrackedBox, AHiddenEndNeverShrinksTheBox) {
  const TrackedBoxOptions options;
  TrackedBox box = convergedOn(wholeBox(0.0, 4.4, 1.8), options);
  Object part = wholeBox(0.0, 1.0, 1.8);
  part.side_variance[static_cast<std::size_t>(BoxSide::kFront)] = kHiddenSide;
  for (int i = 0; i < 50; ++i) {
    box.update(part, 0.1, options);
  }
  EXPECT_NEAR(box.at(Point2::Zero()).length, 4.4, 0.1);
}

TEST(TrackedBox, AHiddenEndIsAsUncertainAsTheRange) {
  const TrackedBoxOptions options;
  const auto lengthAfter = [&](double position_variance) {
    TrackedBox box = drivingAhead(options);
    Object smeared = rearAt(10.0);  // along the line of sight, 2 m farther than the car is long
    smeared.box.width = box.at(Point2::Zero()).length + 2.0;
    smeared.position_covariance(0, 0) = position_variance;
    for (int i = 0; i < 30; ++i) {
      box.update(smeared, 0.1, options);
    }
    return box.at(Point2::Zero()).length;
  };
  const double length = drivingAhead(options).at(Point2::Zero()).length;
  EXPECT_NEAR(lengthAfter(4.0), length, 0.1) << "noise";
  EXPECT_GT(lengthAfter(0.01), length + 1.5);
}

TEST(TrackedBox, HeadingDoesNotFlipWithTheObjects) {
  const TrackedBoxOptions options;
  TrackedBox box(wholeBox(0.1, 4.0, 2.0), options);
  for (int i = 0; i < 20; ++i) {
    box.predict(0.1, options);
    box.update(wholeBox(normalizeAngle(0.1 + (i % 2 == 0 ? kPi : 0.0)), 4.0, 2.0), 0.1, options);
    EXPECT_NEAR(headingOf(box), 0.1, 1e-6);
  }
}

TEST(TrackedBox, AFullTurnHasNoFlip) {
  const TrackedBoxOptions options;
  TrackedBox box(wholeBox(0.0, 4.4, 1.8), options);
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() * 0.01;
  box.followVelocity(Eigen::Vector2d(5.0, 0.0), covariance, options);
  for (int i = 1; i <= 150; ++i) {
    const double heading = 0.05 * i;
    // The detector gives directions of sides in (-90, 90] degrees.
    const double line = std::remainder(heading, kPi);
    box.predict(0.1, options);
    box.update(wholeBox(line, 4.4, 1.8), 0.1, options);
    box.followVelocity(5.0 * Eigen::Vector2d(std::cos(heading), std::sin(heading)), covariance,
                       options);
    EXPECT_NEAR(angleBetween(headingOf(box), heading), 0.0, 0.05) << i;
  }
}

TEST(TrackedBox, MotionDistinguishesLengthFromWidth) {
  const TrackedBoxOptions options;
  TrackedBox box(wholeBox(0.0, 1.8, 0.8), options);
  for (int i = 0; i < 10; ++i) {
    box.followVelocity(Eigen::Vector2d(0.0, 5.0), Eigen::Matrix2d::Identity() * 0.01, options);
    box.update(wholeBox(0.0, 1.8, 0.8), 0.1, options);
  }
  EXPECT_NEAR(headingOf(box), 0.5 * kPi, 0.05);
  EXPECT_TRUE(box.signKnown());
  EXPECT_NEAR(box.at(Point2::Zero()).length, 0.8, 0.1);
  EXPECT_NEAR(box.at(Point2::Zero()).width, 1.8, 0.1);
}

TEST(TrackedBox, TakingTheRearForTheFrontMovesNothing) {
  const TrackedBoxOptions options;
  TrackedBox box = drivingAhead(options);
  const PositionMeasurement before = box.measurementOf(rearAt(10.0));
  const Eigen::Matrix2d considered = box.centerCovariance();
  const Point2 shift = box.followVelocity(Eigen::Vector2d(-6.0, 0.0), kVelocityCovariance, options);
  EXPECT_NEAR(std::abs(headingOf(box)), kPi, 1e-6);
  EXPECT_TRUE(shift.isZero(0.02));
  EXPECT_TRUE(box.measurementOf(rearAt(10.0)).position.isApprox(before.position, 1e-2));
  EXPECT_TRUE(box.measurementOf(rearAt(10.0)).covariance.isApprox(before.covariance, 1e-2));
  EXPECT_TRUE(box.centerCovariance().isApprox(considered, 0.05));
}

TEST(TrackedBox, MotionGivesTheSignAndReversingKeepsIt) {
  const TrackedBoxOptions options;
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() * 0.01;
  TrackedBox box = convergedOn(wholeBox(0.0, 4.0, 2.0), options);
  EXPECT_FALSE(box.signKnown());
  box.followVelocity(Eigen::Vector2d(-5.0, 0.0), covariance, options);
  EXPECT_TRUE(box.signKnown());
  EXPECT_NEAR(std::abs(headingOf(box)), kPi, 1e-6);
  box.followVelocity(Eigen::Vector2d(1.0, 0.0), covariance, options);
  EXPECT_NEAR(std::abs(headingOf(box)), kPi, 1e-6);
  box.followVelocity(Eigen::Vector2d(6.0, 0.0), covariance, options);
  EXPECT_NEAR(headingOf(box), 0.0, 1e-6);
}

TEST(TrackedBox, TimeAtRestCountsAsNoMotion) {
  const TrackedBoxOptions options;
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() * 0.01;
  TrackedBox box = convergedOn(wholeBox(0.0, 4.0, 2.0), options);
  const auto move = [&](double speed, int steps) {
    for (int i = 0; i < steps; ++i) {
      box.predict(0.1, options);
      if (speed == 0.0) {
        box.stand();
      } else {
        box.followVelocity(Eigen::Vector2d(speed, 0.0), covariance, options);
      }
    }
  };
  box.stand();
  move(5.0, 40);
  move(0.0, 50);
  move(-1.0, 20);
  EXPECT_NEAR(headingOf(box), 0.0, 1e-6) << "it reverses, for less time than it drove ahead";
  move(-1.0, 30);
  EXPECT_NEAR(std::abs(headingOf(box)), kPi, 1e-6);
}

TEST(TrackedBox, TheVelocityGivesTheHeadingOnlyIfMoreCertain) {
  const TrackedBoxOptions options;
  const Eigen::Vector2d velocity = 5.0 * Eigen::Vector2d(std::cos(0.2), std::sin(0.2));
  TrackedBox sure = convergedOn(wholeBox(0.0, 4.4, 1.8), options);
  const double variance = sure.headingVariance();
  sure.followVelocity(velocity, Eigen::Matrix2d::Identity(), options);
  EXPECT_NEAR(headingOf(sure), 0.0, 1e-6);
  EXPECT_LE(sure.headingVariance(), variance + 1e-12);
  Object round = wholeBox(0.0, 0.6, 0.6);
  round.heading_variance = kUnknownHeadingVariance;
  TrackedBox vague(round, options);
  vague.followVelocity(velocity, Eigen::Matrix2d::Identity() * 0.01, options);
  EXPECT_NEAR(headingOf(vague), 0.2, 1e-6);
}

}  // namespace
}  // namespace datmo::tracked_box_test
