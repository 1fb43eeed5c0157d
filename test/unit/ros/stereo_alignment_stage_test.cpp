// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_alignment_stage.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "cloud_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/alignment_conversion.h"
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"

namespace datmo::stereo_alignment_stage_test {
namespace {

using samples::kStart;

constexpr double kFocalTimesBaseline = 100.0;  // px m
constexpr double kHalfWall = 2.0;              // m
constexpr double kPeriod = 0.1;                // s

class StereoAlignmentStageTest : public testing::Test {
 protected:
  StereoAlignmentStageTest() {
    tf2_msgs::TFMessage mounts;
    mounts.transforms = {samples::cameraMount(), samples::transform("base_link", "scanner", 0.0)};
    buffer_.addStatic(mounts);
    stage_.handleCameraInfo(samples::rightCameraInfo());
  }

  /// The wall as the scanner sees it.
  static sensor_msgs::LaserScan scanAt(double seconds) {
    constexpr double kSpacing = 0.5 * M_PI / 180.0;
    constexpr double kHalfField = 20.0 * M_PI / 180.0;
    const double wall = 2.0 + samples::kWallAhead;
    sensor_msgs::LaserScan scan = samples::laserScan({});
    scan.header.stamp = ros::Time(seconds);
    scan.angle_min = static_cast<float>(-kHalfField);
    scan.angle_increment = static_cast<float>(kSpacing);
    for (double bearing = -kHalfField; bearing < kHalfField + 0.5 * kSpacing; bearing += kSpacing) {
      const bool hit = std::abs(wall * std::tan(bearing)) < kHalfWall;
      scan.ranges.push_back(hit ? static_cast<float>(wall / std::cos(bearing))
                                : std::numeric_limits<float>::infinity());
    }
    scan.angle_max = static_cast<float>(kHalfField);
    return scan;
  }

  /// The wall, as seen by a camera whose disparities are too large by `bias` (px).
  static sensor_msgs::PointCloud2 cloudAt(double seconds, double bias) {
    std::vector<Eigen::Vector3f> points = samples::wallOnARoad(-0.2, 0.2, 1.5);
    for (Eigen::Vector3f& point : points) {
      point /= 1.0F + static_cast<float>(bias / kFocalTimesBaseline) * point.z();
    }
    sensor_msgs::PointCloud2 message = samples::cloud(points);
    message.header.stamp = ros::Time(seconds);
    return message;
  }

  static void drive(StereoAlignmentStage& stage, double seconds, double speed) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = ros::Time(seconds);
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.pose.pose.orientation.w = 1.0;
    odometry.twist.twist.linear.x = speed;
    stage.handleOdometry(odometry);
  }

