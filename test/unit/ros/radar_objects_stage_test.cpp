// SPDX-License-Identifier: BSD-3-Clause
// Detections of a radar through the stage: what is accepted, and what is dropped and counted.
#include "datmo_fusion/ros/stage/radar_objects_stage.h"

#include <cmath>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::radar_objects_stage_test {
namespace {

constexpr double kStart = 100.0;
constexpr double kSpeed = 10.0;  // m/s

class RadarObjectsStageTest : public testing::Test {
 protected:
  /// 3 m ahead of the vehicle's origin.
  void mountRadar() {
    tf2_msgs::TFMessage mount;
    mount.transforms = {toTransform(Pose2(3.0, 0.0, 0.0), Stamp(), "base_link", "radar_front")};
    transforms_.addStatic(mount);
  }

  void drive(double from, double to) {
    for (double seconds = from; seconds <= to; seconds += 0.02) {
      stage_.handleOdometry(samples::odometry(seconds, kSpeed));
    }
  }

  static datmo_fusion::RadarReturn returnAt(float range, float doppler) {
    datmo_fusion::RadarReturn one;
    one.range = range;
    one.doppler_velocity = doppler;
    return one;
  }

  /// A stationary object, and one that is 5 m/s faster than the vehicle.
  static RadarScanMessage scanAt(double seconds) {
    RadarScanMessage scan;
    scan.header.stamp = ros::Time(seconds);
    scan.header.frame_id = "radar_front";
    scan.returns = {returnAt(20.0F, -10.0F), returnAt(40.0F, 5.0F)};
    return scan;
  }

  StageMonitor monitor_{"radar_objects"};
  TransformBuffer transforms_{1.0};
  RadarObjectsStage stage_{RadarObjectsStageOptions(), transforms_, monitor_};
};

TEST_F(RadarObjectsStageTest, ACycleMakesObjectsOfTheVehiclesFrame) {
  mountRadar();
  drive(kStart, kStart + 1.0);
  const ObjectArrayPtr objects = stage_.handle(scanAt(kStart + 1.0));
  ASSERT_TRUE(objects);
  EXPECT_EQ(objects->header.frame_id, "base_link");
  EXPECT_EQ(objects->header.stamp, ros::Time(kStart + 1.0));
  ASSERT_EQ(objects->objects.size(), 1U);
  const ObjectMessage& object = objects->objects[0];
  EXPECT_NEAR(object.pose.position.x, 43.0, 1e-6);
  EXPECT_NEAR(object.velocity.x, 15.0, 1e-3);
  EXPECT_NEAR(object.velocity_covariance[3], 100.0, 1e-6);
  EXPECT_EQ(object.sensors, std::vector<std::string>{"radar"});
  EXPECT_EQ(monitor_.figures().at("clusters that stand"), 1.0);
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(RadarObjectsStageTest, WithoutMountOrMotionACycleIsDropped) {
  EXPECT_FALSE(stage_.handle(scanAt(kStart)));
  EXPECT_EQ(samples::drops(monitor_, "missing_transform"), 1U);
  mountRadar();
  EXPECT_FALSE(stage_.handle(scanAt(kStart)));
  EXPECT_EQ(samples::drops(monitor_, "no_motion"), 1U);
  drive(kStart, kStart + 1.0);
  EXPECT_FALSE(stage_.handle(scanAt(kStart + 3.0)));  // the odometry ended long before
  EXPECT_EQ(samples::drops(monitor_, "no_motion"), 2U);
}

TEST_F(RadarObjectsStageTest, InvalidReturnsAreLeftOutAndCounted) {
  mountRadar();
  drive(kStart, kStart + 1.0);
  RadarScanMessage scan = scanAt(kStart + 1.0);
  scan.returns.resize(8, scan.returns[1]);
  scan.returns[2].range = std::nanf("");
  scan.returns[3].range = -1.0F;
  scan.returns[4].doppler_velocity = 1e6F;
  scan.returns[5].azimuth = 4.0F;
  scan.returns[6].elevation = 1.5F;
  scan.returns[7].range = 1e5F;
  const ObjectArrayPtr objects = stage_.handle(scan);
  ASSERT_TRUE(objects);
  EXPECT_EQ(objects->objects.size(), 1U);
  EXPECT_EQ(samples::warnings(monitor_, "bad_returns"), 1U);
  EXPECT_EQ(monitor_.figures().at("bad returns"), 6.0);
}

TEST_F(RadarObjectsStageTest, OfTooManyReturnsTheFirstAreUsed) {
  mountRadar();
  drive(kStart, kStart + 1.0);
  RadarScanMessage scan = scanAt(kStart + 1.0);
  scan.returns.resize(1200, scan.returns[1]);
  ASSERT_TRUE(stage_.handle(scan));
  EXPECT_EQ(monitor_.figures().at("bad returns"), 200.0);
}

TEST_F(RadarObjectsStageTest, RangesAndSpeedsAreProjectedToThePlane) {
  mountRadar();
  drive(kStart, kStart + 1.0);
  RadarScanMessage scan = scanAt(kStart + 1.0);
  scan.returns = {returnAt(40.0F, 2.5F)};
  scan.returns[0].elevation = static_cast<float>(kPi / 3.0);  // of which the cosine is a half
  EXPECT_EQ(samples::warnings(monitor_, "bad_returns"), 0U);
  EXPECT_TRUE(stage_.handle(scan)->objects.empty());  // steeper than accepted
  scan.header.stamp += ros::Duration(0.01);
  scan.returns[0].elevation = 0.5F;
  const ObjectArrayPtr objects = stage_.handle(scan);
  ASSERT_EQ(objects->objects.size(), 1U);
  EXPECT_NEAR(objects->objects[0].pose.position.x, 3.0 + 40.0 * std::cos(0.5), 1e-4);
  EXPECT_NEAR(objects->objects[0].velocity.x, 10.0 + 2.5 / std::cos(0.5), 1e-3);
}

TEST_F(RadarObjectsStageTest, ARepeatedCycleIsDropped) {
  mountRadar();
  drive(kStart, kStart + 1.0);
  EXPECT_TRUE(stage_.handle(scanAt(kStart + 1.0)));
  EXPECT_FALSE(stage_.handle(scanAt(kStart + 1.0)));
  EXPECT_EQ(monitor_.droppedCount(), 1U);
}

}  // namespace
}  // namespace datmo::radar_objects_stage_test
