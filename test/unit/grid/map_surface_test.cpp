// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>
#include <vector>

#include "small_map.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"
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

TEST(MapSurfaceTest, ABeamPassesThroughAStaticSurfaceWellInFrontOfItsEnd) {
  OccupancyMapOptions options = smallMap();
  options.surface_sigma = 0.1;
  OccupancyMap map(options);
  const auto sees_through = [&map](const Point2& end, bool hit = true) {
    return map.seesThrough(scanTo({end}, 2.0, hit).rays.front(), Pose2());
  };
  updateWith(map, scanTo({{5.5, 0.5}}));
  EXPECT_FALSE(sees_through({8.8, 0.8})) << "hit once: it may be a mover";
  updateWith(map, scanTo({{5.5, 0.5}}, 1.0));
  EXPECT_TRUE(sees_through({8.8, 0.8}));
  EXPECT_TRUE(sees_through({8.8, 0.8}, false)) << "without return";
  EXPECT_FALSE(sees_through({5.6, 0.51})) << "it hit the surface";
  EXPECT_FALSE(sees_through({4.4, 0.4})) << "something in front of the surface";
  EXPECT_FALSE(sees_through({8.8, 1.3})) << "past its edge";
}

TEST(MapSurfaceTest, ABeamFreesNothingWithinTheNoiseOfItsEnd) {
  OccupancyMapOptions options = smallMap();
  options.beam_end.range_sigma = 0.5;
  options.beam_end.end_margin = 3.0;
  OccupancyMap map(options);
  updateWith(map, scanTo({{8.5, 0.5}}));
  EXPECT_NEAR(map.occupancy({6, 0}), 0.4, 1e-6);
  EXPECT_DOUBLE_EQ(map.occupancy({7, 0}), 0.5) << "1 m before the end";
  EXPECT_NEAR(map.occupancy({8, 0}), 0.8, 1e-6);
  // Nearer than that to the scanner it frees nothing.
  updateWith(map, scanTo({{0.5, 1.2}}, 0.1));
  EXPECT_NEAR(map.occupancy({0, 0}), 0.4, 1e-6);
}

/// Offset (m) at which the surface of a wall, hit by a beam at right angles with noise of one cell,
/// is mapped too far away.
double biasOfANoisyWall(double end_margin) {
  constexpr double kNoise = 0.2;
  constexpr double kWall = 8.1;
  OccupancyMapOptions options = smallMap();
  options.window.cell_size = kNoise;
  options.beam_end.range_sigma = kNoise;
  options.beam_end.end_margin = end_margin;
  OccupancyMap map(options);
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const Scan scan = scanTo({{kWall + random.normal(kNoise), 0.1}}, 0.06 * i);
    map.update(scan, {map.judge(scan.rays.front().end)}, Pose2());
  }
  double sum = 0.0;
  double hits = 0.0;
  for (double x = 7.1; x < 9.2; x += kNoise) {
    if (const auto surface = map.nearestHits({x, 0.1});
        surface && map.occupancy(map.window().cellAt({x, 0.1})) > 0.5) {
      sum += surface->hits * (surface->mean.x() - kWall);
      hits += surface->hits;
    }
  }
  return sum / hits;
}

TEST(MapSurfaceTest, ABeamOfNoLengthFreesNothing) {
  for (const double range_sigma : {0.0, 0.5}) {
    OccupancyMapOptions options = smallMap();
    options.beam_end.range_sigma = range_sigma;
    OccupancyMap map(options);
    updateWith(map, scanTo({{0.0, 0.0}}));
    EXPECT_DOUBLE_EQ(map.occupancy({0, -1}), 0.5);
    EXPECT_DOUBLE_EQ(map.occupancy({0, 1}), 0.5);
  }
}

TEST(MapSurfaceTest, NoiseDoesNotPushASurfaceAway) {
  EXPECT_GT(biasOfANoisyWall(0.0), 0.1) << "only hits behind it stay";
  EXPECT_LT(std::abs(biasOfANoisyWall(3.0)), 0.03);
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
