// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_grid_stage.h"

#include <functional>
#include <limits>

#include "cloud_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"

namespace datmo::stereo_grid_stage_test {
namespace {

using samples::kStart;

using samples::kCameraHeight;
using samples::kWallAhead;
using samples::wallOnARoad;

class StereoGridStageTest : public testing::Test {
 protected:
  StereoGridStageTest() { stage_.handleCameraInfo(samples::rightCameraInfo()); }

  /// A forward-looking camera 2 m ahead of the vehicle's origin; the scanner is at 0.5 m.
  void mountSensors() {
    tf2_msgs::TFMessage message;
    message.transforms = {samples::cameraMount(), samples::transform("base_link", "scanner", 3.6)};
    message.transforms[1].transform.translation.z = 0.5;
    buffer_.addStatic(message);
  }

  static sensor_msgs::PointCloud2 cloudAt(double seconds) {
    sensor_msgs::PointCloud2 message = samples::cloud(wallOnARoad());
    message.header.stamp = ros::Time(seconds);
    return message;
  }

  nav_msgs::OccupancyGridPtr takeAt(double seconds) { return stage_.handleCloud(cloudAt(seconds)); }

  static Percent percentAt(const nav_msgs::OccupancyGrid& message, double x, double y) {
    const SensorGrid grid = fromMessage(message);
    return grid.at(grid.window().cellAt({x, y}));
  }

