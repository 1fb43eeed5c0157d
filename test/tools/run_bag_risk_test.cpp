// SPDX-License-Identifier: BSD-3-Clause
// The bag runner with risks, on the small drive between two walls.
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>

#include "run_bag_drive.h"
#include <gtest/gtest.h>

#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/ros/convert/host_conversion.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo::run_bag_risk_test {
namespace {

constexpr auto kAllScans = static_cast<std::size_t>(kScans);

class RiskRun : public RunBag {
 protected:
  RiskRun() { arguments_.risk = true; }
};

TEST_F(RiskRun, EveryScanLeadsToRisksWithThePathOfTheHost) {
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/risks"), kAllScans) << table;
  rosbag::Bag bag(arguments_.output);
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/risks"))) {
    const auto risks = message.instantiate<RiskArray>();
    EXPECT_EQ(risks->header.frame_id, "map");
    EXPECT_EQ(risks->host_path.size(), 21U) << "4 s in steps of 0.2";
    EXPECT_GT(risks->host_length, 0.0F);
  }
}

TEST_F(RiskRun, SameBagGivesTheSameBytes) {
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(RiskRun, TheSensorSetConfiguresIt) {
  writeConfig("{risk: {method: thesis}}");
  run();
  EXPECT_EQ(count(arguments_.output, "/risks"), kAllScans);
  std::filesystem::remove(arguments_.output);
  writeConfig("{risk: {methods: thesis}}");
  const std::string message = failure();
  EXPECT_NE(message.find("risk: methods"), std::string::npos) << message;
}

TEST_F(RiskRun, TheMeasuredBrakingOfTheHostIsUsed) {
  const auto pathLength = [&] {
    run();
    rosbag::Bag bag(arguments_.output);
    RiskArrayPtr last;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/risks"))) {
      last = message.instantiate<RiskArray>();
    }
    return last->host_path.back().x - last->host_path.front().x;
  };
  EXPECT_NEAR(pathLength(), 4.0 * kSpeed, 1.0);
  {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      bag.write("/brakes", toTime(stamp), *toAcceleration({-6.0, 0.01}, stamp));
    }
  }
  EXPECT_NEAR(pathLength(), 4.0 * kSpeed, 1.0) << "nobody has named it";
  arguments_.remappings["/acceleration"] = "/brakes";
  EXPECT_LT(pathLength(), 3.0);
  arguments_.remappings["/acceleration"] = "/none";
  std::filesystem::remove(arguments_.output);
  EXPECT_NE(failure().find("AccelWithCovarianceStamped on /none"), std::string::npos);
}

TEST_F(RiskRun, WheelsAndSteeringMayBeJointsOfOneMessage) {
  {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      sensor_msgs::JointState joints = *toSteering(0.3, stamp);
      joints.velocity = {kSpeed / 0.3};
      sensor_msgs::Imu imu;
      imu.header.stamp = toTime(stamp);
      imu.header.frame_id = "base_link";
      imu.orientation_covariance[0] = -1.0;
      imu.linear_acceleration.z = 9.81;
      bag.write("/joint_states", toTime(stamp), joints);
      bag.write("/imu", toTime(stamp), imu);
    }
  }
  writeConfig(
      "{motion: {source: imu_and_wheels, wheel_radius: 0.3}, grid_slam: {map_period: 0.5}}");
  const auto lastPath = [&] {
    run();
    return listsOf<RiskArray>("/risks").back().host_path;
  };
  const auto straight = lastPath();
  EXPECT_NEAR(straight.back().x - straight.front().x, 4.0 * kSpeed, 1.0);
  arguments_.remappings["/steering"] = "/joint_states";
  const auto turning = lastPath();
  EXPECT_GT(turning.back().theta, straight.back().theta + 0.1);
  EXPECT_NEAR(std::hypot(turning[5].x - turning[0].x, turning[5].y - turning[0].y), kSpeed, 0.5)
      << "in 1 s, by the wheels";
}

TEST_F(RiskRun, WithoutTheSwitchThereAreNone) {
  arguments_.risk = false;
  run();
  EXPECT_EQ(count(arguments_.output, "/risks"), 0U);
}

}  // namespace
}  // namespace datmo::run_bag_risk_test
