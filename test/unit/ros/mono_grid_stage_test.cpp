// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/mono_grid_stage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "camera_samples.h"
#include "monitor_counts.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace datmo::mono_grid_stage_test {
namespace {

using samples::drops;
using samples::warnings;

constexpr double kStart = 100.0;  // s
constexpr double kHeight = 1.5;   // m
constexpr samples::CameraSample kCamera{1000, 400, 500.0};

/// Each differs from the one before.
sensor_msgs::ImagePtr imageAt(double seconds) {
  static std::uint8_t number = 0;
  return boost::make_shared<sensor_msgs::Image>(kCamera.road(seconds, ++number));
}

class MonoGridStageTest : public testing::Test {
 protected:
  void mount() {
    auto scanner = samples::transform("base_link", "scanner", 0.0, 0.0);
    scanner.transform.translation.z = 0.4;
    transforms_.addStatic(
        samples::transforms({samples::cameraMount("base_link", kHeight), scanner}));
    stage_.handleCameraInfo(kCamera.info());
  }

  nav_msgs::OccupancyGridPtr look(const sensor_msgs::ImageConstPtr& image, double waited = 0.0) {
    const Stamp stamp = toStamp(image->header.stamp);
    stage_.handleImage(image, stamp);
    return stage_.next(stamp + waited);
  }

  TransformBuffer transforms_{1.0};
  StageMonitor monitor_{"mono_grid"};
  MonoGridStage stage_{MonoGridStageOptions(), transforms_, monitor_};
};

TEST_F(MonoGridStageTest, AnImageAndItsScanMakeAGridAtTheExposure) {
  mount();
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  const auto grid = look(imageAt(kStart));
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->header.stamp, ros::Time(kStart));
  EXPECT_EQ(grid->header.frame_id, "base_link");
  EXPECT_GT(std::count(grid->data.begin(), grid->data.end(), 20), 500);
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(MonoGridStageTest, AnImageWaitsForItsScan) {
  mount();
  EXPECT_EQ(look(imageAt(kStart)), nullptr);
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  EXPECT_NE(stage_.next(Stamp::fromSeconds(kStart + 0.02)), nullptr);
  EXPECT_EQ(stage_.next(Stamp::fromSeconds(kStart + 0.03)), nullptr) << "one image, one grid";
}

TEST_F(MonoGridStageTest, WithoutItsScanAnImageIsDropped) {
  mount();
  EXPECT_EQ(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "no_scan"), 1U);
  stage_.handleScan(samples::scanWithoutReturns(kStart + 1.0));
  EXPECT_EQ(look(imageAt(kStart + 0.5)), nullptr) << "older than the scans";
  EXPECT_EQ(drops(monitor_, "no_scan"), 2U);
}

TEST_F(MonoGridStageTest, AnImageThatWaitsWhileTheCameraChangesIsDropped) {
  mount();
  EXPECT_EQ(look(imageAt(kStart)), nullptr);
  auto wider = kCamera.info();
  ++wider.width;
  stage_.handleCameraInfo(wider);
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  EXPECT_EQ(stage_.next(Stamp::fromSeconds(kStart + 0.02)), nullptr);
  EXPECT_EQ(drops(monitor_, "wrong_size"), 1U);
}

TEST_F(MonoGridStageTest, WithoutMotionAScanOfAnotherTimeIsNotUsed) {
  mount();
  stage_.handleScan(samples::scanWithoutReturns(kStart - 0.05));
  EXPECT_EQ(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "no_motion"), 1U);
}

TEST_F(MonoGridStageTest, OfWaitingImagesTheNewestIsKept) {
  mount();
  EXPECT_EQ(look(imageAt(kStart)), nullptr);
  EXPECT_EQ(look(imageAt(kStart + 0.05)), nullptr);
  EXPECT_EQ(drops(monitor_, "superseded_image"), 1U);
}

TEST_F(MonoGridStageTest, BadImagesAreDroppedAndTheNextOneIsUsed) {
  mount();
  const auto black = imageAt(kStart);
  black->data.assign(black->data.size(), 0);
  const auto white = imageAt(kStart);
  white->data.assign(white->data.size(), 255);
  const auto gray_below = imageAt(kStart);
  std::fill(gray_below->data.begin() + gray_below->data.size() / 2, gray_below->data.end(),
            std::uint8_t{128});
  const auto half = imageAt(kStart);
  half->data.resize(half->data.size() / 2);
  const auto other = imageAt(kStart);
  other->encoding = "no encoding";
  const auto narrow = imageAt(kStart);
  narrow->width /= 2;
  for (const auto& image : {black, white, gray_below, half, other, narrow}) {
    EXPECT_EQ(look(image, 1.0), nullptr);
  }
  EXPECT_EQ(drops(monitor_, "blank_image"), 2U);
  EXPECT_EQ(drops(monitor_, "half_image"), 1U);
  EXPECT_EQ(drops(monitor_, "bad_encoding"), 2U);
  EXPECT_EQ(drops(monitor_, "wrong_size"), 1U);
  stage_.handleScan(samples::scanWithoutReturns(kStart + 0.1));
  EXPECT_NE(look(imageAt(kStart + 0.1)), nullptr);
}

TEST_F(MonoGridStageTest, AFrozenImageIsDroppedAndTheNextOneIsUsed) {
  mount();
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  const auto first = imageAt(kStart);
  EXPECT_NE(look(first), nullptr);
  const auto again = boost::make_shared<sensor_msgs::Image>(*first);
  again->header.stamp = ros::Time(kStart + 0.1);
  stage_.handleScan(samples::scanWithoutReturns(kStart + 0.1));
  EXPECT_EQ(look(again), nullptr);
  EXPECT_EQ(drops(monitor_, "frozen_image"), 1U);
  stage_.handleScan(samples::scanWithoutReturns(kStart + 0.2));
  EXPECT_NE(look(imageAt(kStart + 0.2)), nullptr);
}

TEST_F(MonoGridStageTest, AnInfoOfZerosIsDroppedAndTheLastOneIsKept) {
  mount();
  sensor_msgs::CameraInfo zeros = kCamera.info();
  zeros.P.fill(0.0);
  stage_.handleCameraInfo(zeros);
  EXPECT_EQ(drops(monitor_, "bad_camera_info"), 1U);
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  EXPECT_NE(look(imageAt(kStart)), nullptr);
}

TEST_F(MonoGridStageTest, WithoutInfoOrMountImagesAreDropped) {
  EXPECT_EQ(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "missing_camera_info"), 1U);
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  EXPECT_EQ(drops(monitor_, "missing_transform"), 1U) << "of the scanner";
}

TEST_F(MonoGridStageTest, AClockJumpBackStartsOver) {
  mount();
  stage_.handleScan(samples::scanWithoutReturns(kStart));
  EXPECT_NE(look(imageAt(kStart)), nullptr);
  stage_.handleScan(samples::scanWithoutReturns(kStart - 50.0));
  stage_.handleScan(samples::scanWithoutReturns(kStart - 49.9));
  EXPECT_NE(look(imageAt(kStart - 49.9)), nullptr);
  EXPECT_EQ(warnings(monitor_, "clock_restart"), 1U);
}

}  // namespace
}  // namespace datmo::mono_grid_stage_test
