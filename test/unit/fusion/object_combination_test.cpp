// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/object_combination.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "fusion_objects.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/fusion/object/position_covariance.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo::object_combination_test {
namespace {

TEST(ObjectCombinationTest, PointsAreFusedAsInTheThesis) {
  Object a = pointObject(10.0, 2.0, 0.1);
  Object b = pointObject(11.0, 2.4, 0.1, "stereo");
  a.position_covariance << 0.04, 0.0, 0.0, 0.09;
  b.position_covariance << 1.0, 0.2, 0.2, 0.25;
  const Eigen::Matrix2d of_a = a.position_covariance.inverse();
  const Eigen::Matrix2d of_b = b.position_covariance.inverse();
  const Eigen::Matrix2d covariance = (of_a + of_b).inverse();
  const Point2 position =
      covariance * (of_a * a.box.center.position() + of_b * b.box.center.position());
  const Object fused = combined(a, b);
  EXPECT_NEAR(fused.box.center.x(), position.x(), 1e-5);
  EXPECT_NEAR(fused.box.center.y(), position.y(), 1e-5);
  EXPECT_NEAR((fused.position_covariance - covariance).norm(), 0.0, 1e-5);
  for (const double variance : fused.side_variance) {
    EXPECT_NEAR(variance, 0.0, 1e-5);
  }
}

TEST(ObjectCombinationTest, RangeOfTheOneAndBearingOfTheOtherMeet) {
  Object lidar = pointObject(20.0, 0.0, 0.1);
  Object stereo = pointObject(22.0, 0.5, 0.1, "stereo");
  lidar.position_covariance = rangeBearingCovariance(lidar.box.center.position(), 0.01, 0.01);
  stereo.position_covariance = rangeBearingCovariance(stereo.box.center.position(), 4.0, 1e-5);
  const Object fused = combined(lidar, stereo);
  EXPECT_NEAR(fused.box.center.x(), 20.0, 0.05);
  EXPECT_NEAR(fused.box.center.y(), 0.5, 0.05);
  EXPECT_LT(fused.position_covariance(0, 0), 0.01);
  EXPECT_LT(fused.position_covariance(1, 1), 0.01);
}

TEST(ObjectCombinationTest, ASideSeenByOneIsAsThatOneSawIt) {
  // The rear and the left of a car of 4 m x 2 m at 10 m; the other sees rear, left and right.
  Object lidar = boxObject(10.5, 0.5, 1.0, 1.0, 0.0004);
  hide(lidar, BoxSide::kFront);
  hide(lidar, BoxSide::kRight);
  Object stereo = boxObject(11.0, 0.0, 2.0, 2.0, 0.01, "stereo");
  hide(stereo, BoxSide::kFront);
  stereo.position_covariance = Eigen::Matrix2d::Identity() * 0.04;
  const Object fused = combined(lidar, stereo);
  const Box2& box = fused.box;
  EXPECT_NEAR(box.center.x() - 0.5 * box.length, 10.0, 0.01);
  EXPECT_NEAR(box.center.y() + 0.5 * box.width, 1.0, 0.01);
  EXPECT_NEAR(box.center.y() - 0.5 * box.width, -1.0, 0.01);
  EXPECT_EQ(fused.side_variance[sideIndex(BoxSide::kFront)], kHiddenSide);
  EXPECT_TRUE(std::isfinite(fused.side_variance[sideIndex(BoxSide::kRight)]));
  // The right side is known from the other one's size, tied by the left side to the more certain
  // position.
  const double right =
      fused.side_variance[sideIndex(BoxSide::kRight)] + fused.position_covariance(1, 1);
  const double left =
      fused.side_variance[sideIndex(BoxSide::kLeft)] + fused.position_covariance(1, 1);
  EXPECT_LT(left, 0.0104);
  EXPECT_GT(right, left);
  EXPECT_LT(right, 0.05);
  // No nearer than either certainly reports: 2 m, less the 0.1 m by which that one is less certain.
  EXPECT_NEAR(box.length, 1.9, 1e-6);
}

TEST(ObjectCombinationTest, AnUnseenSideStaysHidden) {
  Object lidar = pointObject(10.0, 0.0, 0.05);
  for (const BoxSide side : {BoxSide::kFront, BoxSide::kLeft, BoxSide::kRight}) {
    hide(lidar, side);
  }
  Object stereo = pointObject(10.5, 0.3, 0.5, "stereo");
  stereo.side_variance = lidar.side_variance;
  const Object fused = combined(lidar, stereo);
  EXPECT_TRUE(isValid(fused));
  EXPECT_EQ(fused.side_variance[sideIndex(BoxSide::kLeft)], kHiddenSide);
  EXPECT_EQ(fused.side_variance[sideIndex(BoxSide::kRight)], kHiddenSide);
  EXPECT_EQ(fused.side_variance[sideIndex(BoxSide::kFront)], kHiddenSide);
  EXPECT_NEAR(fused.box.center.y(), 0.3 * 0.0025 / (0.0025 + 0.25), 1e-6);
}

TEST(ObjectCombinationTest, BoxesThatAreAQuarterTurnApartAreOne) {
  const Object a = boxObject(10.0, 0.0, 4.0, 2.0, 0.01);
  Object b = boxObject(10.0, 0.0, 2.0, 4.0, 0.01, "stereo");
  b.box.center = Pose2(10.0, 0.0, kQuarterTurn);
  hide(b, BoxSide::kLeft);  // the end at the negative x axis
  const Object fused = combined(a, b);
  EXPECT_NEAR(fused.box.length, 4.0, 1e-3);
  EXPECT_NEAR(fused.box.width, 2.0, 1e-3);
  EXPECT_NEAR(std::abs(std::cos(fused.box.center.heading())), 1.0, 1e-6);
  const auto& sides = fused.side_variance;
  EXPECT_GT(sides[sideIndex(BoxSide::kRear)], sides[sideIndex(BoxSide::kFront)]);
}

TEST(ObjectCombinationTest, TheLengthIsAlongTheAxisOnWhichBothAgree) {
  // Seen from behind: wider than long, but both report its direction of motion.
  const Object a = boxObject(10.0, 0.0, 1.0, 2.0, 0.01);
  const Object b = boxObject(10.0, 0.0, 1.2, 2.0, 0.01, "stereo");
  const Object fused = combined(a, b);
  EXPECT_NEAR(fused.box.length, 1.1, 0.05);
  EXPECT_NEAR(fused.box.center.heading(), 0.0, 1e-6);
}

TEST(ObjectCombinationTest, HeadingsAreFusedByTheirInformation) {
  Object a = boxObject(10.0, 0.0, 4.0, 2.0, 0.01);
  Object b = boxObject(10.0, 0.0, 4.0, 2.0, 0.01, "stereo");
  b.box.center = Pose2(10.0, 0.0, 0.2);
  EXPECT_NEAR(combined(a, b).box.center.heading(), 0.1, 1e-3);
  EXPECT_NEAR(combined(a, b).heading_variance, 0.0005, 1e-5);
  b.heading_variance = kUnknownHeadingVariance;
  EXPECT_NEAR(combined(a, b).box.center.heading(), 0.0, 1e-6);
  EXPECT_NEAR(combined(a, b).heading_variance, 0.001, 1e-6);
  a.heading_variance = kUnknownHeadingVariance;
  EXPECT_EQ(combined(a, b).heading_variance, kUnknownHeadingVariance);
}

TEST(ObjectCombinationTest, OfHeadingsThatContradictEachOtherThatOfTheBetterMeasuredBoxHolds) {
  // The rear of a car, accurate to the centimeter, but its heading is ambiguous; the other sensor
  // has taken it for a corner.
  Object rear = boxObject(20.0, 0.0, 0.0, 1.8, 0.0025);
  rear.heading_variance = kUnknownHeadingVariance;
  Object corner = boxObject(20.5, 0.0, 1.3, 1.3, 0.01, "stereo");
  corner.box.center = Pose2(20.5, 0.0, 0.7);
  corner.position_covariance = Eigen::Matrix2d::Identity() * 0.25;
  const Object fused = combined(rear, corner);
  EXPECT_NEAR(std::cos(fused.box.center.heading()), 1.0, 1e-6);
  EXPECT_EQ(fused.heading_variance, rear.heading_variance);
  EXPECT_NEAR(fused.box.center.x() - 0.5 * fused.box.length, 20.0, 0.05);
  // A post has no meaningful heading.
  Object post = rear;
  post.box.width = 0.1;
  EXPECT_NEAR(combined(post, corner).box.center.heading(), 0.7, 1e-6);
}

TEST(ObjectCombinationTest, EndsOfABoxThatIsTurnedFarAreNoFarSides) {
  // A short line of points across the line of sight with visible ends, and nothing visible behind
  // it; the other sensor sees the corner of a car.
  Object line = boxObject(20.0, 0.0, 0.0, 0.6, 0.01);
  hide(line, BoxSide::kFront);
  Object car = boxObject(22.0, 0.0, 4.0, 1.8, 0.01, "stereo");
  car.box.center = Pose2(22.0, 0.0, 0.5);
  hide(car, BoxSide::kFront);
  hide(car, BoxSide::kRight);
  const Object fused = combined(line, car);
  ASSERT_NEAR(fused.box.center.heading(), 0.5, 1e-6);
  EXPECT_EQ(fused.side_variance[sideIndex(BoxSide::kFront)], kHiddenSide);
  // The corner that extends farthest to the right belongs to the line's hidden side.
  EXPECT_EQ(fused.side_variance[sideIndex(BoxSide::kRight)], kHiddenSide);
  EXPECT_TRUE(std::isfinite(fused.side_variance[sideIndex(BoxSide::kRear)]));
  EXPECT_TRUE(std::isfinite(fused.side_variance[sideIndex(BoxSide::kLeft)]));
}

TEST(ObjectCombinationTest, TheMoreCertainOneDecidesTheDirection) {
  Object a = boxObject(10.0, 0.0, 4.0, 2.0, 0.01);
  Object b = boxObject(10.0, 0.0, 4.0, 2.0, 0.01, "stereo");
  b.box.center = Pose2(10.0, 0.0, kPi);
  b.heading_variance = 1e-4;
  EXPECT_NEAR(std::cos(combined(a, b).box.center.heading()), -1.0, 1e-6);
  b.heading_variance = 1e-2;
  EXPECT_NEAR(std::cos(combined(a, b).box.center.heading()), 1.0, 1e-6);
}

TEST(ObjectCombinationTest, OrderDoesNotMatter) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Object a = boxObject(20.0 + random.normal(0.3), random.normal(0.3), random.uniform(0.0, 5.0),
                         random.uniform(0.0, 2.0), random.uniform(0.0, 0.1));
    Object b = boxObject(20.0, 0.0, 4.0, 2.0, random.uniform(0.0, 0.5), "stereo");
    a.box.center = Pose2(a.box.center.position(), random.uniform(-kPi, kPi));
    b.box.center = Pose2(b.box.center.position(), random.uniform(-kPi, kPi));
    b.heading_variance = 0.02;
    for (std::size_t side = 0; side < kBoxSides; ++side) {
      a.side_variance[side] = random.chance(0.4) ? kHiddenSide : a.side_variance[side];
      b.side_variance[side] = random.chance(0.4) ? kHiddenSide : b.side_variance[side];
    }
    const Object one = combined(a, b);
    const Object other = combined(b, a);
    ASSERT_TRUE(isValid(one));
    EXPECT_NEAR((one.box.center.position() - other.box.center.position()).norm(), 0.0, 1e-6);
    EXPECT_NEAR(std::cos(one.box.center.heading() - other.box.center.heading()), 1.0, 1e-9);
    EXPECT_NEAR(one.box.length, other.box.length, 1e-6);
    EXPECT_NEAR((one.position_covariance - other.position_covariance).norm(), 0.0, 1e-6);
    EXPECT_NEAR(one.delay, other.delay, 1e-9);
    EXPECT_EQ(one.sensors, other.sensors);
  }
}

