// SPDX-License-Identifier: BSD-3-Clause
// The running device nodelet with a log of a vehicle's CAN bus, and the odometry that it makes of
// it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

#include "chain.h"
#include "device/can_samples.h"
#include <gtest/gtest.h>

#include <nav_msgs/Odometry.h>

namespace datmo::device_can_test {
namespace {

/// The odometry from a vehicle's bus.
class OdometryRecorder : public Listener {
 public:
  OdometryRecorder() {
    odometry_ = node_.subscribe<nav_msgs::Odometry>(
        "motion/odometry", kQueue,
        [this](const nav_msgs::OdometryConstPtr& message) { odometry.push_back(message); });
  }

  bool isConnected() const { return odometry_.getNumPublishers() > 0; }

  std::vector<nav_msgs::OdometryConstPtr> odometry;

 private:
  static constexpr std::uint32_t kQueue = 200;

  ros::NodeHandle node_;
  ros::Subscriber odometry_;
};

TEST(CanDeviceTest, AVehiclesBusBecomesOdometryAndFaultsAreReported) {
  const std::string recording = ros::param::param<std::string>("recording", "");
  OdometryRecorder recorder;
  ASSERT_TRUE(recorder.waitFor([&recorder] { return recorder.isConnected(); }));
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "dropped: bad_recording") >= 1.0; }));
  constexpr int kFrames = 100;
  constexpr double kPeriod = 0.04;  // s
  std::string log;
  for (int i = 0; i < kFrames; ++i) {  // 4 s of 5 m/s, 9 deg/s to the left
    log += samples::canLogText(kPeriod * i, samples::canFrame(0x7DF, {1, 2}));
    log += samples::canLogText(kPeriod * i, samples::yawFrame(9.0));
    log += samples::canLogText(kPeriod * i, samples::speedFrame(5.0, static_cast<unsigned>(i)));
  }
  log += samples::canLogText(kPeriod * kFrames, samples::canFrame(samples::kSpeedId, {4}));
  std::ofstream(recording + ".part") << log;
  ASSERT_EQ(std::rename((recording + ".part").c_str(), recording.c_str()), 0);
  // The first counter gives no motion yet; measurements that a busy machine discards are counted.
  const auto arrived = [&recorder] {
    return static_cast<double>(recorder.odometry.size()) +
           std::max(recorder.diagnostic("device", "measurements discarded"), 0.0);
  };
  ASSERT_TRUE(recorder.waitFor([&arrived] { return arrived() >= kFrames - 1; }));
  EXPECT_EQ(arrived(), kFrames - 1.0);
  const nav_msgs::Odometry& last = *recorder.odometry.back();
  EXPECT_NEAR(last.twist.twist.linear.x, 5.0, 1e-9);
  EXPECT_NEAR(last.twist.twist.angular.z, 0.15708, 1e-4);
  // A chord of the circle, by the times at which the frames arrived.
  const double seconds = (last.header.stamp - recorder.odometry.front()->header.stamp).toSec();
  const double radius = 5.0 / 0.157080;
  EXPECT_NEAR(std::hypot(last.pose.pose.position.x, last.pose.pose.position.y),
              2.0 * radius * std::sin(0.5 * 0.157080 * seconds), 0.05);
  EXPECT_TRUE(recorder.waitFor([&recorder] {
    return recorder.diagnostic("device", "dropped: recording_end") == 1.0 &&
           recorder.diagnostic("device", "warned: bad_frame") == 1.0;
  }));
  EXPECT_EQ(recorder.diagnostic("device", "frames of other messages"), kFrames);
  EXPECT_EQ(recorder.diagnostic("device", "frames missed"), 0.0);
  std::remove(recording.c_str());
}

}  // namespace
}  // namespace datmo::device_can_test
