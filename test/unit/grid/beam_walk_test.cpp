// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/beam_walk.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::beam_walk_test {
namespace {

std::vector<Point2> linesOf(const Beam& beam) {
  std::vector<Point2> ends;
  forEachLine({0.5, 20, 20, {0, 0}}, beam, [&](const Point2& end) { ends.push_back(end); });
  return ends;
}

TEST(BeamWalkTest, ABeamWithoutWidthIsOneLine) {
  const std::vector<Point2> ends = linesOf({{1.0, 2.0}, {3.0, 4.0}, 5.0, 0.0});
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0], Point2(4.0, 6.0));
}

TEST(BeamWalkTest, TheBordersOfTheFanAreHalfTheWidthFromItsAxis) {
  const std::vector<Point2> ends = linesOf({{1.0, 2.0}, {5.0, 0.0}, 5.0, 0.1});
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_NEAR(ends[0].x(), 1.0 + 5.0 * std::cos(0.05), 1e-12);
  EXPECT_NEAR(ends[0].y(), 2.0 - 5.0 * std::sin(0.05), 1e-12);
  EXPECT_NEAR(ends[1].y(), 2.0 + 5.0 * std::sin(0.05), 1e-12);
}

TEST(BeamWalkTest, NeighborsEndAtMostACellApart) {
  for (const double range : {1.0, 7.0, 49.9, 50.1}) {
    const std::vector<Point2> ends = linesOf({{0.0, 0.0}, {range, 0.0}, range, 0.2});
    for (std::size_t i = 1; i < ends.size(); ++i) {
      EXPECT_LE((ends[i] - ends[i - 1]).norm(), 0.5);
    }
  }
}

}  // namespace
}  // namespace datmo::beam_walk_test