TEST(ObjectCombinationTest, TheTimeIsWeightedAsThePosition) {
  // Both measure an object at 10 m/s exactly where it was at their time.
  Object a = pointObject(10.0, 0.0, 0.3);
  Object b = pointObject(9.5, 0.0, 0.1, "stereo");
  b.delay = -0.05;
  const Object fused = combined(a, b);
  EXPECT_NEAR(fused.delay, -0.045, 1e-6);
  EXPECT_NEAR(fused.box.center.x(), 10.0 + 10.0 * fused.delay, 1e-6);
}

TEST(ObjectCombinationTest, VelocitiesAreFusedByTheirInformation) {
  Object a = pointObject(10.0, 2.0, 0.1);
  Object b = pointObject(10.0, 2.0, 0.1, "stereo");
  EXPECT_FALSE(combined(a, b).velocity);
  a.velocity = MeasuredVelocity{{2.0, 0.0}, Eigen::Matrix2d::Identity()};
  for (const Object& fused : {combined(a, b), combined(b, a)}) {
    ASSERT_TRUE(fused.velocity);
    EXPECT_EQ(fused.velocity->velocity, a.velocity->velocity);
  }
  b.velocity = MeasuredVelocity{{6.0, 0.0}, 3.0 * Eigen::Matrix2d::Identity()};
  const Object fused = combined(a, b);
  ASSERT_TRUE(fused.velocity);
  EXPECT_NEAR(fused.velocity->velocity.x(), 3.0, 1e-12);
  EXPECT_NEAR(fused.velocity->covariance(0, 0), 0.75, 1e-12);
}

