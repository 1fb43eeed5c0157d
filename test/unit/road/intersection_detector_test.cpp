// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/intersection_detector.h"

#include <limits>

#include <gtest/gtest.h>

namespace datmo::intersection_detector_test {
namespace {

constexpr int kRoad = 2;        ///< branches
constexpr int kCrossroads = 4;  ///< branches

class IntersectionDetectorTest : public ::testing::Test {
 protected:
  /// Drives to an arc length (m) and observes whenever an observation is due; counts arrivals at an
  /// intersection.
  int driveTo(double arc_length, int branches, bool bordered = true) {
    int found = 0;
    for (; arc_length_ < arc_length; arc_length_ += 0.25) {
      const bool before = detector_.atIntersection();
      if (detector_.isDue(arc_length_)) {
        detector_.update({arc_length_, bordered, branches});
      }
      found += detector_.atIntersection() && !before ? 1 : 0;
    }
    return found;
  }

  IntersectionDetector detector_{IntersectionDetectorOptions()};
  double arc_length_ = 0.0;  ///< m
};

TEST_F(IntersectionDetectorTest, OneObservationIsWeighedAsByHand) {
  IntersectionDetectorOptions options;
  options.min_road = 0.0;
  detector_ = IntersectionDetector(options);
  detector_.update({0.0, true, kRoad});
  EXPECT_EQ(detector_.probability(), 0.0);
  detector_.update({2.0, true, 3});
  // Rate 1/150 + 1/20 = 0.05667 per m: in 2 m 0.1176 (1 - exp(-0.1133)) = 0.01261; its odds times
  // 0.75 / 0.05 = 15.
  EXPECT_NEAR(detector_.probability(), 0.1607, 1e-4);
  IntersectionDetector on_road(options);
  on_road.update({0.0, true, kRoad});
  on_road.update({2.0, true, kRoad});
  // Its odds times 0.25 / 0.95.
  EXPECT_NEAR(on_road.probability(), 0.00335, 1e-5);
}

TEST_F(IntersectionDetectorTest, AnIntersectionIsFoundWhileItIsThere) {
  EXPECT_EQ(driveTo(50.0, kRoad), 0);
  EXPECT_EQ(driveTo(60.0, kCrossroads, false), 1);
  EXPECT_TRUE(detector_.atIntersection());
  EXPECT_EQ(driveTo(70.0, kCrossroads, false), 0);
  EXPECT_EQ(driveTo(80.0, kRoad), 0);
  EXPECT_FALSE(detector_.atIntersection());
  EXPECT_EQ(driveTo(90.0, 3, false), 1);
}

TEST_F(IntersectionDetectorTest, ARoadIsNone) {
  EXPECT_EQ(driveTo(300.0, kRoad), 0);
  EXPECT_LT(detector_.probability(), 0.02);
}

TEST_F(IntersectionDetectorTest, ASingleObservationIsNone) {
  driveTo(50.0, kRoad);
  EXPECT_EQ(driveTo(52.0, kCrossroads), 0);
  EXPECT_EQ(driveTo(70.0, kRoad), 0);
}

TEST_F(IntersectionDetectorTest, OneOfThreeInBetweenEndsNone) {
  driveTo(50.0, kRoad);
  driveTo(60.0, kCrossroads);
  ASSERT_TRUE(detector_.atIntersection());
  driveTo(62.0, kRoad);
  EXPECT_TRUE(detector_.atIntersection());
}

TEST_F(IntersectionDetectorTest, WithoutBordersThereIsNoRoad) {
  EXPECT_EQ(driveTo(200.0, kCrossroads, false), 0);
}

TEST_F(IntersectionDetectorTest, BehindAFewParkedCarsThereIsNone) {
  driveTo(12.0, kRoad);
  EXPECT_EQ(driveTo(100.0, kCrossroads, false), 0);
}

TEST_F(IntersectionDetectorTest, AStationaryVehicleKeepsItsState) {
  driveTo(50.0, kRoad);
  driveTo(60.25, kCrossroads);
  ASSERT_TRUE(detector_.atIntersection());
  const double probability = detector_.probability();
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(detector_.isDue(60.0));
    detector_.update({60.0, true, kRoad});
  }
  EXPECT_NEAR(detector_.probability(), probability, 1e-9);
  EXPECT_TRUE(detector_.atIntersection());
}

TEST_F(IntersectionDetectorTest, ADistanceThatRestartsForgets) {
  driveTo(50.0, kRoad);
  driveTo(60.0, kCrossroads);
  ASSERT_TRUE(detector_.atIntersection());
  EXPECT_TRUE(detector_.isDue(0.0));
  detector_.update({0.0, true, kCrossroads});
  EXPECT_FALSE(detector_.atIntersection());
  EXPECT_EQ(detector_.probability(), 0.0);
}

TEST_F(IntersectionDetectorTest, NoNumberChangesNothing) {
  driveTo(60.0, kRoad);
  const double before = detector_.probability();
  detector_.update({std::numeric_limits<double>::quiet_NaN(), true, kCrossroads});
  detector_.update({std::numeric_limits<double>::infinity(), true, kCrossroads});
  EXPECT_EQ(detector_.probability(), before);
}

TEST(IntersectionDetectorOptionsTest, BadOnesAreRefused) {
  IntersectionDetectorOptions options;
  options.leave_below = 0.95;
  EXPECT_THROW(IntersectionDetector{options}, OptionError);
  options = {};
  options.seen_on_road = 0.8;
  EXPECT_THROW(IntersectionDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo::intersection_detector_test
