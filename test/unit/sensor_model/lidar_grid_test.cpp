// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/lidar_grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scan_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::lidar_grid_test {
namespace {

using samples::scanWithRays;

constexpr Percent kOccupied = 80;
constexpr Percent kFree = 20;

/// 20 x 20 m, cells of 1 m: columns and rows from -10 to 9.
LidarGridOptions smallGrid() {
  LidarGridOptions options;
  options.window.length = 20.0;
  options.window.width = 20.0;
  options.window.cell_size = 1.0;
  return options;
}

Ray rayTo(const Point2& origin, const Point2& end, bool hit = true) {
  Ray ray;
  ray.origin = origin;
  ray.end = end;
  ray.range = (end - origin).norm();
  ray.bearing = std::atan2(end.y() - origin.y(), end.x() - origin.x());
  ray.hit = hit;
  return ray;
}

std::size_t count(const SensorGrid& grid, Percent percent) {
  return static_cast<std::size_t>(std::count(grid.cells().begin(), grid.cells().end(), percent));
}

TEST(LidarGridTest, AScanWithoutRaysIsUninformative) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(12.0);
  const SensorGrid grid = LidarGridModel(smallGrid()).grid(scan);
  EXPECT_EQ(grid.stamp(), scan.stamp);
  EXPECT_EQ(grid.window(), smallGrid().window.window());
  EXPECT_EQ(count(grid, kUnknownPercent), 400U);
}

TEST(LidarGridTest, OneBeamIsFreeBeforeItsEndOccupiedThereUnknownBehind) {
  const SensorGrid grid =
      LidarGridModel(smallGrid()).grid(scanWithRays({rayTo({0.5, 0.5}, {5.5, 0.5})}));
  for (int column = 0; column < 5; ++column) {
    EXPECT_EQ(grid.at({column, 0}), kFree) << column;
  }
  EXPECT_EQ(grid.at({5, 0}), kOccupied);
  EXPECT_EQ(count(grid, kUnknownPercent), 394U);
}

TEST(LidarGridTest, ABeamFreesNothingWithinTheNoiseOfItsEnd) {
  LidarGridOptions options = smallGrid();
  options.beam_end.range_sigma = 0.5;
  options.beam_end.end_margin = 3.0;
  const LidarGridModel model(options);
  const SensorGrid grid = model.grid(scanWithRays({rayTo({0.5, 0.5}, {5.5, 0.5})}));
  EXPECT_EQ(grid.at({3, 0}), kFree);
  EXPECT_EQ(grid.at({4, 0}), kFree) << "up to 1.5 m before the end, which is its border";
  EXPECT_EQ(grid.at({5, 0}), kOccupied);
  const SensorGrid nearer = model.grid(scanWithRays({rayTo({0.5, 0.5}, {5.3, 0.5})}));
  EXPECT_EQ(nearer.at({3, 0}), kFree);
  EXPECT_EQ(nearer.at({4, 0}), kUnknownPercent);
  EXPECT_EQ(nearer.at({5, 0}), kOccupied);
  // Nearer than that to the scanner it frees nothing, and without a return all of it.
  EXPECT_EQ(count(model.grid(scanWithRays({rayTo({0.5, 0.5}, {1.6, 0.5})})), kFree), 0U);
  EXPECT_EQ(count(model.grid(scanWithRays({rayTo({0.5, 0.5}, {5.5, 0.5}, false)})), kFree), 6U);
  // Of an end beyond the window only the part of the margin inside it counts.
  EXPECT_EQ(count(model.grid(scanWithRays({rayTo({0.5, 0.5}, {10.3, 0.5})})), kFree), 9U);
  EXPECT_EQ(count(model.grid(scanWithRays({rayTo({0.5, 0.5}, {30.5, 0.5})})), kFree), 10U);
}

TEST(LidarGridTest, BesideItsAxisTheMarginCountsFromTheFlatSurface) {
  LidarGridOptions options = smallGrid();
  options.beam_width = 0.2;
  options.min_incidence = std::atan(0.2);  // a line at 0.1 rad is half as long: 4.5 m
  options.beam_end.range_sigma = 0.5;
  options.beam_end.end_margin = 3.0;
  const SensorGrid grid =
      LidarGridModel(options).grid(scanWithRays({rayTo({0.0, 0.9}, {9.0, 0.9})}));
  EXPECT_EQ(grid.at({2, 1}), kFree);
  EXPECT_EQ(grid.at({3, 1}), kUnknownPercent);
  EXPECT_EQ(grid.at({6, 0}), kFree) << "its axis: up to 7.5 m";
}