TEST(ObjectCombinationTest, EvidenceOfTheRoadCountsOnce) {
  Object a = pointObject(10.0, 2.0, 0.1);
  Object b = pointObject(10.0, 2.0, 0.1, "stereo");
  a.motion_log_odds = -2.0;
  EXPECT_EQ(combined(a, b).motion_log_odds, -2.0);
  b.motion_log_odds = -2.0;
  EXPECT_EQ(combined(a, b).motion_log_odds, -2.0);
}

TEST(ObjectCombinationTest, MovingWinsThenStatic) {
  using State = DynamicState;
  const std::vector<std::pair<std::array<State, 2>, State>> cases = {
      {{State::kMoving, State::kStatic}, State::kMoving},
      {{State::kUnknown, State::kMoving}, State::kMoving},
      {{State::kUnknown, State::kStatic}, State::kStatic},
      {{State::kUnknown, State::kUnknown}, State::kUnknown}};
  for (const auto& [states, expected] : cases) {
    Object a = pointObject(10.0, 0.0, 0.1);
    Object b = pointObject(10.0, 0.0, 0.1, "stereo");
    a.dynamic_state = states[0];
    b.dynamic_state = states[1];
    EXPECT_EQ(combined(a, b).dynamic_state, expected);
    EXPECT_EQ(combined(b, a).dynamic_state, expected);
  }
}

