// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>
#include <vector>

#include "small_map.h"
#include <gtest/gtest.h>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo::map_surface_test {
namespace {

using samples::scanTo;
using samples::smallMap;
using samples::updateWith;

/// A wall along x through the middle of the cells of row 5, seen from the origin, and a beam from
/// one point to another, without return, through the cell {3, 5} of it.
double occupancyAfterABeam(double surface_sigma, const Point2& from, const Point2& to) {
  OccupancyMapOptions options = smallMap();
  options.surface_sigma = surface_sigma;
  OccupancyMap map(options);
  updateWith(map, scanTo({{3.1, 5.5}, {3.3, 5.5}, {3.5, 5.5}, {3.7, 5.5}, {3.9, 5.5}}));
  Scan passing = scanTo({to}, 0.1, false);
  passing.rays.front().origin = from;
  updateWith(map, passing);
  return map.occupancy({3, 5});
}

TEST(MapSurfaceTest, ABeamThatPassesBesideASurfaceDoesNotFreeIt) {
  // In the wall's cells, but 0.3 m in front of it: 6 standard deviations.
  EXPECT_NEAR(occupancyAfterABeam(0.05, {0.0, 5.2}, {9.0, 5.2}), 0.8, 1e-6);
  // One standard deviation beside it: the step counts by exp(-1/2).
  const double hit = std::log(0.8 / 0.2);
  const double pass = std::log(0.4 / 0.6);
  const double log_odds = hit + std::exp(-0.5) * pass;
  EXPECT_NEAR(occupancyAfterABeam(0.05, {0.0, 5.45}, {9.0, 5.45}),
              1.0 / (1.0 + std::exp(-log_odds)), 1e-5);
}

TEST(MapSurfaceTest, TheOrderOfTheBeamsDoesNotMatter) {
  // One beam passes beside the wall, one through it.
  const auto occupancyAfter = [](const std::vector<std::pair<Point2, Point2>>& beams) {
    OccupancyMapOptions options = smallMap();
    options.surface_sigma = 0.05;
    OccupancyMap map(options);
    updateWith(map, scanTo({{3.1, 5.5}, {3.3, 5.5}, {3.5, 5.5}, {3.7, 5.5}, {3.9, 5.5}}));
    Scan scan = scanTo({beams[0].second, beams[1].second}, 0.1, false);
    scan.rays[0].origin = beams[0].first;
    scan.rays[1].origin = beams[1].first;
    updateWith(map, scan);
    return map.occupancy({3, 5});
  };
  const std::pair<Point2, Point2> beside{{0.0, 5.2}, {9.0, 5.2}};
  const std::pair<Point2, Point2> through{{3.5, 0.0}, {3.5, 9.0}};
  const double freed = 1.0 / (1.0 + std::exp(-std::log(0.8 / 0.2) - std::log(0.4 / 0.6)));
  EXPECT_NEAR(occupancyAfter({beside, through}), freed, 1e-5);
  EXPECT_NEAR(occupancyAfter({through, beside}), freed, 1e-5);
}

TEST(MapSurfaceTest, ABeamThroughASurfaceFreesItsCell) {
  const double through = 1.0 / (1.0 + std::exp(-std::log(0.8 / 0.2) - std::log(0.4 / 0.6)));
  EXPECT_NEAR(occupancyAfterABeam(0.05, {3.5, 0.0}, {3.5, 9.0}), through, 1e-5);
  EXPECT_NEAR(occupancyAfterABeam(0.0, {0.0, 5.2}, {9.0, 5.2}), through, 1e-5);
}

}  // namespace
}  // namespace datmo::map_surface_test