TEST(LidarGridTest, ABeamWithoutReturnIsFreeUpToItsEnd) {
  const SensorGrid grid =
      LidarGridModel(smallGrid()).grid(scanWithRays({rayTo({0.5, 0.5}, {5.5, 0.5}, false)}));
  EXPECT_EQ(count(grid, kFree), 6U);
  EXPECT_EQ(grid.at({5, 0}), kFree);
  EXPECT_EQ(count(grid, kUnknownPercent), 394U);
}

TEST(LidarGridTest, TheProbabilitiesAreThoseOfTheOptions) {
  LidarGridOptions options = smallGrid();
  options.occupied_probability = 0.9;
  options.free_probability = 0.35;
  const SensorGrid grid =
      LidarGridModel(options).grid(scanWithRays({rayTo({0.5, 0.5}, {5.5, 0.5})}));
  EXPECT_EQ(grid.at({5, 0}), 90);
  EXPECT_EQ(grid.at({2, 0}), 35);
}

TEST(LidarGridTest, ABeamIsOccupiedAcrossItsWidthAtItsEndAndFreeBefore) {
  LidarGridOptions options = smallGrid();
  options.beam_width = 0.2;  // at 9 m: 0.9 m to each side of 0.5
  options.min_incidence = kQuarterTurn;
  const SensorGrid grid =
      LidarGridModel(options).grid(scanWithRays({rayTo({0.0, 0.5}, {9.0, 0.5})}));
  EXPECT_EQ(grid.at({9, 0}), kOccupied);
  EXPECT_EQ(grid.at({8, 1}), kOccupied);   // 9 m at 0.1 rad: (8.955, 1.398)
  EXPECT_EQ(grid.at({8, -1}), kOccupied);  // (8.955, -0.398)
  EXPECT_EQ(grid.at({9, 1}), kUnknownPercent);
  EXPECT_EQ(grid.at({7, 1}), kFree);
  EXPECT_EQ(grid.at({7, -1}), kFree);
  EXPECT_EQ(grid.at({2, 1}), kUnknownPercent);  // the wedge is narrow there
}

TEST(LidarGridTest, BesideItsAxisABeamIsFreeUpToAFlatSurface) {
  LidarGridOptions options = smallGrid();
  options.beam_width = 0.2;
  options.min_incidence = std::atan(0.2);  // a line at 0.1 rad is half as long
  const LidarGridModel model(options);
  const SensorGrid hit = model.grid(scanWithRays({rayTo({0.0, 0.5}, {9.0, 0.5})}));
  EXPECT_EQ(hit.at({7, 0}), kFree);
  EXPECT_EQ(hit.at({7, 1}), kUnknownPercent);
  EXPECT_EQ(hit.at({8, 1}), kOccupied);
}

/// Free cells must not touch unknown ones through the end of a beam.
TEST(LidarGridTest, TheEndOfAWideBeamHasNoGaps) {
  LidarGridOptions options = smallGrid();
  options.window.cell_size = 0.1;
  options.beam_width = 0.2;
  for (const double bearing : {0.3, kPi / 4.0, 1.9, -2.6}) {
    const Point2 end = 9.0 * Point2(std::cos(bearing), std::sin(bearing));
    const SensorGrid grid = LidarGridModel(options).grid(scanWithRays({rayTo({0.0, 0.0}, end)}));
    int ends_of_the_arc = 0;
    grid.forEach([&](CellIndex cell, Percent percent) {
      if (percent != kOccupied) {
        return;
      }
      int neighbors = 0;
      for (const CellIndex side :
           {CellIndex{cell.column + 1, cell.row}, CellIndex{cell.column - 1, cell.row},
            CellIndex{cell.column, cell.row + 1}, CellIndex{cell.column, cell.row - 1}}) {
        neighbors += grid.atOrUnknown(side) == kOccupied ? 1 : 0;
      }
      EXPECT_GE(neighbors, 1);
      ends_of_the_arc += neighbors == 1 ? 1 : 0;
    });
    EXPECT_EQ(ends_of_the_arc, 2) << bearing;
  }
}

