// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/branch_search.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::branch_search_test {
namespace {

/// Whether a point is occupied.
using Blocks = std::function<bool(const Point2&)>;

constexpr double kHalfStreet = 6.0;  ///< m

bool isInStreetAlongX(const Point2& point) { return std::abs(point.y()) < kHalfStreet; }
bool isInStreetAlongY(const Point2& point) { return std::abs(point.x()) < kHalfStreet; }

bool crossroads(const Point2& point) {
  return !isInStreetAlongX(point) && !isInStreetAlongY(point);
}
bool road(const Point2& point) { return !isInStreetAlongX(point); }

class BranchSearchTest : public ::testing::Test {
 protected:
  /// Scans a scene all around from the origin, twice.
  void see(const Blocks& blocks) {
    constexpr int kBeams = 1440;
    constexpr double kStep = 0.05;
    constexpr double kRange = 40.0;
    BorderScan scan;
    for (int i = 0; i < kBeams; ++i) {
      const double bearing = kTurn * i / kBeams;
      const Point2 ray(std::cos(bearing), std::sin(bearing));
      BorderScan::Beam beam;
      double range = 0.0;
      while (range < kRange && !beam.hit) {
        range += kStep;
        beam.hit = blocks(range * ray);
      }
      beam.end = range * ray;
      scan.beams.push_back(beam);
    }
    grid_.update(scan);
    grid_.update(scan);
  }

  std::vector<RoadBranch> branches() const { return search_.search(grid_, Point2::Zero()); }

  bool leadsTo(double heading, double tolerance = degrees(3.0)) const {
    for (const RoadBranch& branch : branches()) {
      if (std::abs(angleBetween(branch.heading, heading)) < tolerance) {
        return true;
      }
    }
    return false;
  }

  PassageGrid grid_{PassageGridOptions()};
  BranchSearch search_{BranchSearchOptions()};
};

TEST_F(BranchSearchTest, ARoadLeadsAheadAndBack) {
  see(road);
  ASSERT_EQ(branches().size(), 2U);
  EXPECT_TRUE(leadsTo(0.0));
  EXPECT_TRUE(leadsTo(kPi));
  // A corridor of 5.5 m in a street of 12 m ends up to 3.25 m beside its middle line, and begins up
  // to 2 m beside it: it turns by up to atan(5.25 / 24) = 12 degrees.
  for (const RoadBranch& branch : branches()) {
    EXPECT_NEAR(branch.angle, degrees(25.0), degrees(5.0));
  }
}

TEST_F(BranchSearchTest, FourStreetsLeadAwayFromACrossroads) {
  see(crossroads);
  ASSERT_EQ(branches().size(), 4U);
  for (const double heading : {0.0, 0.5 * kPi, kPi, -0.5 * kPi}) {
    EXPECT_TRUE(leadsTo(heading)) << heading;
  }
}

TEST_F(BranchSearchTest, ThreeWhereASideStreetOpens) {
  see([](const Point2& point) { return crossroads(point) || point.y() > kHalfStreet; });
  ASSERT_EQ(branches().size(), 3U);
  EXPECT_FALSE(leadsTo(0.5 * kPi));
}

TEST_F(BranchSearchTest, ADrivewayIsNone) {
  see([](const Point2& point) {
    return road(point) && !(point.y() > 0.0 && std::abs(point.x()) < 2.0);
  });
  EXPECT_EQ(branches().size(), 2U);
}

TEST_F(BranchSearchTest, AYardIsNone) {
  see([](const Point2& point) { return crossroads(point) || std::abs(point.y()) > 15.0; });
  EXPECT_EQ(branches().size(), 2U);
}

TEST_F(BranchSearchTest, NoStreetLeadsAwayInAnOpenSpace) {
  see([](const Point2&) { return false; });
  EXPECT_TRUE(branches().empty());
}

TEST_F(BranchSearchTest, NoneLeadsIntoUnseenSpace) { EXPECT_TRUE(branches().empty()); }

constexpr double kHalfGap = 4.0;  ///< m

/// A road between rows of 1 m depth, with a gap in the left one.
bool roadWithGap(const Point2& point) {
  const bool in_gap = point.y() > 0.0 && std::abs(point.x()) < kHalfGap;
  return road(point) && std::abs(point.y()) < kHalfStreet + 1.0 && !in_gap;
}

TEST_F(BranchSearchTest, OpenGroundBehindAGapIsNone) {
  see(roadWithGap);
  EXPECT_EQ(branches().size(), 2U);
  EXPECT_FALSE(leadsTo(0.5 * kPi, degrees(20.0)));
}

TEST_F(BranchSearchTest, AStreetHasASideSomewhere) {
  see([](const Point2& point) {
    const bool on_wall =
        point.y() > 0.0 && point.x() > kHalfStreet && point.x() < kHalfStreet + 1.0;
    return roadWithGap(point) || on_wall;
  });
  EXPECT_EQ(branches().size(), 3U);
  EXPECT_TRUE(leadsTo(0.5 * kPi, degrees(20.0)));
}

TEST_F(BranchSearchTest, ReportsTheShareOfItsLengthWithObjectsBeside) {
  see(road);
  ASSERT_EQ(branches().size(), 2U);
  for (const RoadBranch& branch : branches()) {
    EXPECT_NEAR(branch.sides, 1.0, 0.05);
  }
}

TEST_F(BranchSearchTest, AnObjectInItIsNoSide) {
  see([](const Point2& point) {
    const bool on_post = (point - Point2(0.0, 16.0)).norm() < 0.3;
    return roadWithGap(point) || on_post;
  });
  EXPECT_EQ(branches().size(), 2U);
}

TEST_F(BranchSearchTest, AWallFartherThanItsReachIsNoSide) {
  see([](const Point2& point) {
    const bool on_wall = point.y() > 0.0 && point.x() > 14.0 && point.x() < 15.0;
    return roadWithGap(point) || on_wall;
  });
  EXPECT_EQ(branches().size(), 2U);
}

}  // namespace
}  // namespace datmo::branch_search_test
