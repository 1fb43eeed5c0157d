// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/frames.h"

#include "message_samples.h"
#include <gtest/gtest.h>

#include <tf2/LinearMath/Quaternion.h>

#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo::frames_test {
namespace {

class MountTest : public testing::Test {
 protected:
  ScannerMount mountOf(double roll, double pitch, double yaw) {
    tf2::Quaternion turn;
    turn.setRPY(roll, pitch, yaw);
    auto transform = samples::transform("base_link", "scanner", 3.6);
    transform.transform.rotation.x = turn.x();
    transform.transform.rotation.y = turn.y();
    transform.transform.rotation.z = turn.z();
    transform.transform.rotation.w = turn.w();
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    TransformBuffer buffer(1.0);
    buffer.addStatic(message);
    return scannerMount(buffer.core(), "base_link", "scanner");
  }
};

TEST_F(MountTest, LevelScannerFacingLeft) {
  const ScannerMount mount = mountOf(0.0, 0.0, kPi / 2.0);
  EXPECT_NEAR(mount.scanner_in_base.x(), 3.6, 1e-9);
  EXPECT_NEAR(mount.scanner_in_base.heading(), kPi / 2.0, 1e-9);
  EXPECT_FALSE(mount.upside_down);
  EXPECT_NEAR(mount.tilt, 0.0, 1e-6);
}

TEST_F(MountTest, UpsideDownByRoll) {
  const ScannerMount mount = mountOf(kPi, 0.0, 0.3);
  EXPECT_TRUE(mount.upside_down);
  EXPECT_NEAR(mount.scanner_in_base.heading(), 0.3, 1e-9);
  EXPECT_NEAR(mount.tilt, 0.0, 1e-6);
}

TEST_F(MountTest, TiltByPitch) {
  EXPECT_NEAR(mountOf(0.0, 0.2, 0.0).tilt, 0.2, 1e-9);
  EXPECT_NEAR(mountOf(kPi, 0.2, 0.0).tilt, 0.2, 1e-9);
}

TEST(Frames, AMissingTransformIsNamed) {
  const TransformBuffer buffer(1.0);
  try {
    scannerMount(buffer.core(), "base_link", "scanner");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_EQ(error.reason(), "missing_transform");
    EXPECT_NE(std::string(error.what()).find("base_link -> scanner"), std::string::npos);
  }
}

tf2_msgs::TFMessage odometry(double x, double seconds) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(samples::transform("odom", "base_link", x, seconds));
  return message;
}

TEST(TransformBuffer, InterpolatesWithinARun) {
  TransformBuffer buffer(1.0);
  buffer.add(odometry(0.0, 10.0));
  buffer.add(odometry(2.0, 11.0));
  EXPECT_NEAR(planarPose(buffer.core(), "odom", "base_link", ros::Time(10.25)).x(), 0.5, 1e-9);
}

TEST(TransformBuffer, FramesThatJumpBackOneAfterTheOtherDoNotClearEachOther) {
  TransformBuffer buffer(1.0);
  const auto map = [](double seconds) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(samples::transform("map", "odom", 0.0, seconds));
    return message;
  };
  buffer.add(odometry(5.0, 20.0));
  buffer.add(map(20.0));
  buffer.add(odometry(1.0, 10.0));
  buffer.add(map(10.0));
  EXPECT_NEAR(planarPose(buffer.core(), "map", "base_link", ros::Time(10.0)).x(), 1.0, 1e-9);
}

TEST(TransformBuffer, ForgetsTheOldRunWhenTheClockJumpsBack) {
  TransformBuffer buffer(1.0);
  tf2_msgs::TFMessage mount;
  mount.transforms.push_back(samples::transform("base_link", "scanner", 3.6));
  buffer.addStatic(mount);
  buffer.add(odometry(0.0, 10.0));
  buffer.add(odometry(100.0, 15.0));
  buffer.add(odometry(0.0, 12.0));
  const auto between = [&] { planarPose(buffer.core(), "odom", "base_link", ros::Time(13.0)); };
  EXPECT_EQ(samples::reasonOf(between), "missing_transform") << "not between two runs";
  buffer.add(odometry(1.0, 14.0));
  EXPECT_NEAR(planarPose(buffer.core(), "odom", "base_link", ros::Time(13.0)).x(), 0.5, 1e-9);
  EXPECT_NO_THROW(scannerMount(buffer.core(), "base_link", "scanner")) << "static ones stay";
}

}  // namespace
}  // namespace datmo::frames_test
