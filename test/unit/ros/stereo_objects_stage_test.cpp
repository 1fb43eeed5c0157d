// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"

#include <limits>
#include <random>
#include <vector>

#include "cloud_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/velocity_conversion.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo::stereo_objects_stage_test {
namespace {

using samples::kStart;

class StereoObjectsStageTest : public testing::Test {
 protected:
  StereoObjectsStageTest() {
    stage_.handleCameraInfo(samples::rightCameraInfo());
    tf2_msgs::TFMessage mounts;
    mounts.transforms = {samples::cameraMount()};
    buffer_.addStatic(mounts);
  }

  /// The back of a car: 1.8 m wide, 1.5 m high, on the road.
  static sensor_msgs::PointCloud2 carAt(double seconds) {
    sensor_msgs::PointCloud2 message = samples::cloud(samples::wallOnARoad(-0.09, 0.09, 1.5));
    message.header.stamp = ros::Time(seconds);
    return message;
  }

  /// Of the car, which drives ahead.
  static std::vector<PointVelocity> velocities() {
    PointVelocity point;
    point.position = {2.0 + samples::kWallAhead, 0.0, 1.0};
    point.velocity = {5.0, 0.0, 0.0};
    point.covariance = 0.04 * Eigen::Matrix3d::Identity();
    point.common_covariance = 0.01 * Eigen::Matrix3d::Identity();
    return std::vector<PointVelocity>(10, point);
  }

  static sensor_msgs::PointCloud2 velocitiesAt(double seconds) {
    return *toMessage(velocities(), Stamp::fromSeconds(seconds), "base_link");
  }

  static void expectCarWithVelocity(const ObjectArrayPtr& objects, double seconds) {
    expectCar(objects);
    EXPECT_EQ(objects->header.stamp, ros::Time(seconds));
    EXPECT_NEAR(objects->objects.front().velocity.x, 5.0, 1e-3);
    EXPECT_GT(objects->objects.front().velocity_covariance[0], 0.01);
  }