TEST(LidarGridTest, WithoutAWidthABeamReachesHalfWayToItsNeighbors) {
  LidarGridOptions options = smallGrid();
  options.beam_width = 0.2;
  const std::vector<Ray> rays = {rayTo({0.0, 0.5}, {9.0, 0.5})};
  const SensorGrid expected = LidarGridModel(options).grid(scanWithRays(rays));
  for (const double spacing : {0.2, -0.2}) {
    EXPECT_EQ(LidarGridModel(smallGrid()).grid(scanWithRays(rays, spacing)).cells(),
              expected.cells());
  }
}

TEST(LidarGridTest, AnEndWinsOverABeamThatPassesWhateverTheirOrder) {
  const Ray near = rayTo({0.5, 0.5}, {3.5, 0.5});
  const Ray far = rayTo({0.5, 0.6}, {7.5, 0.6});
  for (const auto& rays : {std::vector<Ray>{near, far}, std::vector<Ray>{far, near}}) {
    const SensorGrid grid = LidarGridModel(smallGrid()).grid(scanWithRays(rays));
    EXPECT_EQ(grid.at({3, 0}), kOccupied);
    EXPECT_EQ(grid.at({7, 0}), kOccupied);
    EXPECT_EQ(grid.at({5, 0}), kFree);
  }
}

TEST(LidarGridTest, AnEndOutsideOfTheWindowLeavesItFreeUpToItsBorder) {
  for (const double range : {30.0, 1e6}) {
    const SensorGrid grid =
        LidarGridModel(smallGrid()).grid(scanWithRays({rayTo({0.5, 0.5}, {0.5 + range, 0.5})}));
    EXPECT_EQ(count(grid, kFree), 10U) << range;
    EXPECT_EQ(count(grid, kOccupied), 0U) << range;
  }
}

TEST(LidarGridTest, AScannerOutsideTheWindowIsSupported) {
  const SensorGrid grid =
      LidarGridModel(smallGrid()).grid(scanWithRays({rayTo({-20.5, 0.5}, {5.5, 0.5})}));
  EXPECT_EQ(count(grid, kFree), 15U);
  EXPECT_EQ(grid.at({5, 0}), kOccupied);
}

/// Eq. 3.2.1 cell by cell: the beam nearest in bearing decides.
TEST(LidarGridTest, AgreesWithTheThesisAwayFromTheEndsOfTheBeams) {
  LidarGridOptions options;
  options.window.length = 60.0;
  options.window.width = 60.0;
  const double spacing = degrees(2.0);
  Random random(3);
  std::vector<Ray> rays;
  for (int beam = -40; beam <= 40; ++beam) {
    const double range = random.uniform(5.0, 28.0);
    rays.push_back(rayTo(Point2::Zero(), Point2(range * std::cos(beam * spacing),
                                                range * std::sin(beam * spacing))));
  }
  const SensorGrid grid = LidarGridModel(options).grid(scanWithRays(rays, spacing));
  const double margin = 2.0 * options.window.cell_size;
  int compared = 0;
  grid.forEach([&](CellIndex cell, Percent percent) {
    const Point2 center = grid.window().centerOf(cell);
    const double distance = center.norm();
    const double beams = std::atan2(center.y(), center.x()) / spacing;
    const double nearest = std::round(beams);
    const double to_border = (0.5 - std::abs(beams - nearest)) * spacing * distance;
    if (std::abs(nearest) > 40.0 || to_border < margin) {
      return;
    }
    const double range = rays[static_cast<std::size_t>(nearest + 40.0)].range;
    if (std::abs(distance - range) < margin) {
      return;
    }
    ++compared;
    EXPECT_EQ(percent, distance < range ? kFree : kUnknownPercent)
        << cell.column << ", " << cell.row;
  });
  EXPECT_GT(compared, 100);
}

TEST(LidarGridTest, RefusesOptionsOutOfBounds) {
  LidarGridOptions options;
  options.free_probability = 0.6;
  EXPECT_THROW(LidarGridModel{options}, OptionError);
}

}  // namespace
}  // namespace datmo::lidar_grid_test
