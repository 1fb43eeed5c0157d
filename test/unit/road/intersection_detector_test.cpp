// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/intersection_detector.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::intersection_detector_test {
namespace {

/// A piece of way, m, along which a side has another probability than the rest.
struct Piece {
  double first;
  double last;
  double probability;
};

using Pieces = std::vector<Piece>;

constexpr double kBorder = 0.95;
constexpr double kOpen = 0.1;
constexpr double kUnknown = 0.5;

/// What is known from 20 m behind the vehicle to 30 m ahead.
SidePresence sideAt(double arc_length, double elsewhere, const Pieces& pieces) {
  SidePresence side;
  side.first_station = std::floor(arc_length) - 20.0;
  for (int i = 0; i < 50; ++i) {
    const double station = side.first_station + i;
    double probability = elsewhere;
    for (const Piece& piece : pieces) {
      probability =
          station >= piece.first && station <= piece.last ? piece.probability : probability;
    }
    side.probability.push_back(probability);
  }
  return side;
}

/// What the detector says on the way from 0 m on.
struct Drive {
  double first_at = -1.0;  ///< m, where it was at an intersection first
  double last_at = -1.0;   ///< m, and last
  int found = 0;           ///< times that it came to one
};

constexpr double kStep = 0.5;  ///< m, from a scan to the next one

Drive drive(IntersectionDetector& detector, const Pieces& left, const Pieces& right,
            double elsewhere = kBorder, double length = 150.0) {
  Drive result;
  bool before = false;
  for (double arc_length = 0.0; arc_length < length; arc_length += kStep) {
    detector.update(
        {arc_length, sideAt(arc_length, elsewhere, left), sideAt(arc_length, elsewhere, right)});
    if (detector.atIntersection()) {
      result.first_at = result.first_at < 0.0 ? arc_length : result.first_at;
      result.last_at = arc_length;
      result.found += before ? 0 : 1;
    }
    before = detector.atIntersection();
  }
  return result;
}

class IntersectionDetectorTest : public ::testing::Test {
 protected:
  void expectNone(const Pieces& left, const Pieces& right, double elsewhere = kBorder) {
    EXPECT_EQ(drive(detector_, left, right, elsewhere).found, 0);
  }

  /// `late`: m, that it may be told late and end early or late.
  void expectFrom50To70(const Pieces& left, const Pieces& right, double late) {
    const Drive result = drive(detector_, left, right);
    EXPECT_EQ(result.found, 1);
    EXPECT_NEAR(result.first_at, 50.0, late);
    EXPECT_NEAR(result.last_at, 70.0, late);
  }

