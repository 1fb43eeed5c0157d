// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/seen_points.h"

#include <vector>

#include <gtest/gtest.h>

namespace datmo::seen_points_test {
namespace {

Object objectOf(const std::vector<Point2>& points) {
  Object object;
  object.points = points;
  return object;
}

std::vector<double> timesOf(const SeenPointHistory& history) {
  std::vector<double> times;
  for (const auto& scan : history.scans()) {
    times.push_back(scan->time);
  }
  return times;
}

TEST(SeenPointHistory, ASingleEchoHasNoDirection) {
  SeenPointHistory history;
  history.add(objectOf({{20.0, 1.0}}), 0.0, 2.0);
  ASSERT_EQ(history.scans().size(), 1U);
  const SeenPoints& seen = *history.scans().front();
  EXPECT_TRUE(seen.is_echo);
  EXPECT_TRUE(seen.points.front().position.isApprox(Point2(20.0, 1.0)));
  EXPECT_TRUE(seen.points.front().direction.isZero());
}

TEST(SeenPointHistory, ASurfaceRunsFromNeighborToNeighbor) {
  SeenPointHistory history;
  history.add(objectOf({{20.0, 0.0}, {20.0, 1.0}, {21.0, 1.0}}), 0.0, 2.0);
  const auto& points = history.scans().front()->points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_TRUE(points[0].direction.isApprox(Point2(0.0, 1.0)));
  EXPECT_TRUE(points[1].direction.isApprox(Point2(1.0, 1.0).normalized()));
  EXPECT_TRUE(points[2].direction.isApprox(Point2(1.0, 0.0)));
}

TEST(SeenPointHistory, KeepsBothEndsOfALongSurface) {
  std::vector<Point2> wall;
  for (int i = 0; i <= 100; ++i) {
    wall.emplace_back(20.0, 0.1 * i);
  }
  SeenPointHistory history;
  history.add(objectOf(wall), 0.0, 2.0);
  const auto& points = history.scans().front()->points;
  EXPECT_EQ(points.size(), 6U);
  EXPECT_TRUE(points.front().position.isApprox(wall.front()));
  EXPECT_TRUE(points.back().position.isApprox(wall.back()));
}

TEST(SeenPointHistory, AnObjectWithoutPointsAddsNothing) {
  SeenPointHistory history;
  history.add(objectOf({}), 0.0, 2.0);
  EXPECT_TRUE(history.scans().empty());
}

TEST(SeenPointHistory, ForgetsPointsOlderThanItsMemory) {
  SeenPointHistory history;
  history.add(objectOf({{20.0, 1.0}}), 0.0, 2.0);
  history.add(objectOf({{20.0, 1.0}}), 1.5, 2.0);
  history.add(objectOf({{20.0, 1.0}}), 2.5, 2.0);
  EXPECT_EQ(timesOf(history), (std::vector<double>{1.5, 2.5}));
}

TEST(SeenPointHistory, SpreadsTheKeptPointsOverTheMemory) {
  SeenPointHistory history;
  for (int i = 0; i <= 40; ++i) {
    history.add(objectOf({{20.0, 1.0}}), 0.05 * i, 2.0);
  }
  const std::vector<double> times = timesOf(history);
  ASSERT_EQ(times.size(), 6U);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), 2.0);
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_LE(times[i] - times[i - 1], 1.0);
  }
}

}  // namespace
}  // namespace datmo::seen_points_test
