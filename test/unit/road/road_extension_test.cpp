// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_extension.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::road_extension_test {
namespace {

/// A border on the left, 4 m from the x axis, from one point along it to another.
RoadBorder leftBorder(double from, double to) {
  RoadBorder border;
  border.points = {{{from, 4.0}, 0.1}, {{to, 4.0}, 0.1}};
  return border;
}

class RoadExtensionTest : public testing::Test {
 protected:
  void update(const std::vector<RoadBorder>& borders, const Pose2& vehicle = {}) {
    RoadModel road;
    road.borders = borders;
    extension_.update(road, vehicle);
  }

  RoadExtension extension_{RoadExtensionOptions{}};
};

TEST_F(RoadExtensionTest, ABorderContinuesStraightBeyondBothEnds) {
  update({leftBorder(-5.0, 10.0)});
  EXPECT_NEAR(extension_.offset(RoadSide::kLeft, {20.0, 6.0})->outward, 2.0, 1e-9);
  EXPECT_NEAR(extension_.offset(RoadSide::kLeft, {20.0, 1.0})->outward, -3.0, 1e-9);
  EXPECT_NEAR(extension_.offset(RoadSide::kLeft, {-10.0, 6.0})->outward, 2.0, 1e-9);
}

TEST_F(RoadExtensionTest, OnTheRightOutwardIsToTheRight) {
  RoadBorder right = leftBorder(-5.0, 10.0);
  right.side = RoadSide::kRight;
  right.points[0].position.y() = -4.0;
  right.points[1].position.y() = -4.0;
  update({right});
  EXPECT_NEAR(extension_.offset(RoadSide::kRight, {20.0, -6.0})->outward, 2.0, 1e-9);
  EXPECT_NEAR(extension_.offset(RoadSide::kRight, {-10.0, -6.0})->outward, 2.0, 1e-9);
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {20.0, 6.0}));
}

TEST_F(RoadExtensionTest, NotForeverAndNotBesideTheBorderItself) {
  update({leftBorder(-5.0, 10.0)});
  EXPECT_TRUE(extension_.offset(RoadSide::kLeft, {39.0, 6.0}));
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {41.0, 6.0}));
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {5.0, 6.0}));
}

TEST_F(RoadExtensionTest, OfSeveralTheNearestEndCounts) {
  RoadBorder far = leftBorder(30.0, 40.0);
  far.points[0].position.y() = 8.0;
  far.points[1].position.y() = 8.0;
  update({leftBorder(-5.0, 10.0), far});
  EXPECT_NEAR(extension_.offset(RoadSide::kLeft, {15.0, 9.0})->outward, 5.0, 1e-9);
  EXPECT_NEAR(extension_.offset(RoadSide::kLeft, {25.0, 9.0})->outward, 1.0, 1e-9);
}

TEST_F(RoadExtensionTest, RemembersBordersBesideTheVehicle) {
  update({leftBorder(-5.0, 10.0)});
  update({}, Pose2(20.0, 0.0, 0.0));
  EXPECT_NEAR(extension_.offset(RoadSide::kLeft, {45.0, 6.0})->outward, 2.0, 1e-9);
  update({}, Pose2(51.0, 0.0, 0.0));
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {55.0, 6.0})) << "too far away";
}

TEST_F(RoadExtensionTest, AfterATurnItIsAnotherRoad) {
  update({leftBorder(-5.0, 10.0)});
  update({}, Pose2(10.0, 0.0, 0.5 * kPi));
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {20.0, 6.0}));
}

TEST_F(RoadExtensionTest, ABorderAheadWasNotBesideTheVehicle) {
  update({leftBorder(5.0, 10.0)});
  update({});
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {20.0, 6.0}));
}

TEST_F(RoadExtensionTest, SideStreetsAreNotExtended) {
  RoadBorder street = leftBorder(-5.0, 10.0);
  street.side_street = true;
  update({street});
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {20.0, 6.0}));
}

TEST_F(RoadExtensionTest, ForgetsAllByAReset) {
  update({leftBorder(-5.0, 10.0)});
  extension_.reset();
  EXPECT_FALSE(extension_.offset(RoadSide::kLeft, {20.0, 6.0}));
}

}  // namespace
}  // namespace datmo::road_extension_test
