// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/searched_map.h"

#include <cmath>

#include "grid/small_map.h"
#include <gtest/gtest.h>

namespace datmo::searched_map_test {
namespace {

using samples::mapWithABeam;

TEST(SearchedMapTest, HasTheDistanceToSurfaces) {
  const SearchedMap map(mapWithABeam());
  EXPECT_EQ(map.surfaces().size(), 1U);
  // Cells are counted from the lower left corner, which is at (-5, -5) m.
  EXPECT_EQ(map.at({9.2F, 5.2F}).to_surface, 0.0F);
  EXPECT_EQ(map.at({6.5F, 5.5F}).to_surface, 3.0F);
  EXPECT_NEAR(map.at({7.5F, 8.5F}).to_surface, std::sqrt(13.0), 0.02);
}

TEST(SearchedMapTest, HasTheDepthOfFreeSpace) {
  const SearchedMap map(mapWithABeam());
  EXPECT_EQ(map.at({6.5F, 5.5F}).depth, 1.0F) << "one row of cells";
  EXPECT_EQ(map.at({9.5F, 5.5F}).depth, 0.0F) << "occupied";
  EXPECT_EQ(map.at({6.5F, 7.5F}).depth, 0.0F) << "unknown";
}

TEST(SearchedMapTest, OutsideNothingIsFreeAndSurfacesAreAtLeastAsFarAsTheWindow) {
  const SearchedMap map(mapWithABeam());
  EXPECT_FALSE(map.contains({11.0F, 5.5F}));
  EXPECT_EQ(map.at({11.0F, 5.5F}).depth, 0.0F);
  EXPECT_EQ(map.at({11.0F, 5.5F}).to_surface, 1.0F);
  EXPECT_EQ(map.at({-3.0F, -4.0F}).to_surface, 5.0F);
}

TEST(SearchedMapTest, WhereThereAreNoSurfacesAllAreFar) {
  const SearchedMap map{OccupancyMap{OccupancyMapOptions{}}};
  EXPECT_TRUE(map.surfaces().empty());
  EXPECT_GT(map.at({100.0F, 100.0F}).to_surface, 500.0F);
}

}  // namespace
}  // namespace datmo::searched_map_test
