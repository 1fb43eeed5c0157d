// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/cloud_to_scan.h"

#include <cmath>

#include "lidar_samples.h"
#include <gtest/gtest.h>

namespace datmo::cloud_to_scan_test {
namespace {

using samples::LidarCloudMaker;

/// Beams of 1 degree, all around; the lidar is 0.5 m ahead of the vehicle's origin.
CloudToScanOptions oneDegree() {
  CloudToScanOptions options;
  options.beam_spacing = degrees(1.0);
  return options;
}

/// The range of the beam that faces `bearing` (rad).
float rangeAt(const PlanarScan& scan, double bearing) {
  const auto count = static_cast<double>(scan.ranges.size());
  double steps = std::round((bearing - scan.first_bearing) / scan.beam_spacing);
  steps -= count * std::floor(steps / count);
  return scan.ranges.at(static_cast<std::size_t>(steps));
}

TEST(CloudToScanTest, AWallOnAFlatRoadIsAtItsDistance) {
  LidarCloudMaker maker;
  maker.addGround();
  maker.addWall(10.5);
  const PlanarScan scan = CloudToScan(oneDegree()).scan(maker.cloud);
  ASSERT_EQ(scan.ranges.size(), 360U);
  EXPECT_TRUE(scan.ground.seen);
  EXPECT_NEAR(rangeAt(scan, 0.0), 10.0F, 0.01F);
  EXPECT_TRUE(std::isinf(rangeAt(scan, degrees(90.0)))) << "road alone";
  EXPECT_EQ(scan.blind_beams, 0U);
  EXPECT_EQ(scan.beam_time, 0.0);
}

TEST(CloudToScanTest, OnlyTheBandCounts) {
  LidarCloudMaker maker;
  maker.addGround();
  maker.add(5.5, 0.0, 0.1);   // curb
  maker.add(6.5, 0.0, 2.5);   // sign
  maker.add(12.5, 0.0, 0.6);  // obstacle
  maker.add(14.5, 0.0, 0.6);  // behind it
  const PlanarScan scan = CloudToScan(oneDegree()).scan(maker.cloud);
  EXPECT_NEAR(rangeAt(scan, 0.0), 12.0F, 1e-3F);
  EXPECT_EQ(scan.band_points, 2U);
}

TEST(CloudToScanTest, HeightsAreAboveTheSlopingRoad) {
  LidarCloudMaker maker;
  maker.addGround(0.0, 0.05, 0.0);
  maker.add(20.5, 0.0, 0.05 * 20.5 + 0.1);  // a curb, 1.1 m above the vehicle's z = 0
  maker.add(25.5, 0.0, 0.05 * 25.5 + 0.6);
  const PlanarScan scan = CloudToScan(oneDegree()).scan(maker.cloud);
  ASSERT_TRUE(scan.ground.seen);
  EXPECT_NEAR(rangeAt(scan, 0.0), 25.0F, 1e-3F);
}

TEST(CloudToScanTest, ATiltedLidarSeesTheSame) {
  LidarCloudMaker maker(samples::lidarMount(degrees(15.0)));
  maker.addGround();
  maker.addWall(10.5);
  const PlanarScan scan = CloudToScan(oneDegree()).scan(maker.cloud);
  EXPECT_NEAR(rangeAt(scan, 0.0), 10.0F, 0.01F);
}

TEST(CloudToScanTest, WithoutRoadTheMountsPlaneIsUsed) {
  LidarCloudMaker maker;
  maker.addWall(10.5);
  const PlanarScan scan = CloudToScan(oneDegree()).scan(maker.cloud);
  EXPECT_FALSE(scan.ground.seen);
  EXPECT_NEAR(rangeAt(scan, 0.0), 10.0F, 0.01F);
}

TEST(CloudToScanTest, TheOwnVehicleIsLeftOut) {
  LidarCloudMaker maker;
  maker.addGround();
  CloudToScanOptions options = oneDegree();
  options.min_range = 0.0;
  options.vehicle = {-1.0, 2.5, 1.0};
  maker.add(2.4, 0.0, 0.8);  // hood
  maker.add(8.5, 0.0, 0.8);
  const PlanarScan scan = CloudToScan(options).scan(maker.cloud);
  EXPECT_NEAR(rangeAt(scan, 0.0), 8.0F, 1e-3F);
  EXPECT_EQ(scan.own_points, 1U);
}

TEST(CloudToScanTest, BeamsWithoutPointsAreBlind) {
  LidarCloudMaker maker;
  maker.addWall(5.5);  // 11.3 degrees to either side of the lidar
  CloudToScanOptions options = oneDegree();
  options.blind_width = degrees(2.0);
  const PlanarScan scan = CloudToScan(options).scan(maker.cloud);
  EXPECT_FALSE(std::isnan(rangeAt(scan, degrees(11.0))));
  EXPECT_TRUE(std::isinf(rangeAt(scan, degrees(13.0)))) << "near a beam that sees";
  EXPECT_TRUE(std::isnan(rangeAt(scan, degrees(15.0))));
  EXPECT_TRUE(std::isnan(rangeAt(scan, degrees(180.0))));
  EXPECT_GT(scan.blind_beams, 300U);
}

TEST(CloudToScanTest, AnEmptyCloudIsBlindAllAround) {
  const PlanarScan scan = CloudToScan(oneDegree()).scan(LidarCloud());
  EXPECT_EQ(scan.blind_beams, 360U);
}

TEST(CloudToScanTest, RangesEndWhereTheScannerDoes) {
  LidarCloudMaker maker;
  maker.addGround();
  maker.add(1.0, 0.0, 0.6);   // 0.5 m: too near
  maker.add(61.0, 0.0, 0.6);  // too far
  const PlanarScan scan = CloudToScan(oneDegree()).scan(maker.cloud);
  EXPECT_TRUE(std::isinf(rangeAt(scan, 0.0)));
}

TEST(CloudToScanTest, APartOfATurnIsSymmetricAboutAhead) {
  LidarCloudMaker maker;
  maker.addGround();
  maker.addWall(10.5);
  CloudToScanOptions options = oneDegree();
  options.field_of_view = degrees(160.0);
  const PlanarScan scan = CloudToScan(options).scan(maker.cloud);
  ASSERT_EQ(scan.ranges.size(), 161U);
  EXPECT_NEAR(scan.first_bearing, degrees(-80.0), 1e-9);
  EXPECT_NEAR(scan.ranges[80], 10.0F, 0.01F);
}

TEST(CloudToScanTest, ThinBeamsMissPointsBetweenThem) {
  LidarCloudMaker maker;
  maker.addGround();
  maker.add(0.5 + 10.0 * std::cos(degrees(0.4)), 10.0 * std::sin(degrees(0.4)), 0.6);
  CloudToScanOptions options = oneDegree();
  EXPECT_NEAR(rangeAt(CloudToScan(options).scan(maker.cloud), 0.0), 10.0F, 1e-3F);
  options.beam_width = degrees(0.5);
  EXPECT_TRUE(std::isinf(rangeAt(CloudToScan(options).scan(maker.cloud), 0.0)));
}

TEST(CloudToScanTest, ATurnFromTheManualTimesTheBeams) {
  LidarCloudMaker maker;
  maker.addGround();
  CloudToScanOptions options = oneDegree();
  options.field_of_view = degrees(160.0);
  options.sweep = {0.1, true, kPi, 0.5};
  const PlanarScan scan = CloudToScan(options).scan(maker.cloud);
  EXPECT_NEAR(scan.first_bearing, degrees(80.0), 1e-9) << "it turns to the right";
  EXPECT_LT(scan.beam_spacing, 0.0);
  EXPECT_NEAR(scan.beam_time, 0.1 / 360.0, 1e-9);
  EXPECT_NEAR(scan.first_time, -80.0 * 0.1 / 360.0, 1e-9) << "ahead at the stamp";
}

TEST(CloudToScanTest, AWholeTurnBeginsAtTheLidarsSeam) {
  LidarCloudMaker maker;
  maker.addGround();
  CloudToScanOptions options = oneDegree();
  options.sweep = {0.1, true, degrees(90.0), 0.0};
  const PlanarScan scan = CloudToScan(options).scan(maker.cloud);
  ASSERT_EQ(scan.ranges.size(), 360U);
  EXPECT_NEAR(scan.first_bearing, degrees(89.5), 1e-6);
  EXPECT_NEAR(scan.first_time, 0.5 * 0.1 / 360.0, 1e-6);
  EXPECT_FALSE(scan.sweep_ends_inside);
}

TEST(CloudToScanTest, ATurnThatEndsAheadHasNoBeamTimes) {
  LidarCloudMaker maker;
  maker.addGround();
  CloudToScanOptions options = oneDegree();
  options.field_of_view = degrees(160.0);
  options.sweep = {0.1, true, 0.0, 0.0};
  const PlanarScan scan = CloudToScan(options).scan(maker.cloud);
  EXPECT_TRUE(scan.sweep_ends_inside);
  EXPECT_EQ(scan.beam_time, 0.0);
}

TEST(CloudToScanTest, WrongOptionsAreNamed) {
  CloudToScanOptions options;
  options.min_height = 1.0;
  EXPECT_THROW(CloudToScan{options}, OptionError);
  options = {};
  options.min_range = 60.0;
  EXPECT_THROW(CloudToScan{options}, OptionError);
  options = {};
  options.beam_width = degrees(5.0);
  EXPECT_THROW(CloudToScan{options}, OptionError);
}

}  // namespace
}  // namespace datmo::cloud_to_scan_test
