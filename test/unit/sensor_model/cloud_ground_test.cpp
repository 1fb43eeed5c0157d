// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/cloud_ground.h"

#include <numeric>

#include "lidar_samples.h"
#include <gtest/gtest.h>

namespace datmo::cloud_ground_test {
namespace {

using samples::LidarCloudMaker;

CloudGround groundOf(const LidarCloudMaker& maker, const CloudGroundOptions& options = {}) {
  const LidarPoints::Ptr points = toBase(maker.cloud);
  std::vector<int> all(points->size());
  std::iota(all.begin(), all.end(), 0);
  return findGround(*points, all, options);
}

TEST(CloudGroundTest, AFlatRoadIsFlat) {
  LidarCloudMaker maker;
  maker.addGround();
  const CloudGround ground = groundOf(maker);
  ASSERT_TRUE(ground.seen);
  EXPECT_NEAR(ground.plane.height, 0.0, 1e-3);
  EXPECT_NEAR(ground.plane.slope_x, 0.0, 1e-4);
  EXPECT_NEAR(ground.plane.slope_y, 0.0, 1e-4);
}

TEST(CloudGroundTest, ASlopeIsFoundBeforeAWall) {
  LidarCloudMaker maker;
  maker.addGround(0.1, 0.03, -0.02);
  maker.addWall(8.0);
  const CloudGround ground = groundOf(maker);
  ASSERT_TRUE(ground.seen);
  EXPECT_NEAR(ground.plane.height, 0.1, 0.02);
  EXPECT_NEAR(ground.plane.slope_x, 0.03, 2e-3);
  EXPECT_NEAR(ground.plane.slope_y, -0.02, 2e-3);
}

TEST(CloudGroundTest, ATiltedMountDoesNotTiltTheRoad) {
  LidarCloudMaker maker(samples::lidarMount(degrees(20.0)));
  maker.addGround();
  const CloudGround ground = groundOf(maker);
  ASSERT_TRUE(ground.seen);
  EXPECT_NEAR(ground.plane.height, 0.0, 1e-3);
  EXPECT_NEAR(ground.plane.slope_x, 0.0, 1e-4);
}

TEST(CloudGroundTest, SteepSurfacesAreNoRoad) {
  LidarCloudMaker maker;
  maker.addGround(0.0, 0.3, 0.0);
  const CloudGround ground = groundOf(maker);
  EXPECT_FALSE(ground.seen);
  EXPECT_EQ(ground.plane.height, 0.0);
  EXPECT_EQ(ground.plane.slope_x, 0.0);
}

TEST(CloudGroundTest, HighSurfacesAreNoRoad) {
  LidarCloudMaker maker;
  maker.addGround(0.8);
  EXPECT_FALSE(groundOf(maker).seen);
}

TEST(CloudGroundTest, TooFewPointsAreNoRoad) {
  LidarCloudMaker maker;
  maker.addWall(8.0);
  EXPECT_FALSE(groundOf(maker).seen);
}

TEST(CloudGroundTest, RoadEstimationCanBeDisabled) {
  LidarCloudMaker maker;
  maker.addGround(0.1);
  CloudGroundOptions options;
  options.estimate = false;
  EXPECT_FALSE(groundOf(maker, options).seen);
}

TEST(CloudGroundTest, TheSameCloudGivesTheSamePlane) {
  LidarCloudMaker maker;
  maker.addGround(0.05, 0.01, 0.02);
  maker.addWall(6.0);
  const CloudGround once = groundOf(maker);
  const CloudGround again = groundOf(maker);
  EXPECT_EQ(once.plane.height, again.plane.height);
  EXPECT_EQ(once.plane.slope_x, again.plane.slope_x);
  EXPECT_EQ(once.voxels, again.voxels);
}

}  // namespace
}  // namespace datmo::cloud_ground_test