TEST(ObjectCombinationTest, TheRestOfBothIsKept) {
  Object a = pointObject(10.0, 0.0, 0.1, "stereo");
  Object b = pointObject(10.0, 0.0, 0.1, "lidar");
  a.points = {{10.0, 0.1}};
  b.points = {{10.0, -0.1}, {10.0, 0.0}};
  a.height = 1.5;
  b.moving_fraction = 0.8;
  a.log_odds = 0.5;
  b.log_odds = -0.2;
  a.motion_log_odds = -3.0;
  const Object fused = combined(a, b);
  EXPECT_EQ(fused.sensors, (std::vector<std::string>{"lidar", "stereo"}));
  EXPECT_EQ(fused.height, 1.5);
  EXPECT_EQ(fused.moving_fraction, 0.8);
  EXPECT_DOUBLE_EQ(fused.log_odds, 0.3);
  EXPECT_DOUBLE_EQ(fused.motion_log_odds, -3.0) << "one of them alone knows the road";
  EXPECT_EQ(combined(fused, a).sensors, fused.sensors);
}

TEST(ObjectCombinationTest, PointsAreThoseOfTheMostAccurateSource) {
  Object camera = pointObject(10.0, 0.0, 0.5, "stereo");
  Object scanner = pointObject(10.0, 0.0, 0.1, "lidar");
  camera.points = {{9.0, 0.1}, {11.0, 0.0}};
  EXPECT_EQ(combined(camera, scanner).points, camera.points) << "the scanner gave none";
  scanner.points = {{10.0, 0.0}};
  EXPECT_EQ(combined(camera, scanner).points, scanner.points);
  EXPECT_EQ(combined(scanner, camera).points, scanner.points);
}

}  // namespace
}  // namespace datmo::object_combination_test