  /// The last answer.
  StereoAlignmentMessagePtr run(int clouds, double bias, double speed = 0.0) {
    StereoAlignmentMessagePtr last;
    for (int i = 0; i < clouds; ++i) {
      const double seconds = kStart + i * kPeriod;
      drive(stage_, seconds, speed);
      stage_.handleScan(scanAt(seconds));
      last = stage_.handleCloud(cloudAt(seconds, bias));
    }
    return last;
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"stereo_alignment"};
  StereoAlignmentStageOptions options_;
  StereoAlignmentStage stage_{options_, buffer_, monitor_};
};

/// The wall alone cannot distinguish disparities from mount or surface: their uncertainty remains.
TEST_F(StereoAlignmentStageTest, TheBiasOfACameraIsEstimatedAgainstTheScanner) {
  const auto alignment = run(200, 0.6);
  ASSERT_TRUE(alignment);
  EXPECT_EQ(alignment->header.frame_id, "base_link");
  const double sigma = std::sqrt(alignment->disparity_variance);
  EXPECT_NEAR(alignment->disparity_offset, 0.6, 3.0 * sigma);
  EXPECT_GT(alignment->disparity_offset, 0.2);
  EXPECT_LT(sigma, 0.25);
  EXPECT_GT(alignment->surfaces, 100U);
  EXPECT_EQ(alignment->agreement, 1.0);
  EXPECT_TRUE(alignment->usable);
  EXPECT_EQ(monitor_.figures().at("disparities too large by [px]"), alignment->disparity_offset);
  EXPECT_EQ(samples::warnings(monitor_, "misaligned_camera"), 0U);
}

TEST_F(StereoAlignmentStageTest, ThereIsOneWarningOfAnUnusualBias) {
  options_.alignment.disparity.sigma = 1.0;
  StereoAlignmentStage stage(options_, buffer_, monitor_);
  stage.handleCameraInfo(samples::rightCameraInfo());
  for (int i = 0; i < 400; ++i) {
    const double seconds = kStart + i * kPeriod;
    drive(stage, seconds, 0.0);
    stage.handleScan(scanAt(seconds));
    stage.handleCloud(cloudAt(seconds, 3.0));
  }
  EXPECT_EQ(samples::warnings(monitor_, "misaligned_camera"), 1U);
}

TEST_F(StereoAlignmentStageTest, WithoutAScanNearInTimeNothingIsCompared) {
  EXPECT_FALSE(stage_.handleCloud(cloudAt(kStart, 0.0)));
  drive(stage_, kStart, 0.0);
  stage_.handleScan(scanAt(kStart));
  EXPECT_FALSE(stage_.handleCloud(cloudAt(kStart + 0.5, 0.0)));
  EXPECT_EQ(monitor_.processedCount(), 0U);
}

TEST_F(StereoAlignmentStageTest, AtRestTheSameCloudMayBeRepeated) {
  EXPECT_TRUE(run(10, 0.0, 0.0)->usable);
  EXPECT_EQ(samples::warnings(monitor_, "frozen_camera"), 0U);
}

TEST_F(StereoAlignmentStageTest, AFrozenImageIsNotUsable) {
  const auto alignment = run(10, 0.0, 8.0);
  ASSERT_TRUE(alignment);
  EXPECT_FALSE(alignment->usable);
  EXPECT_GT(samples::warnings(monitor_, "frozen_camera"), 0U);
}

TEST_F(StereoAlignmentStageTest, AnImageStaysFrozenForLongerThanOdometryIsKept) {
  const auto alignment = run(300, 0.0, 8.0);
  ASSERT_TRUE(alignment);
  EXPECT_FALSE(alignment->usable);
}

TEST_F(StereoAlignmentStageTest, ObjectsAreWhereTheScannerSeesThem) {
  StereoObjectsStageOptions options;
  StageMonitor monitor("stereo_objects");
  StereoObjectsStage objects(options, buffer_, monitor);
  objects.handleCameraInfo(samples::rightCameraInfo());
  const auto alignment = run(200, 0.6);
  const auto depthOf = [&](double seconds) {
    std::vector<Eigen::Vector3f> points = samples::wallOnARoad(-0.09, 0.09, 1.5);
    for (Eigen::Vector3f& point : points) {
      point /= 1.0F + 0.006F * point.z();
    }
    sensor_msgs::PointCloud2 cloud = samples::cloud(points);
    cloud.header.stamp = ros::Time(seconds);
    const auto array = objects.handleCloud(cloud);
    return array && !array->objects.empty() ? array->objects.front().pose.position.x : 0.0;
  };
  const double before = depthOf(kStart);
  objects.handleAlignment(*alignment);
  const double after = depthOf(kStart + kPeriod);
  EXPECT_NEAR(after - before, alignment->disparity_offset, 0.15) << "1 px is 1 m at 10 m";
}

TEST_F(StereoAlignmentStageTest, UnusableCloudsMakeNoObjects) {
  StereoObjectsStageOptions options;
  StageMonitor monitor("stereo_objects");
  StereoObjectsStage objects(options, buffer_, monitor);
  objects.handleCameraInfo(samples::rightCameraInfo());
  StereoAlignmentMessage alignment = *run(1, 0.0);
  alignment.usable = 0U;
  objects.handleAlignment(alignment);
  EXPECT_FALSE(objects.handleCloud(cloudAt(kStart, 0.0)));
  EXPECT_EQ(samples::drops(monitor, "camera_disagrees"), 1U);
  EXPECT_TRUE(objects.handleCloud(cloudAt(kStart + 5.1, 0.0))) << "the scanner is silent by now";
}

TEST(StereoAlignmentMessage, WithInvalidNumbersIsRefused) {
  StereoAlignmentMessage message = *toMessage(StereoAlignment(), "base_link");
  EXPECT_NO_THROW(fromMessage(message));
  message.time_variance = -1.0;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_alignment");
  message.time_variance = 0.0;
  message.heading_offset = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_alignment");
  message.heading_offset = 0.0;
  message.disparity_variance = 1e308;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_alignment");
}

}  // namespace
}  // namespace datmo::stereo_alignment_stage_test
