// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/end_points.h"

#include "grid/small_map.h"
#include <gtest/gtest.h>

namespace datmo::end_points_test {
namespace {

using samples::scanWithSpacing;

constexpr double kSpacing = 0.1;  // rad

TEST(EndPointsTest, LeavesOutBeamsWithoutAHit) {
  Scan scan = scanWithSpacing(kSpacing, {{5.0, 0.0}, {6.0, 1.0}});
  scan.rays[0].hit = false;
  const auto points = endPoints(scan, 3.0);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].position, Point2(6.0, 1.0));
}

TEST(EndPointsTest, ASurfaceIsSampledBetweenItsPoints) {
  // A wall along y, hit every 0.6 m.
  const auto points =
      endPoints(scanWithSpacing(kSpacing, {{5.0, -0.6}, {5.0, 0.0}, {5.0, 0.6}}), 3.0);
  for (const EndPoint& point : points) {
    EXPECT_NEAR(point.sampling(1, 1), 0.6 * 0.6 / 12.0, 1e-12);
    EXPECT_NEAR(point.sampling(0, 0), 0.0, 1e-12);
  }
}

TEST(EndPointsTest, AWallAtAFlatAngleIsSampledAlongItselfHoweverFarTheStep) {
  // A wall along x, 2 m to the left: the beams end at increasing spacing.
  const auto points =
      endPoints(scanWithSpacing(kSpacing, {{28.0, 2.0}, {20.0, 2.0}, {15.0, 2.0}}), 3.0);
  EXPECT_NEAR(points[0].sampling(0, 0), 8.0 * 8.0 / 12.0, 1e-12);
  EXPECT_NEAR(points[1].sampling(0, 0), 5.0 * 5.0 / 12.0, 1e-12);
  EXPECT_NEAR(points[1].sampling(1, 1), 0.0, 1e-12);
}

TEST(EndPointsTest, ProtrudingPointsAreSampledByTheBeamsSpacing) {
  const auto points =
      endPoints(scanWithSpacing(kSpacing, {{30.0, -3.0}, {10.0, 0.0}, {30.0, 3.0}}), 3.0);
  EXPECT_NEAR(points[1].sampling(1, 1), 1.0 / 12.0, 1e-12);
  EXPECT_NEAR(points[1].sampling(0, 0), 0.0, 1e-12);
}

TEST(EndPointsTest, NoBeamsNoPoints) { EXPECT_TRUE(endPoints(Scan{}, 3.0).empty()); }

}  // namespace
}  // namespace datmo::end_points_test