  static void expectWall(const nav_msgs::OccupancyGridPtr& grid) {
    ASSERT_TRUE(grid);
    EXPECT_TRUE(isOccupied(percentAt(*grid, 2.0 + kWallAhead + 0.01, 0.0)));
    EXPECT_TRUE(isFree(percentAt(*grid, 2.0 + 0.6 * kWallAhead, 0.0)));
    EXPECT_FALSE(isOccupied(percentAt(*grid, 2.0 + kWallAhead + 4.0, 0.0)));
    EXPECT_EQ(percentAt(*grid, -10.0, 0.0), kUnknownPercent) << "behind";
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"stereo_grid"};
  StereoGridStageOptions options_;
  StereoGridStage stage_{options_, buffer_, monitor_};
};

TEST_F(StereoGridStageTest, ACloudMakesAGridOfItsStampInTheVehiclesFrame) {
  mountSensors();
  const auto grid = takeAt(kStart);
  expectWall(grid);
  EXPECT_EQ(grid->header.frame_id, "base_link");
  EXPECT_EQ(grid->header.stamp, ros::Time(kStart));
  EXPECT_EQ(fromMessage(*grid).window(), GridWindowOptions().window());
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(StereoGridStageTest, DiagnosticsReportTheCloudsContent) {
  mountSensors();
  takeAt(kStart);
  const auto& figures = monitor_.figures();
  EXPECT_EQ(figures.at("points of the cloud"), 120.0 * 160.0);
  EXPECT_GT(figures.at("points in the layer of obstacles"), 100.0);
  EXPECT_EQ(figures.at("road seen, 0 or 1"), 1.0);
  EXPECT_NEAR(figures.at("road's height [m]"), 0.0, 0.1);
  EXPECT_NEAR(figures.at("road's slope ahead [m/m]"), 0.0, 0.02);
}

TEST_F(StereoGridStageTest, CloudsOfAnotherFrameAreTransformedToTheCamera) {
  mountSensors();
  options_.frames.camera = "camera";
  StereoGridStage stage(options_, buffer_, monitor_);
  stage.handleCameraInfo(samples::rightCameraInfo());
  std::vector<Eigen::Vector3f> points = wallOnARoad();
  for (Eigen::Vector3f& p : points) {
    p = Eigen::Vector3f(p.z() + 2.0F, -p.x(), static_cast<float>(kCameraHeight) - p.y());
  }
  sensor_msgs::PointCloud2 message = samples::cloud(points);
  message.header.frame_id = "base_link";
  expectWall(stage.handleCloud(message));
}

TEST_F(StereoGridStageTest, WithoutCameraInfoTheOptionsAreUsed) {
  mountSensors();
  options_.camera.focal_length = 500.0;
  options_.camera.baseline = 0.2;
  StereoGridStage stage(options_, buffer_, monitor_);
  expectWall(stage.handleCloud(cloudAt(kStart)));
}

TEST_F(StereoGridStageTest, WithoutEitherCloudsAreDroppedUntilACameraInfoArrives) {
  mountSensors();
  StereoGridStage stage(options_, buffer_, monitor_);
  EXPECT_FALSE(stage.handleCloud(cloudAt(kStart)));
  EXPECT_EQ(drops("missing_camera_info"), 1U);
  stage.handleCameraInfo(sensor_msgs::CameraInfo());
  EXPECT_EQ(drops("bad_camera_info"), 1U);
  stage.handleCameraInfo(samples::rightCameraInfo());
  expectWall(stage.handleCloud(cloudAt(kStart)));
}

TEST_F(StereoGridStageTest, AMissingMountIsCountedUntilItArrives) {
  EXPECT_FALSE(takeAt(kStart));
  EXPECT_EQ(drops("missing_transform"), 1U);
  mountSensors();
  EXPECT_TRUE(takeAt(kStart));
}

TEST_F(StereoGridStageTest, WithoutAScannerItsHeightIsAnOption) {
  mountSensors();
  options_.frames.scanner = "roof_scanner";
  StereoGridStage stage(options_, buffer_, monitor_);
  stage.handleCameraInfo(samples::rightCameraInfo());
  expectWall(stage.handleCloud(cloudAt(kStart)));
  EXPECT_EQ(samples::warnings(monitor_, "missing_transform"), 1U);
  options_.frames.scanner = "";
  options_.scanner_height = 2.5;  // above the visible part of the wall
  StereoGridStage high(options_, buffer_, monitor_);
  high.handleCameraInfo(samples::rightCameraInfo());
  const auto grid = high.handleCloud(cloudAt(kStart));
  ASSERT_TRUE(grid);
  EXPECT_LT(monitor_.figures().at("points in the layer of obstacles"), 3000.0);
  EXPECT_EQ(samples::warnings(monitor_, "missing_transform"), 1U);
}

TEST_F(StereoGridStageTest, ACameraFacingStraightDownIsRefused) {
  mountSensors();
  tf2_msgs::TFMessage message;
  message.transforms = {samples::transform("base_link", "camera", 2.0)};
  message.transforms[0].transform.translation.z = kCameraHeight;
  message.transforms[0].transform.rotation.x = 1.0;  // z down
  message.transforms[0].transform.rotation.w = 0.0;
  buffer_.addStatic(message);
  EXPECT_FALSE(takeAt(kStart));
  EXPECT_EQ(drops("bad_camera"), 1U);
}

TEST_F(StereoGridStageTest, BadCloudsAreDroppedAndCountedAndTheNextOneProcessed) {
  mountSensors();
  const auto dropped = [this](const std::function<void(sensor_msgs::PointCloud2&)>& spoil,
                              const std::string& reason) {
    sensor_msgs::PointCloud2 message = cloudAt(kStart);
    spoil(message);
    const std::uint64_t before = drops(reason);
    EXPECT_FALSE(stage_.handleCloud(message)) << reason;
    EXPECT_EQ(drops(reason), before + 1) << reason;
  };
  dropped([](auto& message) { message = samples::cloud({}); }, "empty_cloud");
  dropped([](auto& message) { message.fields.erase(message.fields.begin()); }, "missing_field");
  dropped([](auto& message) { message.is_bigendian = 1; }, "big_endian");
  dropped([](auto& message) { message.header.frame_id = "nowhere"; }, "missing_transform");
  dropped([](auto& message) { message.header.stamp = ros::Time(); }, "zero_stamp");
  dropped([](auto& message) { std::fill(message.data.begin(), message.data.end(), 0xFF); },
          "no_valid_point");
  expectWall(takeAt(kStart));
  dropped([](auto& message) { message.header.stamp = ros::Time(kStart); }, "repeated_stamp");
  dropped([](auto& message) { message.header.stamp = ros::Time(kStart - 0.5); }, "old_stamp");
  expectWall(takeAt(kStart + 0.1));
}

TEST_F(StereoGridStageTest, AJumpBackStartsOver) {
  mountSensors();
  EXPECT_TRUE(takeAt(200.0));
  expectWall(takeAt(100.0));
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(StereoGridStageTest, BadOptionsAreRefused) {
  options_.camera.disparity_sigma = 0.0;
  EXPECT_THROW(StereoGridStage(options_, buffer_, monitor_), OptionError);
}

/// A depth image's cloud: 120 x 160 points, holes as NaN; wallOnARoad() leaves them out.
sensor_msgs::PointCloud2 organizedCloud() {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Eigen::Vector3f> points = wallOnARoad();
  points.resize(120U * 160U, Eigen::Vector3f(nan, nan, nan));
  points.back() = {0.0F, 0.0F, 40.0F};  // out of range: beyond the wall
  sensor_msgs::PointCloud2 message = samples::cloud(points);
  message.height = 120;
  message.width = 160;
  message.row_step = message.width * message.point_step;
  return message;
}

sensor_msgs::CameraInfo depthImageInfo() {
  sensor_msgs::CameraInfo info = samples::rightCameraInfo();
  info.P[3] = 0.0;
  return info;
}

TEST_F(StereoGridStageTest, OrganizedCloudsOfDepthCamerasMakeGrids) {
  mountSensors();
  options_.camera.min_depth = 0.5;
  options_.camera.max_depth = 20.0;
  options_.camera.baseline = 0.05;
  options_.camera.disparity_sigma = 0.06;  // 0.24 m at the wall
  for (const DepthPrinciple principle :
       {DepthPrinciple::kActiveStereo, DepthPrinciple::kStructuredLight,
        DepthPrinciple::kTimeOfFlight}) {
    options_.camera.principle = principle;
    StereoGridStage stage(options_, buffer_, monitor_);
    SCOPED_TRACE(static_cast<int>(principle));
    EXPECT_FALSE(stage.handleCloud(organizedCloud())) << "no camera info yet";
    stage.handleCameraInfo(depthImageInfo());
    expectWall(stage.handleCloud(organizedCloud()));
  }
  EXPECT_EQ(drops("missing_camera_info"), 3U);
  EXPECT_EQ(drops("bad_camera_info"), 0U);
}

TEST_F(StereoGridStageTest, ADepthCamerasInfoIsNotThatOfAPair) {
  stage_.handleCameraInfo(depthImageInfo());
  EXPECT_EQ(drops("bad_camera_info"), 1U);
}

TEST_F(StereoGridStageTest, BadOptionsOfDepthCamerasAreRefused) {
  const auto refused = [this](const std::function<void(StereoCameraOptions&)>& spoil) {
    StereoGridStageOptions options = options_;
    spoil(options.camera);
    EXPECT_THROW(StereoGridStage(options, buffer_, monitor_), OptionError);
  };
  refused(
      [](auto& camera) { camera.principle = DepthPrinciple::kActiveStereo; });  // without baseline
  refused([](auto& camera) { camera.min_depth = 2.0, camera.max_depth = 1.0; });
  refused([](auto& camera) { camera.structured_light.quadratic = 0.0; });
  refused([](auto& camera) { camera.time_of_flight.constant = 0.0; });
}

}  // namespace
}  // namespace datmo::stereo_grid_stage_test
