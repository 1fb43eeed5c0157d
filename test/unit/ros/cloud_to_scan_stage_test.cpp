// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/cloud_to_scan_stage.h"

#include <cmath>

#include "cloud_stage_sample.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/scan_conversion.h"

namespace datmo::cloud_to_scan_stage_test {
namespace {

using samples::kStart;

class CloudToScanStageTest : public samples::CloudStageTest<CloudToScanStage> {
 protected:
  /// A time for each point, of a turn to the right that begins behind the lidar.
  std::vector<float> turn() const {
    const SweepTiming sweep{kPi, true, 0.1, -0.05};
    std::vector<float> times;
    for (const pcl::PointXYZ& point : *maker_.cloud.points) {
      times.push_back(static_cast<float>(sweep.timeAt(std::atan2(point.y, point.x))));
    }
    return times;
  }
};

TEST_F(CloudToScanStageTest, ACloudMakesAScanBelowTheLidar) {
  mountLidar();
  const auto output = stage_.handleCloud(cloudAt(kStart));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->scan->header.frame_id, "cloud_scan");
  EXPECT_EQ(output->scan->header.stamp, ros::Time(kStart));
  EXPECT_EQ(output->scan->ranges.size(), 720U);
  ASSERT_TRUE(output->mount);
  EXPECT_EQ(output->mount->header.frame_id, "base_link");
  EXPECT_EQ(output->mount->child_frame_id, "cloud_scan");
  EXPECT_NEAR(output->mount->transform.translation.x, 0.5, 1e-9);
  EXPECT_NEAR(output->mount->transform.translation.z, 0.6, 1e-9) << "the middle of the band";
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.figures().at("ground seen, 0 or 1"), 1.0);
}

TEST_F(CloudToScanStageTest, TheScanIsAcceptedByTheNextStages) {
  mountLidar();
  const auto output = stage_.handleCloud(cloudAt(kStart));
  ASSERT_TRUE(output);
  ScannerMount mount;
  mount.scanner_in_base = {0.5, 0.0, 0.0};
  const ConvertedScan scan = toScan(*output->scan, mount, ScanConversionOptions());
  double nearest = 100.0;
  for (const Ray& ray : scan.scan.rays) {
    if (ray.hit) {
      nearest = std::min(nearest, ray.end.x());
    }
  }
  EXPECT_NEAR(nearest, 10.5, 0.02);
}

TEST_F(CloudToScanStageTest, TheMountIsPublishedOnce) {
  mountLidar();
  EXPECT_TRUE(stage_.handleCloud(cloudAt(kStart))->mount);
  EXPECT_FALSE(stage_.handleCloud(cloudAt(kStart + 0.1))->mount);
}

TEST_F(CloudToScanStageTest, TimesOfPointsBecomeTimesOfBeams) {
  mountLidar();
  auto message = cloudAt(kStart);
  samples::addTimes(message, "time", sensor_msgs::PointField::FLOAT32, turn());
  const auto output = stage_.handleCloud(message);
  ASSERT_TRUE(output);
  const sensor_msgs::LaserScan& scan = *output->scan;
  EXPECT_NEAR(scan.time_increment, 0.1 / 720.0, 2e-6);
  EXPECT_NEAR((scan.header.stamp - ros::Time(kStart)).toSec(), -0.05, 1e-3);
  EXPECT_LT(scan.angle_increment, 0.0F) << "it turns to the right";
  const double ahead = std::round((0.0 - scan.angle_min) / scan.angle_increment);
  const double wrapped = ahead < 0.0 ? ahead + 720.0 : ahead;
  EXPECT_NEAR(wrapped * scan.time_increment - 0.05, 0.0, 1e-3) << "ahead at the cloud's stamp";
  EXPECT_EQ(monitor_.warningCount(), 0U);
}

TEST_F(CloudToScanStageTest, ThereIsAWarningOfTimesThatAreNoTurn) {
  mountLidar();
  auto message = cloudAt(kStart);
  samples::addTimes(message, "time", sensor_msgs::PointField::FLOAT32,
                    std::vector<float>(maker_.cloud.points->size(), 0.0F));
  ASSERT_TRUE(stage_.handleCloud(message));
  EXPECT_EQ(samples::warnings(monitor_, "uneven_point_times"), 1U);
}

TEST_F(CloudToScanStageTest, WithoutGroundItContinuesAndReportsIt) {
  mountLidar();
  maker_ = samples::LidarCloudMaker();
  maker_.addWall(10.5);
  ASSERT_TRUE(stage_.handleCloud(cloudAt(kStart)));
  EXPECT_EQ(samples::warnings(monitor_, "no_ground"), 1U);
}

TEST_F(CloudToScanStageTest, BadCloudsAreDropped) {
  EXPECT_FALSE(stage_.handleCloud(cloudAt(kStart)));
  EXPECT_EQ(samples::drops(monitor_, "missing_transform"), 1U);
  mountLidar();
  EXPECT_FALSE(stage_.handleCloud(cloudAt(0.0)));
  EXPECT_EQ(samples::drops(monitor_, "zero_stamp"), 1U);
  auto empty = cloudAt(kStart);
  empty.width = 0;
  EXPECT_FALSE(stage_.handleCloud(empty));
  EXPECT_EQ(samples::drops(monitor_, "empty_cloud"), 1U);
  EXPECT_TRUE(stage_.handleCloud(cloudAt(kStart)));
  EXPECT_FALSE(stage_.handleCloud(cloudAt(kStart)));
  EXPECT_EQ(samples::drops(monitor_, "repeated_stamp"), 1U);
}

TEST_F(CloudToScanStageTest, AScanInTheVehiclesFrameIsRefused) {
  CloudToScanStageOptions options;
  options.scan_frame = "base_link";
  EXPECT_THROW((CloudToScanStage{options, buffer_, monitor_}), OptionError);
}

}  // namespace
}  // namespace datmo::cloud_to_scan_stage_test