  IntersectionDetector detector_{IntersectionDetectorOptions()};
};

TEST_F(IntersectionDetectorTest, ACrossroadsIsFoundWhileItIsThere) {
  expectFrom50To70({{50, 70, kOpen}}, {{50, 70, kOpen}}, 4.0);
}

TEST_F(IntersectionDetectorTest, AJunctionOnOneSideIsOne) {
  expectFrom50To70({{50, 70, kOpen}}, {}, 6.0);
}

TEST_F(IntersectionDetectorTest, TwoAreTwo) {
  const Pieces both{{40, 55, kOpen}, {90, 105, kOpen}};
  EXPECT_EQ(drive(detector_, both, both).found, 2);
}

TEST_F(IntersectionDetectorTest, ARoadWithBordersIsNone) { expectNone({}, {}); }

TEST_F(IntersectionDetectorTest, AYardOrAGapBetweenCarsIsNone) {
  expectNone({{50, 54, kOpen}, {80, 85, kOpen}}, {{60, 65, kOpen}});
}

TEST_F(IntersectionDetectorTest, ALostBorderIsNone) {
  expectNone({{50, 70, kUnknown}}, {{50, 70, kUnknown}});
  detector_.reset();
  expectNone({{50, 500, kUnknown}}, {{40, 500, kUnknown}});
}

TEST_F(IntersectionDetectorTest, BehindAFewParkedCarsThereIsNone) {
  expectNone({{40, 50, kBorder}}, {{38, 50, kBorder}}, kOpen);
}

TEST_F(IntersectionDetectorTest, WhereThereNeverWasABorderThereIsNone) {
  expectNone({}, {}, kOpen);
  detector_.reset();
  expectNone({}, {}, kUnknown);
}

TEST_F(IntersectionDetectorTest, WhereTheRoadEndsInOpenSpaceItIsOverAfterSomeDistance) {
  const Drive result = drive(detector_, {{50, 500, kOpen}}, {{50, 500, kOpen}});
  EXPECT_EQ(result.found, 1);
  EXPECT_LT(result.last_at, 50.0 + IntersectionDetectorOptions().max_opening + 30.0);
}

TEST_F(IntersectionDetectorTest, OneSideOnlyIsEnoughToLeave) {
  const Drive result = drive(detector_, {{50, 70, kOpen}}, {{0, 500, kUnknown}});
  EXPECT_EQ(result.found, 1);
  EXPECT_NEAR(result.last_at, 70.0, 4.0);
}

TEST_F(IntersectionDetectorTest, SingleWrongStationsChangeNothing) {
  Random random(1);
  int wrong = 0;
  for (int trial = 0; trial < 20; ++trial) {
    detector_.reset();
    Pieces left{{50, 70, kOpen}};
    Pieces right{{50, 70, kOpen}};
    for (int i = 0; i < 4; ++i) {
      const double outside = std::floor(random.uniform(80.0, 140.0));
      left.push_back({outside, outside + 1.0, kOpen});
      const double inside = std::floor(random.uniform(52.0, 68.0));
      right.push_back({inside, inside, kBorder});
    }
    wrong += drive(detector_, left, right).found == 1 ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TEST_F(IntersectionDetectorTest, OneThatStandsKeepsItsState) {
  const Pieces open{{50, 70, kOpen}};
  for (const double stop : {30.0, 60.0}) {
    detector_.reset();
    drive(detector_, open, open, kBorder, stop);
    const bool before = detector_.atIntersection();
    const double probability = detector_.probability();
    for (int i = 0; i < 1000; ++i) {
      const double arc_length = stop - kStep;
      detector_.update(
          {arc_length, sideAt(arc_length, kUnknown, {}), sideAt(arc_length, kUnknown, {})});
    }
    EXPECT_EQ(detector_.atIntersection(), before);
    EXPECT_NEAR(detector_.probability(), probability, 1e-9);
    EXPECT_EQ(before, stop > 50.0);
  }
}

TEST_F(IntersectionDetectorTest, ADistanceThatRestartsForgets) {
  const Pieces open{{50, 70, kOpen}};
  drive(detector_, open, open, kBorder, 60.0);
  ASSERT_TRUE(detector_.atIntersection());
  detector_.update({0.0, sideAt(0.0, kBorder, {}), sideAt(0.0, kBorder, {})});
  EXPECT_FALSE(detector_.atIntersection());
}

TEST_F(IntersectionDetectorTest, NothingKnownAndNoNumbersDoNoHarm) {
  detector_.update({});
  detector_.update({10.0, {}, {}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  detector_.update({nan, sideAt(0.0, kOpen, {}), {}});
  detector_.update({1.0e9, sideAt(0.0, 0.0, {}), sideAt(0.0, 1.0, {})});
  EXPECT_GE(detector_.probability(), 0.0);
  EXPECT_LE(detector_.probability(), 1.0);
  EXPECT_FALSE(detector_.atIntersection());
}

TEST(IntersectionDetectorOptionsTest, BadOnesAreRefused) {
  IntersectionDetectorOptions options;
  options.leave_below = 0.95;
  EXPECT_THROW(IntersectionDetector{options}, OptionError);
  options = {};
  options.min_opening = 50.0;
  EXPECT_THROW(IntersectionDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo::intersection_detector_test
