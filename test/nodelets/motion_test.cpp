// SPDX-License-Identifier: BSD-3-Clause
// The running motion and grid_slam nodelets on an Imu and a twist instead of odometry, with frames
// and mounts from parameters, and frame ids as old drivers write them.
#include <vector>

#include "chain.h"
#include "ros/message_samples.h"
#include <gtest/gtest.h>

#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/Imu.h>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::motion_test {
namespace {

constexpr double kSpeed = 2.0;    // m/s
constexpr double kYawRate = 0.1;  // rad/s

class MotionHarness : public Listener {
 public:
  bool waitForNodelets() {
    return waitFor([this] {
      return imu_.getNumSubscribers() >= 1 && twist_.getNumSubscribers() >= 1 &&
             scan_.getNumSubscribers() >= 1 && odometry_.getNumPublishers() >= 1;
    });
  }

  void sendTwist(double seconds) {
    geometry_msgs::TwistStamped message;
    message.header.stamp = ros::Time(seconds);
    message.header.frame_id = "/robot";
    message.twist.linear.x = kSpeed;
    twist_.publish(message);
  }

  void sendImu(double seconds) {
    sensor_msgs::Imu message;
    message.header.stamp = ros::Time(seconds);
    message.header.frame_id = "/imu_link";
    message.angular_velocity.z = -kYawRate;  // it hangs upside down
    imu_.publish(message);
  }

  void sendScan(double seconds) {
    sensor_msgs::LaserScan message = samples::laserScan();
    message.header.stamp = ros::Time(seconds);
    message.header.frame_id = "/laser";
    scan_.publish(message);
  }

  std::vector<nav_msgs::OdometryConstPtr> odometry;

 private:
  static constexpr std::uint32_t kQueue = 1000;

  ros::NodeHandle node_;
  ros::Publisher imu_ = node_.advertise<sensor_msgs::Imu>("imu", kQueue);
  ros::Publisher twist_ = node_.advertise<geometry_msgs::TwistStamped>("twist", kQueue);
  ros::Publisher scan_ = node_.advertise<sensor_msgs::LaserScan>("scan", kQueue);
  ros::Subscriber odometry_ = node_.subscribe<nav_msgs::Odometry>(
      "motion/odometry", kQueue,
      [this](const nav_msgs::OdometryConstPtr& message) { odometry.push_back(message); });
};

TEST(Motion, AnImuAndATwistLeadToOdometryAndPoses) {
  MotionHarness harness;
  ASSERT_TRUE(harness.waitForNodelets());
  // The Imu's messages are used as soon as the twist is there: two topics, in either order.
  double now = 100.0;
  ASSERT_TRUE(harness.waitFor([&] {
    now += 0.01;
    harness.sendTwist(now);
    harness.sendImu(now);
    return harness.odometry.size() >= 3;
  })) << harness.diagnosticMessage("motion");
  const nav_msgs::Odometry& odometry = *harness.odometry.back();
  EXPECT_EQ(odometry.header.frame_id, "odom");
  EXPECT_EQ(odometry.child_frame_id, "robot");
  EXPECT_NEAR(odometry.twist.twist.linear.x, kSpeed, 1e-9);
  EXPECT_NEAR(odometry.twist.twist.angular.z, kYawRate, 1e-6);
  ASSERT_TRUE(harness.waitFor([&] {
    now += 0.01;
    harness.sendScan(now);
    return !harness.labeled_scans.empty();
  })) << harness.diagnosticMessage("grid_slam");
  EXPECT_EQ(harness.labeled_scans.back()->header.frame_id, "robot");
  EXPECT_NEAR(harness.labeled_scans.back()->scanner.x, 1.0, 1e-9) << "as mounts says";
}

}  // namespace
}  // namespace datmo::motion_test
