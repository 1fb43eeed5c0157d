// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/laser_scanner.h"

#include <cmath>

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::laser_scanner_test {
namespace {

LaserScanner scannerWith(const LaserScannerOptions& options) {
  return {options, RandomStream(1, "scanner")};
}

TEST(LaserScanner, HasTheBeamsOfBothConfigurations) {
  LaserScannerOptions options;
  EXPECT_EQ(options.beamCount(), 81);
  options.beam_spacing = 1.0;
  EXPECT_EQ(options.beamCount(), 161);
}

TEST(LaserScanner, WallAheadIsMeasuredFromRightToLeft) {
  World world = emptyWorld();
  world.addSolid(wallAt(10.0));
  world.addSolid({Segment{{-50.0, 5.0}, {50.0, 5.0}}, 3.0, Surface::kBody, kNoObject});
  const EchoScan scan = scannerWith(idealScanner()).measure(world, 0.0);
  ASSERT_EQ(scan.beams.size(), 81U);
  EXPECT_NEAR(middleBeam(scan).at(0).range, 10.0, 1e-9);
  EXPECT_NEAR(scan.beams[80].at(0).range, 5.0 / std::sin(degrees(80.0)), 1e-9);
  EXPECT_NEAR(scan.beams[20].at(0).range, 10.0 / std::cos(degrees(40.0)), 1e-9);
}

TEST(LaserScanner, SitsWhereItIsMounted) {
  World world = emptyWorld();
  world.addSolid(wallAt(10.0));
  LaserScannerOptions options = idealScanner();
  options.mount_x = 3.5;
  EXPECT_NEAR(middleBeam(scannerWith(options).measure(world, 0.0)).at(0).range, 6.5, 1e-9);
}

TEST(LaserScanner, NothingOutsideItsRanges) {
  LaserScannerOptions options = idealScanner();
  for (const double x : {0.9, 50.1}) {
    World world = emptyWorld();
    world.addSolid(wallAt(x));
    EXPECT_TRUE(middleBeam(scannerWith(options).measure(world, 0.0)).empty()) << x;
  }
  options.effective_range = 150.0;
  World world = emptyWorld();
  world.addSolid(wallAt(50.1));
  EXPECT_EQ(middleBeam(scannerWith(options).measure(world, 0.0)).size(), 1U);
}

TEST(LaserScanner, SecondPlaneSeesOverALowObstacle) {
  // At 20 m the second plane's lower edge is 0.45 + 20 tan(1.5 deg) = 0.97 m high.
  for (const double height : {0.9, 1.1}) {
    World world = emptyWorld();
    world.addSolid(wallAt(20.0, height));
    world.addSolid(wallAt(30.0));
    const auto echoes = middleBeam(scannerWith(idealScanner()).measure(world, 0.0));
    ASSERT_EQ(echoes.size(), height < 1.0 ? 2U : 1U);
    EXPECT_NEAR(echoes.front().range, 20.0, 1e-9);
    EXPECT_NEAR(echoes.back().range, height < 1.0 ? 30.0 : 20.0, 1e-9);
  }
}

TEST(LaserScanner, TargetsNearerToEachOtherThanTheThresholdAreOne) {
  World world = emptyWorld();
  world.addSolid(wallAt(20.0, 0.9));
  world.addSolid(wallAt(20.8));
  EXPECT_EQ(middleBeam(scannerWith(idealScanner()).measure(world, 0.0)).size(), 1U);
}

TEST(LaserScanner, WideBeamHitsTwoTargetsBesideEachOther) {
  // The left half of the beam ends at 10 m, its right half at 15 m.
  World world = emptyWorld();
  world.addSolid({Segment{{10.0, 0.0}, {10.0, 5.0}}, 3.0, Surface::kBody, kNoObject});
  world.addSolid(wallAt(15.0));
  LaserScannerOptions options = idealScanner();
  options.horizontal_opening = 1.0;
  options.sub_rays = 10;
  const auto echoes = middleBeam(scannerWith(options).measure(world, 0.0));
  ASSERT_EQ(echoes.size(), 2U);
  EXPECT_NEAR(echoes[0].range, 10.0, 0.01);
  EXPECT_NEAR(echoes[1].range, 15.0, 0.01);
  options.echoes = 1;
  EXPECT_EQ(middleBeam(scannerWith(options).measure(world, 0.0)).size(), 1U);
}

/// Returns the share of many scans in which the beam ahead has an echo.
double hitShare(const World& world, const LaserScannerOptions& options) {
  constexpr int kScans = 4000;
  LaserScanner scanner = scannerWith(options);
  int hits = 0;
  for (int i = 0; i < kScans; ++i) {
    hits += middleBeam(scanner.measure(world, 0.0)).empty() ? 0 : 1;
  }
  return static_cast<double>(hits) / kScans;
}

TEST(LaserScanner, DetectionFallsWithAngularWidth) {
  // A pole as wide as a fifth of the beam, required share 0.4: seen with probability 0.5 in a
  // plane.
  LaserScannerOptions options = idealScanner();
  options.horizontal_opening = 1.0;
  options.sub_rays = 5;
  options.full_detection_share = 0.4;
  options.second_plane_pitch = 0.0;
  World world = emptyWorld();
  const double width = 0.2 * degrees(1.0) * 20.0;
  world.addSolid({Circle{{20.0, 0.0}, 0.5 * width}, 3.0, Surface::kBody, kNoObject});
  EXPECT_NEAR(hitShare(world, options), 1.0 - 0.5 * 0.5, 0.03);

  World wide = emptyWorld();
  wide.addSolid({Circle{{20.0, 0.0}, 1.5 * width}, 3.0, Surface::kBody, kNoObject});
  EXPECT_DOUBLE_EQ(hitShare(wide, options), 1.0);
}

TEST(LaserScanner, CurbReflectsSometimesAndOnlyWhereItIsLit) {
  LaserScannerOptions options = idealScanner();
  options.curb_hit_probability = 0.3;
  // The lower edge of the beam comes down to 0.12 m at 0.33 / tan(1.5 deg) = 12.6 m.
  for (const double x : {12.0, 13.0}) {
    World world = emptyWorld();
    world.addSolid({Segment{{x, -50.0}, {x, 50.0}}, 0.12, Surface::kCurb, kNoObject});
    EXPECT_NEAR(hitShare(world, options), x < 12.6 ? 0.0 : 0.3, 0.03);
  }
}

TEST(LaserScanner, PaintReflectsByMistakeWithinItsRange) {
  LaserScannerOptions options = idealScanner();
  options.paint_hit_probability = 0.2;
  options.paint_range = 30.0;
  // The beam touches the road from 0.45 / tan(1.5 deg) = 17.2 m on.
  for (const double x : {15.0, 25.0, 35.0}) {
    World world = emptyWorld();
    world.addSolid({Box2{{x, 0.0, 0.0}, 3.0, 0.5}, 0.0, Surface::kPaint, kNoObject});
    EXPECT_NEAR(hitShare(world, options), x == 25.0 ? 0.2 : 0.0, 0.03) << x;
  }
}

TEST(LaserScanner, PaintBehindABodyIsHidden) {
  LaserScannerOptions options = idealScanner();
  options.paint_hit_probability = 1.0;
  World world = emptyWorld();
  world.addSolid(wallAt(20.0));
  world.addSolid({Box2{{25.0, 0.0, 0.0}, 3.0, 0.5}, 0.0, Surface::kPaint, kNoObject});
  const auto echoes = middleBeam(scannerWith(options).measure(world, 0.0));
  ASSERT_EQ(echoes.size(), 1U);
  EXPECT_NEAR(echoes[0].range, 20.0, 1e-9);
}

TEST(LaserScanner, EchoKnowsWhatItCameFrom) {
  LaserScannerOptions options = idealScanner();
  options.range_noise = 0.5;
  options.curb_hit_probability = 1.0;
  options.paint_hit_probability = 1.0;
  for (const Surface surface : {Surface::kBody, Surface::kCurb, Surface::kPaint}) {
    World world = emptyWorld();
    world.addSolid({Box2{{21.0, 0.0, 0.0}, 2.0, 4.0}, 0.12, surface, 5});
    const Echo echo = middleBeam(scannerWith(options).measure(world, 0.0)).at(0);
    EXPECT_EQ(echo.surface, surface);
    EXPECT_EQ(echo.object, 5U);
    EXPECT_NEAR(echo.true_range, 20.0, 1e-9);
    EXPECT_NE(echo.range, echo.true_range);
  }
}

TEST(LaserScanner, NoiseIsLargerAlongTheBeamThanAcross) {
  LaserScannerOptions options;
  options.mount_x = 0.0;
  LaserScannerOptions still = idealScanner();
  still.range_noise = options.range_noise;
  World world = emptyWorld();
  world.addSolid(wallAt(20.0));
  LaserScanner scanner = scannerWith(still);
  double square_sum = 0.0;
  constexpr int kScans = 4000;
  for (int i = 0; i < kScans; ++i) {
    const double error = middleBeam(scanner.measure(world, 0.0)).at(0).range - 20.0;
    square_sum += error * error;
  }
  EXPECT_NEAR(std::sqrt(square_sum / kScans), options.range_noise, 0.01);
  const double across = 20.0 * degrees(std::hypot(options.azimuth_noise, options.azimuth_shake));
  EXPECT_GT(options.range_noise, 2.0 * across);
}

TEST(LaserScanner, ShakeTurnsAllBeamsOfAScanAlike) {
  // A beam of a given bearing on a wall across x: range = x / cos(bearing + shake).
  LaserScannerOptions options = idealScanner();
  options.azimuth_shake = 0.5;
  World world = emptyWorld();
  world.addSolid(wallAt(10.0));
  LaserScanner scanner = scannerWith(options);
  double square_sum = 0.0;
  constexpr int kScans = 2000;
  for (int i = 0; i < kScans; ++i) {
    const EchoScan scan = scanner.measure(world, 0.0);
    const double left = std::acos(10.0 / scan.beams[60].at(0).range) - degrees(40.0);
    const double right = degrees(40.0) - std::acos(10.0 / scan.beams[20].at(0).range);
    ASSERT_NEAR(left, right, 1e-9);
    square_sum += left * left;
  }
  EXPECT_NEAR(toDegrees(std::sqrt(square_sum / kScans)), 0.5, 0.03);
}

TEST(LaserScanner, NoddingLosesALowWall) {
  LaserScannerOptions options = idealScanner();
  options.vertical_opening = 0.2;
  options.second_plane_pitch = 0.0;
  World world = emptyWorld();
  world.addSolid(wallAt(20.0, 0.5));
  EXPECT_DOUBLE_EQ(hitShare(world, options), 1.0);
  options.pitch_shake = 1.0;
  const double share = hitShare(world, options);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.8);
}

TEST(LaserScanner, SweptBeamsSeeTheVehicleMove) {
  LaserScannerOptions options = idealScanner();
  World world(RoadNetwork(), egoAlongX(10.0));
  world.addSolid(wallAt(20.0));
  EXPECT_NEAR(middleBeam(scannerWith(options).measure(world, 0.0)).at(0).range, 20.0, 1e-9);
  options.sweep_duration = 0.06;
  EXPECT_NEAR(middleBeam(scannerWith(options).measure(world, 0.0)).at(0).range, 19.7, 1e-9);
}

TEST(LaserScanner, ContradictionsAreRefused) {
  LaserScannerOptions options;
  options.min_range = 10.0;
  options.effective_range = 5.0;
  EXPECT_THROW(scannerWith(options), OptionError);
  options = LaserScannerOptions();
  options.sweep_duration = 0.1;
  EXPECT_THROW(scannerWith(options), OptionError);
}

}  // namespace
}  // namespace datmo::simulator::laser_scanner_test
