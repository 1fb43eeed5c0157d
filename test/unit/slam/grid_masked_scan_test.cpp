// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/grid_masked_scan.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace datmo::grid_masked_scan_test {
namespace {

constexpr GridWindow kWindow{1.0, 40, 40, {-20, -20}};

/// A scanner at the base's origin with a beam along each of -45, 0 and 45 degrees.
Scan scanWithRanges(const std::vector<double>& ranges) {
  Scan scan;
  scan.field.first_bearing = degrees(-45.0);
  scan.field.beam_spacing = degrees(45.0);
  scan.field.beams = 3;
  scan.field.range = 15.0;
  for (std::uint32_t beam = 0; beam < ranges.size(); ++beam) {
    Ray ray;
    ray.beam = beam;
    ray.bearing = degrees(-45.0 + 45.0 * beam);
    ray.hit = std::isfinite(ranges[beam]);
    ray.range = ray.hit ? ranges[beam] : scan.field.range;
    ray.end = ray.range * Point2(std::cos(ray.bearing), std::sin(ray.bearing));
    scan.rays.push_back(ray);
  }
  return scan;
}

/// All free except these cells.
SensorGrid gridWith(const std::vector<CellIndex>& occupied) {
  SensorGrid grid({}, kWindow);
  std::fill(grid.cells().begin(), grid.cells().end(), Percent{20});
  for (const CellIndex cell : occupied) {
    grid.at(cell) = 80;
  }
  return grid;
}

constexpr double kNothing = INFINITY;

TEST(GridMaskedScanTest, ABeamThatTheGridConfirmsKeepsItsExactEnd) {
  const GridMaskedScan view = maskScanWithGrid(
      gridWith({{10, 0}}), scanWithRanges({kNothing, 10.3, kNothing}), GridEnds::kScan);
  EXPECT_TRUE(view.scan.rays[1].hit);
  EXPECT_TRUE(view.measured[1]);
  EXPECT_TRUE(view.any_measured);
  EXPECT_DOUBLE_EQ(view.scan.rays[1].range, 10.3);
}

TEST(GridMaskedScanTest, ABeamThatTheGridRefutesHasNoHit) {
  const GridMaskedScan view =
      maskScanWithGrid(gridWith({}), scanWithRanges({kNothing, 10.3, kNothing}), GridEnds::kScan);
  EXPECT_FALSE(view.scan.rays[1].hit);
  EXPECT_FALSE(view.any_measured);
  EXPECT_TRUE(view.cells.empty());
  ASSERT_EQ(view.refuted.size(), 1U);
  EXPECT_NEAR(view.refuted[0].x(), 10.3, 1e-9);
}

TEST(GridMaskedScanTest, UndecidedIsNotConfirmed) {
  SensorGrid grid = gridWith({});
  grid.at({10, 0}) = kUndecidedPercent;
  EXPECT_TRUE(maskScanWithGrid(grid, scanWithRanges({kNothing, 10.3, kNothing}), GridEnds::kScan)
                  .refuted.empty());
  EXPECT_FALSE(maskScanWithGrid(grid, scanWithRanges({kNothing, 10.3, kNothing}), GridEnds::kScan)
                   .scan.rays[1]
                   .hit);
}

TEST(GridMaskedScanTest, BeyondTheWindowTheBeamIsTrusted) {
  Scan scan = scanWithRanges({kNothing, 30.0, kNothing});
  EXPECT_TRUE(maskScanWithGrid(gridWith({}), scan, GridEnds::kScan).measured[1]);
}

TEST(GridMaskedScanTest, ABeamWithoutHitEndsAtCellsOfOthers) {
  const GridMaskedScan view = maskScanWithGrid(
      gridWith({{5, 5}, {8, 8}}), scanWithRanges({kNothing, kNothing, kNothing}), GridEnds::kScan);
  const Ray& ray = view.scan.rays[2];
  EXPECT_TRUE(ray.hit);
  EXPECT_FALSE(view.measured[2]);
  EXPECT_NEAR(ray.range, 5.5 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(ray.end.x(), 5.5, 1e-9);
  EXPECT_NEAR(ray.end.y(), 5.5, 1e-9);
}

TEST(GridMaskedScanTest, OfTheScannersOwnEndAndANearerCellTheEndCounts) {
  const GridMaskedScan view = maskScanWithGrid(
      gridWith({{5, 0}, {10, 0}}), scanWithRanges({kNothing, 10.3, kNothing}), GridEnds::kScan);
  EXPECT_DOUBLE_EQ(view.scan.rays[1].range, 10.3);
  ASSERT_EQ(view.cells.size(), 1U);
  EXPECT_EQ(view.cells[0], Point2(5.5, 0.5));
}

TEST(GridMaskedScanTest, CellsAcrossABeamsWidthAreItsOwn) {
  Scan scan = scanWithRanges({kNothing, 10.3, kNothing});
  scan.field.beam_spacing = degrees(20.0);  // 3.6 m wide at 10.3 m
  const SensorGrid grid = gridWith({{10, -2}, {10, -1}, {10, 0}, {10, 1}, {10, 6}});
  const GridMaskedScan view = maskScanWithGrid(grid, scan, GridEnds::kScan);
  ASSERT_EQ(view.cells.size(), 1U);
  EXPECT_EQ(view.cells[0], Point2(10.5, 6.5));
}

TEST(GridMaskedScanTest, OfCellsAllEndsAreCenters) {
  const GridMaskedScan view = maskScanWithGrid(
      gridWith({{10, 0}}), scanWithRanges({kNothing, 10.1, kNothing}), GridEnds::kCells);
  EXPECT_TRUE(view.scan.rays[1].hit);
  EXPECT_FALSE(view.any_measured);
  EXPECT_NEAR(view.scan.rays[1].range, 10.5, 1e-9);
}

TEST(GridMaskedScanTest, ASilentScannersBeamsAreMadeFromTheGrid) {
  Scan silent = scanWithRanges({});
  const GridMaskedScan view = maskScanWithGrid(gridWith({{10, 0}}), silent, GridEnds::kScan);
  ASSERT_EQ(view.scan.rays.size(), 3U);
  EXPECT_FALSE(view.scan.rays[0].hit);
  EXPECT_TRUE(view.scan.rays[1].hit);
  EXPECT_FALSE(view.any_measured);
}

TEST(GridMaskedScanTest, BlindBeamsStayBlind) {
  Scan scan = scanWithRanges({kNothing, 10.3, kNothing});
  scan.rays.erase(scan.rays.begin());
  EXPECT_EQ(maskScanWithGrid(gridWith({{5, -6}}), scan, GridEnds::kScan).scan.rays.size(), 2U);
}

TEST(ExcludeConnectedTo, CellsConnectedToASeedAreLeftOut) {
  const SensorGrid grid = gridWith({{3, 3}, {4, 4}, {5, 4}, {8, 4}});
  const std::vector<Point2> positions = {{5.5, 4.5}, {8.5, 4.5}};
  const std::vector<Point2> apart = excludeConnectedTo({{3.2, 3.9}}, grid, positions);
  ASSERT_EQ(apart.size(), 1U);
  EXPECT_EQ(apart[0], positions[1]);
  EXPECT_EQ(excludeConnectedTo({}, grid, positions).size(), 2U);
  EXPECT_EQ(excludeConnectedTo({{0.5, 0.5}}, grid, positions).size(), 2U)
      << "the seed's own cell is free";
}

TEST(WithoutFreeEdges, OnlyFreeCellsBesideOccupiedOnesBecomeUnknown) {
  SensorGrid grid = gridWith({{3, 3}});
  grid.at({4, 3}) = kUndecidedPercent;
  const SensorGrid result = withoutFreeEdges(grid);
  EXPECT_EQ(result.at({3, 3}), 80);
  EXPECT_EQ(result.at({4, 3}), kUndecidedPercent);
  EXPECT_EQ(result.at({2, 2}), kUnknownPercent);
  EXPECT_EQ(result.at({1, 3}), 20);
  EXPECT_EQ(std::count(result.cells().begin(), result.cells().end(), kUnknownPercent), 7);
}

}  // namespace
}  // namespace datmo::grid_masked_scan_test
