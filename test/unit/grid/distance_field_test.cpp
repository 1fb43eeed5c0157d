// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/distance_field.h"

#include <cmath>

#include "small_map.h"
#include <gtest/gtest.h>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo::distance_field_test {
namespace {

using samples::mapWithABeam;

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

TEST(DistanceFieldTest, WithoutSuchCellsAllDistancesAreLarge) {
  const OccupancyMap map{OccupancyMapOptions{}};
  const DistanceField field = toStaticCells(map);
  EXPECT_GE(field.at({0.0, 0.0}), 7.0);
}

}  // namespace
}  // namespace datmo::distance_field_test