  static void expectCar(const ObjectArrayPtr& objects) {
    ASSERT_TRUE(objects);
    ASSERT_EQ(objects->objects.size(), 1U);
    const ObjectMessage& car = objects->objects.front();
    EXPECT_NEAR(car.pose.position.y, 0.0, 0.3);
    EXPECT_GT(car.pose.position.x, 2.0 + samples::kWallAhead - 0.3);
    EXPECT_NEAR(car.size.z, 1.5, 0.3);
    EXPECT_EQ(car.sensors, std::vector<std::string>{"stereo"});
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"stereo_objects"};
  StereoObjectsStageOptions options_;
  StereoObjectsStage stage_{options_, buffer_, monitor_};
};

TEST_F(StereoObjectsStageTest, ACloudMakesObjectsOfItsStampInTheVehiclesFrame) {
  const auto objects = stage_.handleCloud(carAt(kStart));
  expectCar(objects);
  EXPECT_EQ(objects->header.frame_id, "base_link");
  EXPECT_EQ(objects->header.stamp, ros::Time(kStart));
  ASSERT_EQ(objects->views.size(), 1U);
  EXPECT_EQ(objects->views.front().sensor, "stereo");
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(StereoObjectsStageTest, DiagnosticsReportTheCloudsContent) {
  const sensor_msgs::PointCloud2 cloud = carAt(kStart);
  stage_.handleCloud(cloud);
  const auto& figures = monitor_.figures();
  EXPECT_EQ(figures.at("objects"), 1.0);
  EXPECT_EQ(figures.at("points of the cloud"), static_cast<double>(cloud.width));
  EXPECT_EQ(figures.at("road seen, 0 or 1"), 1.0);
  EXPECT_NEAR(figures.at("road's height [m]"), 0.0, 0.1);
}

TEST_F(StereoObjectsStageTest, WithoutCameraInfoTheOptionsAreUsed) {
  StereoObjectsStage ignorant(options_, buffer_, monitor_);
  EXPECT_FALSE(ignorant.handleCloud(carAt(kStart)));
  EXPECT_EQ(drops("missing_camera_info"), 1U);
  options_.camera.focal_length = 500.0;
  options_.camera.baseline = 0.2;
  StereoObjectsStage stage(options_, buffer_, monitor_);
  expectCar(stage.handleCloud(carAt(kStart)));
}

TEST_F(StereoObjectsStageTest, ACameraWithoutAMountIsRefused) {
  const TransformBuffer nothing(1.0);
  StereoObjectsStage stage(options_, nothing, monitor_);
  stage.handleCameraInfo(samples::rightCameraInfo());
  EXPECT_FALSE(stage.handleCloud(carAt(kStart)));
  EXPECT_EQ(drops("missing_transform"), 1U);
}

TEST_F(StereoObjectsStageTest, ACameraFacingStraightDownIsRefused) {
  tf2_msgs::TFMessage message;
  message.transforms = {samples::cameraMount()};
  message.transforms[0].transform.rotation.x = 1.0;  // z down
  message.transforms[0].transform.rotation.y = 0.0;
  message.transforms[0].transform.rotation.z = 0.0;
  message.transforms[0].transform.rotation.w = 0.0;
  buffer_.addStatic(message);
  EXPECT_FALSE(stage_.handleCloud(carAt(kStart)));
  EXPECT_EQ(drops("bad_camera"), 1U);
}

/// Over a road with scattered points that belong to no object.
TEST_F(StereoObjectsStageTest, WhateverTheCloudItsObjectsAreValid) {
  std::mt19937 random(1);
  const auto between = [&](double min, double max) {
    return min + (max - min) * static_cast<double>(random()) / std::mt19937::max();
  };
  std::size_t objects = 0;
  for (int i = 0; i < 20; ++i) {
    std::vector<Eigen::Vector3f> points = samples::wallOnARoad(-0.09, 0.09, 1.5);
    for (int j = 0; j < 4000; ++j) {
      const double depth = between(1.0, 40.0);
      points.emplace_back(
          Eigen::Vector3d(between(-0.6, 0.6) * depth, between(-1.5, 1.1), depth).cast<float>());
    }
    sensor_msgs::PointCloud2 cloud = samples::cloud(points);
    cloud.header.stamp = ros::Time(kStart + i);
    const ObjectArrayPtr array = stage_.handleCloud(cloud);
    ASSERT_TRUE(array);
    for (const Object& object : fromMessage(*array).objects) {
      EXPECT_TRUE(isValid(object)) << i << ": " << object.box.center.x();
      ++objects;
    }
  }
  EXPECT_GT(objects, 100U);
}

TEST_F(StereoObjectsStageTest, BadInputIsDroppedAndCountedAndTheNextProcessed) {
  stage_.handleCameraInfo(sensor_msgs::CameraInfo());
  EXPECT_EQ(drops("bad_camera_info"), 1U);
  EXPECT_FALSE(stage_.handleCloud(samples::cloud({})));
  EXPECT_EQ(drops("empty_cloud"), 1U);
  expectCar(stage_.handleCloud(carAt(kStart)));
  EXPECT_FALSE(stage_.handleCloud(carAt(kStart)));
  EXPECT_EQ(drops("repeated_stamp"), 1U);
  EXPECT_FALSE(stage_.handleCloud(carAt(kStart - 0.5)));
  EXPECT_EQ(drops("old_stamp"), 1U);
  expectCar(stage_.handleCloud(carAt(kStart + 0.1)));
}

TEST_F(StereoObjectsStageTest, AJumpBackStartsOver) {
  EXPECT_TRUE(stage_.handleCloud(carAt(200.0)));
  expectCar(stage_.handleCloud(carAt(100.0)));
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(StereoObjectsStageTest, PointsWithVelocityGiveObjectsTheirsInEitherOrder) {
  const Stamp now = Stamp::fromSeconds(1000.0);
  stage_.handleVelocities(velocitiesAt(kStart));
  expectCarWithVelocity(stage_.handleCloud(carAt(kStart)), kStart);
  EXPECT_FALSE(stage_.handleCloud(carAt(kStart + 0.1))) << "waits";
  EXPECT_FALSE(stage_.next(now));
  stage_.handleVelocities(velocitiesAt(kStart + 0.1));
  expectCarWithVelocity(stage_.next(now), kStart + 0.1);
  EXPECT_FALSE(stage_.next(now));
  EXPECT_EQ(monitor_.processedCount(), 2U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(StereoObjectsStageTest, ACloudWithoutVelocitiesIsProcessedWithoutThem) {
  stage_.handleVelocities(velocitiesAt(kStart));
  expectCar(stage_.handleCloud(carAt(kStart)));
  EXPECT_FALSE(stage_.handleCloud(carAt(kStart + 0.1)));
  EXPECT_FALSE(stage_.next(Stamp::fromSeconds(1000.0)));
  const auto objects = stage_.next(Stamp::fromSeconds(1000.0 + stage_.maxWait()));
  expectCar(objects);
  EXPECT_EQ(objects->objects.front().velocity_covariance[0], 0.0);
  EXPECT_EQ(samples::warnings(monitor_, "no_velocities"), 1U);
  stage_.handleVelocities(velocitiesAt(kStart + 0.1));
  EXPECT_EQ(drops("late_velocities"), 1U);
}

TEST_F(StereoObjectsStageTest, PointsWithBadVelocityAreLeftOutAndCounted) {
  std::vector<PointVelocity> points = velocities();
  points[0].velocity.x() = std::numeric_limits<double>::quiet_NaN();
  points[1].covariance(0, 1) = points[1].covariance(1, 0) = 1.0;
  points[2].common_covariance(0, 0) = -1.0;
  stage_.handleVelocities(*toMessage(points, Stamp::fromSeconds(kStart), "base_link"));
  EXPECT_EQ(samples::warnings(monitor_, "bad_velocity"), 1U);
  EXPECT_EQ(monitor_.figures().at("bad points with velocity"), 3.0);
  expectCarWithVelocity(stage_.handleCloud(carAt(kStart)), kStart);
}

TEST_F(StereoObjectsStageTest, BadListsOfPointsWithVelocityAreDropped) {
  sensor_msgs::PointCloud2 message = velocitiesAt(kStart);
  message.header.frame_id = "camera";
  stage_.handleVelocities(message);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  message = velocitiesAt(kStart);
  message.fields.pop_back();
  stage_.handleVelocities(message);
  EXPECT_EQ(drops("missing_field"), 1U);
  message = velocitiesAt(kStart);
  message.data.pop_back();
  stage_.handleVelocities(message);
  EXPECT_EQ(drops("wrong_size"), 1U);
  EXPECT_EQ(stage_.handleCloud(carAt(kStart))->objects.front().velocity_covariance[0], 0.0);
}

TEST_F(StereoObjectsStageTest, BadOptionsAreRefused) {
  options_.camera.disparity_sigma = 0.0;
  EXPECT_THROW(StereoObjectsStage(options_, buffer_, monitor_), OptionError);
}

}  // namespace
}  // namespace datmo::stereo_objects_stage_test
