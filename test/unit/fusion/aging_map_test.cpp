// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/aging_map.h"

#include <algorithm>
#include <cmath>

#include "map_samples.h"
#include <gtest/gtest.h>

namespace datmo::aging_map_test {
namespace {

using namespace map_samples;

TEST(AgingMap, EvidenceAddsUpToItsLimitAndAges) {
  AgingMap map(evenLooks(), 20, 10, 1.0);
  const double look = std::log(4.0);
  map.update(gridWith(kCell, kOccupied, 0.0), Pose2());
  EXPECT_NEAR(map.logOdds(kCell, stampAt(0.0)), look, 1e-6);
  EXPECT_NEAR(map.logOdds(kCell, stampAt(kTimeConstant)), look / std::exp(1.0), 1e-5);
  map.update(gridWith(kCell, kOccupied, kTimeConstant), Pose2());
  EXPECT_NEAR(map.logOdds(kCell, stampAt(kTimeConstant)), look / std::exp(1.0) + look, 1e-5)
      << "it has aged before it is added to";
  for (int i = 1; i < 10; ++i) {
    map.update(gridWith(kCell, kOccupied, kTimeConstant + 0.1 * i), Pose2());
  }
  EXPECT_NEAR(map.logOdds(kCell, stampAt(kTimeConstant + 0.9)), std::log(49.0), 1e-5);
  EXPECT_EQ(map.image(stampAt(kTimeConstant + 0.9)).at(kCell), 98);
  EXPECT_EQ(map.image(stampAt(10.0 * kTimeConstant)).at(kCell), kUnknownPercent);
  EXPECT_EQ(map.logOdds({4, 1}, stampAt(0.0)), 0.0) << "never seen";
}

TEST(AgingMap, EvidenceIsNotWorthMoreBeforeItWasSeen) {
  AgingMapOptions options = evenLooks();
  options.time_constant = 0.1;
  AgingMap map(options, 20, 10, 1.0);
  map.update(gridWith(kCell, kOccupied, 0.1), Pose2());
  EXPECT_NEAR(map.logOdds(kCell, stampAt(0.0)), std::log(4.0), 1e-6) << "of a pose before the grid";
}

TEST(AgingMap, EachCellAgesSinceItWasSeen) {
  AgingMap map(evenLooks(), 20, 10, 1.0);
  map.update(gridWith({0, 0}, kOccupied, 0.0), Pose2());
  map.update(gridWith({1, 0}, kOccupied, kTimeConstant), Pose2());
  SensorGrid both = gridWith({0, 0}, kOccupied, 2.0 * kTimeConstant);
  both.at({1, 0}) = kOccupied;
  map.update(both, Pose2());
  const double look = std::log(4.0);
  const double left = std::exp(-1.0);
  EXPECT_NEAR(map.logOdds({0, 0}, stampAt(2.0 * kTimeConstant)), look * (1.0 + left * left), 1e-5);
  EXPECT_NEAR(map.logOdds({1, 0}, stampAt(2.0 * kTimeConstant)), look * (1.0 + left), 1e-5);
}

TEST(AgingMap, AGridIsSeenFromThePoseAndNoObstacleIsLost) {
  AgingMap map(evenLooks(), 40, 40, 1.0);
  const Pose2 base(2.0, 1.0, kPi / 4.0);
  SensorGrid grid(stampAt(0.0), kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), kFree);
  grid.at(kCell) = kOccupied;
  map.update(grid, base);
  const CellIndex hit = map.window().cellAt(base * kWindow.centerOf(kCell));
  const SensorGrid image = map.image(stampAt(0.0));
  EXPECT_EQ(image.at(hit), kOccupied);
  EXPECT_EQ(std::count(image.cells().begin(), image.cells().end(), kOccupied), 1);
}

TEST(AgingMap, CellsThatLeaveTheWindowAreForgotten) {
  AgingMap map(evenLooks(), 20, 10, 1.0);
  map.update(gridWith(kCell, kOccupied, 0.0), Pose2());
  map.centerOn({5.5, 0.5});
  EXPECT_EQ(map.image(stampAt(0.0)).at(kCell), kOccupied);
  map.centerOn({50.5, 0.5});
  map.centerOn({0.5, 0.5});
  EXPECT_EQ(map.image(stampAt(0.0)).at(kCell), kUnknownPercent);
}

}  // namespace
}  // namespace datmo::aging_map_test
