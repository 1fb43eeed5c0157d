// SPDX-License-Identifier: BSD-3-Clause
// The topics of each kind of device, and what is published on them; no device is running.
#include "datmo_fusion/ros/device_output.h"

#include <string>
#include <utility>
#include <vector>

#include "chain.h"
#include <gtest/gtest.h>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::device_output_test {
namespace {

using Topics = std::vector<std::string>;

const Stamp kStamp = Stamp::fromSeconds(1000.0);
constexpr char kDevice[] = "mast";
constexpr char kVehicle[] = "";  // an empty frame means the vehicle's

/// All messages on a topic.
template <typename Message>
class Kept {
 public:
  Kept(ros::NodeHandle& node, const std::string& topic)
      : subscriber_(node.subscribe<Message>(
            topic, kQueue,
            [this](const boost::shared_ptr<const Message>& one) { messages.push_back(one); })) {}

  std::vector<boost::shared_ptr<const Message>> messages;

 private:
  static constexpr std::uint32_t kQueue = 10;

  ros::Subscriber subscriber_;
};

class DeviceOutputTest : public testing::Test {
 protected:
  DeviceOutput outputOf(DeviceKind kind) {
    options_.frame = kDevice;
    options_.device.kind = kind;
    return {node_, options_};
  }

  static DeviceMeasurement measured(DeviceData data) {
    DeviceMeasurement measurement;
    measurement.stamp = kStamp;
    measurement.data = std::move(data);
    return measurement;
  }

  template <typename Message>
  bool waitForOne(const Kept<Message>& kept) {
    return listener_.waitFor([&] { return !kept.messages.empty(); });
  }

  template <typename Message>
  static void expectHeader(const Message& message, const std::string& frame = kDevice) {
    EXPECT_EQ(message.header.frame_id, frame);
    EXPECT_EQ(message.header.stamp, toTime(kStamp));
  }

  Listener listener_;
  ros::NodeHandle node_{"mast_device"};
  DeviceOptions options_;
};

TEST_F(DeviceOutputTest, AScannersScans) {
  for (const DeviceKind kind : {DeviceKind::kHokuyo, DeviceKind::kSickLms}) {
    DeviceOutput output = outputOf(kind);
    EXPECT_EQ(output.topics(), Topics{"/mast_device/scan"});
    const Kept<sensor_msgs::LaserScan> scans(node_, "scan");
    DeviceScan scan;
    scan.ranges = {1.0F, 2.0F};
    output.publish(measured(scan));
    ASSERT_TRUE(waitForOne(scans));
    expectHeader(*scans.messages[0]);
    EXPECT_EQ(scans.messages[0]->ranges, scan.ranges);
  }
}

/// ROS numbers only what goes through a connection.
TEST_F(DeviceOutputTest, MessagesAreNumberedForNodeletsOfTheSameProcess) {
  DeviceOutput output = outputOf(DeviceKind::kSickLms);
  const Kept<sensor_msgs::LaserScan> scans(node_, "scan");
  for (std::uint32_t number = 1; number <= 3; ++number) {
    output.publish(measured(DeviceScan()));
    ASSERT_TRUE(listener_.waitFor([&] { return scans.messages.size() == number; }));
    EXPECT_EQ(scans.messages.back()->header.seq, number);
  }
}

TEST_F(DeviceOutputTest, ALidarsTurns) {
  DeviceOutput output = outputOf(DeviceKind::kVelodyne);
  EXPECT_EQ(output.topics(), Topics{"/mast_device/points"});
  const Kept<sensor_msgs::PointCloud2> clouds(node_, "points");
  output.publish(measured(DeviceCloud{{CloudPoint(), CloudPoint()}}));
  ASSERT_TRUE(waitForOne(clouds));
  expectHeader(*clouds.messages[0]);
  EXPECT_EQ(clouds.messages[0]->width, 2U);
}

TEST_F(DeviceOutputTest, AReceiversPositionsAndVelocitiesAreOnTheirOwnTopics) {
  DeviceOutput output = outputOf(DeviceKind::kNmea);
  EXPECT_EQ(output.topics(), (Topics{"/mast_device/gnss", "/mast_device/twist"}));
  const Kept<sensor_msgs::NavSatFix> fixes(node_, "gnss");
  const Kept<geometry_msgs::TwistStamped> velocities(node_, "twist");
  output.publish(measured(SatelliteFix{SatelliteFix::Kind::kSatellites, 45.0, 5.0, 200.0}));
  ASSERT_TRUE(waitForOne(fixes));
  EXPECT_TRUE(velocities.messages.empty());
  output.publish(measured(GroundVelocity{3.0, 0.0}));
  ASSERT_TRUE(waitForOne(velocities));
  expectHeader(*fixes.messages[0]);
  expectHeader(*velocities.messages[0], kVehicle);
  EXPECT_EQ(fixes.messages[0]->latitude, 45.0);
  EXPECT_EQ(velocities.messages[0]->twist.linear.x, 3.0);
  EXPECT_EQ(fixes.messages.size(), 1U);
}

TEST_F(DeviceOutputTest, ABusHasTheTopicsOfItsSignals) {
  EXPECT_EQ(outputOf(DeviceKind::kCan).topics(), Topics{"/mast_device/twist"});
  CanOptions& can = options_.device.can;
  can.steering = "a signal";
  can.acceleration = "another one";
  EXPECT_EQ(outputOf(DeviceKind::kCan).topics(),
            (Topics{"/mast_device/twist", "/mast_device/steering", "/mast_device/acceleration"}));
  can.yaw_from = CanYaw::kSteering;
  EXPECT_EQ(outputOf(DeviceKind::kCan).topics(),
            (Topics{"/mast_device/twist", "/mast_device/acceleration"}))
      << "the yaw rate says the same as the steering";
}

TEST_F(DeviceOutputTest, SteeringAndAccelerationOfABusFollowOnlyIfTheyAreNew) {
  options_.device.can.steering = "a signal";
  options_.device.can.acceleration = "another one";
  DeviceOutput output = outputOf(DeviceKind::kCan);
  const Kept<geometry_msgs::TwistStamped> twists(node_, "twist");
  const Kept<sensor_msgs::JointState> angles(node_, "steering");
  const Kept<geometry_msgs::AccelWithCovarianceStamped> accelerations(node_, "acceleration");
  output.publish(measured(VehicleTwist{5.0, 0.1, 0, {}, {}}));
  ASSERT_TRUE(waitForOne(twists));
  const Stamp earlier = kStamp + -0.01;
  output.publish(
      measured(VehicleTwist{6.0, 0.1, 0, StampedValue{0.2, earlier}, StampedValue{-3.0, earlier}}));
  ASSERT_TRUE(waitForOne(angles) && waitForOne(accelerations));
  ASSERT_EQ(twists.messages.size(), 2U);
  expectHeader(*twists.messages[1], kVehicle);
  EXPECT_EQ(twists.messages[1]->twist.linear.x, 6.0);
  EXPECT_EQ(angles.messages.size(), 1U);
  EXPECT_EQ(angles.messages[0]->position, std::vector<double>{0.2});
  EXPECT_EQ(angles.messages[0]->header.stamp, toTime(earlier)) << "its own";
  EXPECT_EQ(accelerations.messages.size(), 1U);
  EXPECT_EQ(accelerations.messages[0]->accel.accel.linear.x, -3.0);
  EXPECT_EQ(accelerations.messages[0]->header.stamp, toTime(earlier));
}

}  // namespace
}  // namespace datmo::device_output_test
