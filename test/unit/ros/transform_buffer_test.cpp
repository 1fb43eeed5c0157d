// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/transform_buffer.h"

#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/frames.h"

namespace datmo::transform_buffer_test {
namespace {

class MountedBufferTest : public testing::Test {
 protected:
  static SharedOptions shared() {
    SharedOptions options;
    options.mounts["laser"].x = 1.5;
    return options;
  }

  static tf2_msgs::TFMessage tf(const std::string& parent, double x, double seconds = 100.0) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(samples::transform(parent, "laser", x, seconds));
    return message;
  }

  double laserX() const {
    return scannerMount(buffer_.core(), "base_link", "laser").scanner_in_base.x();
  }

  std::uint64_t notices() const { return samples::warnings(monitor_, "mount_from_tf"); }

  StageMonitor monitor_{"stage"};
  TransformBuffer buffer_{1.0, shared(), monitor_};
};

TEST_F(MountedBufferTest, AMountIsUsedWithoutTf) { EXPECT_EQ(laserX(), 1.5); }

TEST_F(MountedBufferTest, TfHasPriorityOverAMount) {
  buffer_.addStatic(tf("base_link", 0.7));
  EXPECT_EQ(laserX(), 0.7);
  EXPECT_EQ(notices(), 1U);
  buffer_.addStatic(tf("base_link", 0.7));
  EXPECT_EQ(notices(), 1U) << "said once";
}

TEST_F(MountedBufferTest, MovingTfHasPriorityToo) {
  buffer_.add(tf("base_link", 0.7, 100.0));
  EXPECT_EQ(laserX(), 0.7);
  EXPECT_EQ(notices(), 1U);
}

TEST_F(MountedBufferTest, AnotherParentIsAnotherMount) {
  tf2_msgs::TFMessage roof;
  roof.transforms.push_back(samples::transform("base_link", "roof", 0.2));
  buffer_.addStatic(roof);
  EXPECT_EQ(notices(), 0U);
  buffer_.addStatic(tf("roof", 1.5));
  EXPECT_NEAR(laserX(), 1.7, 1e-9);
  EXPECT_EQ(notices(), 1U);
}

TEST_F(MountedBufferTest, TheSameFromTfIsNoNotice) {
  buffer_.addStatic(tf("base_link", 1.5004));
  EXPECT_EQ(notices(), 0U);
}

TEST_F(MountedBufferTest, AMountOutlivesAJumpOfTheClock) {
  tf2_msgs::TFMessage wheels;
  wheels.transforms.push_back(samples::transform("odom", "base_link", 1.0, 200.0));
  monitor_.setTime(Stamp::fromSeconds(200.0));
  buffer_.add(wheels);
  wheels.transforms[0].header.stamp = ros::Time(100.0);
  monitor_.setTime(Stamp::fromSeconds(100.0));
  buffer_.add(wheels);
  EXPECT_EQ(laserX(), 1.5);
  EXPECT_EQ(samples::warnings(monitor_, "stray_stamp"), 0U);
}

TEST_F(MountedBufferTest, ATransformFarOffCostsOneTransform) {
  tf2_msgs::TFMessage wheels;
  for (int message = 0; message < 20; ++message) {
    const double seconds = 100.0 + 0.1 * message;
    const double off = message == 8 ? -50.0 : message == 15 ? 1e6 : 0.0;
    monitor_.setTime(Stamp::fromSeconds(seconds));
    wheels.transforms = {samples::transform("odom", "base_link", message, seconds + off)};
    buffer_.add(wheels);
  }
  EXPECT_EQ(samples::warnings(monitor_, "stray_stamp"), 2U);
  EXPECT_NEAR(planarPose(buffer_.core(), "odom", "base_link", ros::Time(100.85)).x(), 8.5, 1e-6);
  EXPECT_NEAR(planarPose(buffer_.core(), "odom", "base_link", ros::Time(101.9)).x(), 19.0, 1e-6);
}

/// Transforms published before remain, and the stage is warned.
class BadTransformTest : public MountedBufferTest {
 protected:
  void expectRefused(const tf2_msgs::TFMessage& bad, const std::string& reason) {
    buffer_.addStatic(tf("base_link", 0.7));
    buffer_.add(bad);
    buffer_.addStatic(bad);
    EXPECT_EQ(laserX(), 0.7);
    EXPECT_EQ(samples::warnings(monitor_, reason), 2U) << monitor_.lastError();
  }
};

TEST_F(BadTransformTest, AStampAtTheEndOfTime) {
  tf2_msgs::TFMessage bad = tf("base_link", 0.1);
  bad.transforms[0].header.stamp = ros::Time(4294967295U, 0);
  expectRefused(bad, "stamp_out_of_range");
}

TEST_F(BadTransformTest, AMountThatIsNotFinite) {
  expectRefused(tf("base_link", std::numeric_limits<double>::infinity()), "bad_transform");
}

TEST_F(BadTransformTest, AMountBeyondTheEarth) {
  expectRefused(tf("base_link", 1e9), "bad_transform");
}

TEST_F(BadTransformTest, AnInvalidRotation) {
  tf2_msgs::TFMessage bad = tf("base_link", 0.1);
  bad.transforms[0].transform.rotation.w = 0.5;
  expectRefused(bad, "bad_transform");
  bad.transforms[0].transform.rotation.w = std::numeric_limits<double>::quiet_NaN();
  buffer_.add(bad);
  EXPECT_EQ(samples::warnings(monitor_, "bad_transform"), 3U);
}

TEST_F(BadTransformTest, InvalidFrames) {
  tf2_msgs::TFMessage bad = tf("base_link", 0.1);
  bad.transforms[0].child_frame_id = "";
  expectRefused(bad, "bad_transform");
  bad.transforms[0].child_frame_id = "base_link";
  buffer_.add(bad);
  buffer_.add(tf("", 0.1));
  EXPECT_EQ(samples::warnings(monitor_, "bad_transform"), 4U);
  // tf2 removes a slash at the front.
  buffer_.add(tf("/", 0.1));
  bad.transforms[0].child_frame_id = "/base_link";
  buffer_.add(bad);
  EXPECT_EQ(samples::warnings(monitor_, "bad_transform"), 6U);
}

TEST_F(MountedBufferTest, AMountBeyondAnyVehicleIsRefused) {
  buffer_.addStatic(tf("base_link", 101.0));
  EXPECT_EQ(samples::reasonOf([this] { laserX(); }), "mount_too_far");
}

TEST_F(MountedBufferTest, ALookUpAtTheEndOfTimeIsAnInputError) {
  tf2_msgs::TFMessage wheels;
  for (const double seconds : {100.0, 100.1}) {
    wheels.transforms = {samples::transform("odom", "base_link", 1.0, seconds)};
    buffer_.add(wheels);
  }
  for (const ros::Time& end : {ros::TIME_MAX, ros::Time(4294967295U, 0)}) {
    EXPECT_EQ(samples::reasonOf([&] { planarPose(buffer_.core(), "odom", "base_link", end); }),
              "missing_transform");
    EXPECT_EQ(samples::reasonOf([&] { planarPose(buffer_.core(), "nobody", "knows", end); }),
              "missing_transform");
  }
}

TEST_F(MountedBufferTest, AMissingMountIsReportedWithWhatToDo) {
  try {
    scannerMount(buffer_.core(), "base_link", "velodyne");
    FAIL() << "no exception";
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const char* const part : {"base_link -> velodyne", "mounts: {velodyne: {x: 0.0",
                                   "static_transform_publisher", "base_link velodyne"}) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " not in: " << message;
    }
  }
  EXPECT_EQ(samples::reasonOf([this] { scannerMount(buffer_.core(), "base_link", ""); }),
            "missing_frame");
}

}  // namespace
}  // namespace datmo::transform_buffer_test
