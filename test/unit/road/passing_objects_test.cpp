// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/passing_objects.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scan_history_samples.h"
#include <gtest/gtest.h>

namespace datmo::passing_objects_test {
namespace {

constexpr double kCurb = 0.1;

/// Adjacent beams that end on a wall across x, at this distance (m), from the bearing 0 on.
LabeledScan wallOf(int beams, double distance = 20.0, PointState state = PointState::kMoving) {
  std::vector<Point2> positions;
  for (int i = 0; i < beams; ++i) {
    positions.emplace_back(distance, distance * std::tan(degrees(2.0 * i)));
  }
  LabeledScan scan = samples::scanOf(positions, 0.0);
  for (ScanPoint& point : scan.points) {
    point.state = state;
  }
  return scan;
}

class PassingObjectsTest : public testing::Test {
 protected:
  std::vector<double> of(const LabeledScan& scan) const {
    return standingProbabilities(scan, kCurb, options_);
  }

  /// By the formula, of so many adjacent beams.
  double expected(int beams) const {
    const double passing = options_.share * std::pow(options_.detection, beams);
    const double standing = (1.0 - options_.share) * std::pow(kCurb, beams);
    return standing / (standing + passing);
  }

  PassingObjectOptions options_;
};

TEST_F(PassingObjectsTest, TheMoreAdjacentBeamsEndWhereItWasFreeTheLikelierItPasses) {
  for (const int beams : {1, 2, 3, 5}) {
    for (const double standing : of(wallOf(beams))) {
      EXPECT_NEAR(standing, expected(beams), 1e-12) << beams;
    }
  }
  EXPECT_GT(expected(1), 0.8) << "a curb";
  EXPECT_LT(expected(5), 0.01) << "a car";
}

TEST_F(PassingObjectsTest, WhatTheMapHasOrDoesNotKnowStands) {
  for (const PointState state : {PointState::kStatic, PointState::kUnknown}) {
    EXPECT_EQ(of(wallOf(5, 20.0, state)), std::vector<double>(5, 1.0));
  }
}

TEST_F(PassingObjectsTest, APointThatStandsOrAFreeBeamPartsTwoSurfaces) {
  LabeledScan parted = wallOf(5);
  parted.points[2].state = PointState::kStatic;
  const std::vector<double> standing = of(parted);
  EXPECT_NEAR(standing[0], expected(2), 1e-12);
  EXPECT_EQ(standing[2], 1.0);
  EXPECT_NEAR(standing[3], expected(2), 1e-12);

  LabeledScan with_gap = wallOf(5);
  with_gap.points.erase(with_gap.points.begin() + 2);
  for (const double probability : of(with_gap)) {
    EXPECT_NEAR(probability, expected(2), 1e-12);
  }
}

TEST_F(PassingObjectsTest, OneBehindTheOtherAreTwoSurfaces) {
  LabeledScan scan = wallOf(4);
  for (std::size_t i = 2; i < 4; ++i) {
    scan.points[i].position *= 1.5;
    scan.points[i].range *= 1.5;
  }
  for (const double probability : of(scan)) {
    EXPECT_NEAR(probability, expected(2), 1e-12);
  }
}

TEST_F(PassingObjectsTest, EchoesOfOneBeamCountOnce) {
  LabeledScan scan = wallOf(1);
  scan.points.push_back(scan.points.front());
  scan.points.back().position.x() += 0.3;
  for (const double probability : of(scan)) {
    EXPECT_NEAR(probability, expected(1), 1e-12);
  }
}

TEST_F(PassingObjectsTest, WhereNothingPassesAllStandsAndAnEmptyScanHasNothing) {
  options_.share = 0.0;
  EXPECT_EQ(of(wallOf(5)), std::vector<double>(5, 1.0));
  LabeledScan long_one = wallOf(1);
  long_one.points.resize(2000, long_one.points.front());
  for (std::size_t i = 0; i < long_one.points.size(); ++i) {
    long_one.points[i].beam = static_cast<std::uint32_t>(i);
  }
  EXPECT_EQ(of(long_one), std::vector<double>(2000, 1.0));
  EXPECT_TRUE(of(wallOf(0)).empty());
}

}  // namespace
}  // namespace datmo::passing_objects_test
