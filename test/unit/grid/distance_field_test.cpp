// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/distance_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo::distance_field_test {
namespace {

/// A map of 10 m x 10 m in cells of 1 m, with a beam along x through its middle row that ends in
/// the cell of x = 4.5 m, three times in 2 s.
OccupancyMap mapWithABeam() {
  OccupancyMapOptions options;
  options.window = {10.0, 10.0, 1.0};
  OccupancyMap map(options);
  for (int i = 0; i < 3; ++i) {
    Scan scan;
    scan.stamp = Stamp::fromSeconds(100.0 + i);
    Ray ray;
    ray.origin = Point2(-4.5, 0.5);
    ray.end = Point2(4.5, 0.5);
    ray.range = 9.0;
    ray.hit = true;
    scan.rays = {ray};
    map.update(scan, {PointState::kUnknown}, Pose2());
  }
  return map;
}

DistanceField toStaticCells(const OccupancyMap& map) {
  return DistanceField(
      map.window(), [&map](CellIndex cell) { return map.stateOf(cell) == CellState::kStatic; },
      7.0);
}

TEST(DistanceFieldTest, LeadsToTheNearestCell) {
  const OccupancyMap map = mapWithABeam();
  ASSERT_EQ(map.stateOf(map.window().cellAt({4.5, 0.5})), CellState::kStatic);
  ASSERT_EQ(map.stateOf(map.window().cellAt({0.5, 0.5})), CellState::kFree);
  ASSERT_EQ(map.stateOf(map.window().cellAt({0.5, 3.5})), CellState::kUnknown);
  const DistanceField field = toStaticCells(map);
  EXPECT_NEAR(field.at({4.2, 0.2}), 0.0, 1e-6);
  EXPECT_NEAR(field.at({1.5, 0.5}), 3.0, 1e-5);
  EXPECT_NEAR(field.at({2.5, 3.5}), std::sqrt(13.0), 1e-5);
  EXPECT_EQ(field.at({40.0, 0.0}), 7.0);
}

TEST(DistanceFieldTest, WithoutSuchCellsNothingIsNear) {
  const OccupancyMap map{OccupancyMapOptions{}};
  const DistanceField field = toStaticCells(map);
  EXPECT_GE(field.at({0.0, 0.0}), 7.0);
}

}  // namespace
}  // namespace datmo::distance_field_test
