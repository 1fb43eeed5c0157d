// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "run_bag/bag_run.h"
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

// A small drive that is generated here: a car between two walls, at 5 m/s toward a third.
inline constexpr double kSpeed = 5.0;    // m/s
inline constexpr double kPeriod = 0.06;  // s
inline constexpr int kScans = 30;
inline constexpr double kWall = 6.0;  // m, left and right
inline constexpr double kEnd = 25.0;  // m, ahead of where it starts

inline const Stamp kStart = Stamp::fromSeconds(1000.0);

inline sensor_msgs::LaserScan scanAt(Stamp stamp) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = toTime(stamp);
  scan.header.frame_id = "scanner";
  scan.angle_min = static_cast<float>(degrees(-80.0));
  scan.angle_increment = static_cast<float>(degrees(2.0));
  scan.angle_max = static_cast<float>(degrees(80.0));
  scan.range_min = 0.5F;
  scan.range_max = 50.0F;
  for (int beam = 0; beam <= 80; ++beam) {
    const double bearing = degrees(-80.0 + 2.0 * beam);
    const double to_side = kWall / std::abs(std::sin(bearing));
    const double to_end = (kEnd - kSpeed * secondsBetween(kStart, stamp)) / std::cos(bearing);
    scan.ranges.push_back(static_cast<float>(std::min(to_side, to_end)));
  }
  return scan;
}

inline nav_msgs::Odometry odometryAt(Stamp stamp) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = toTime(stamp);
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  odometry.pose.pose = toMessage(Pose2(kSpeed * secondsBetween(kStart, stamp), 0.0, 0.0));
  odometry.twist.twist.linear.x = kSpeed;
  return odometry;
}

inline tf2_msgs::TFMessage transform(const Pose2& pose, Stamp stamp, const std::string& parent,
                                     const std::string& child) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(toTransform(pose, stamp, parent, child));
  return message;
}

/// A folder for each test, with a drive and a sensor set in it.
class RunBag : public testing::Test {
 protected:
  RunBag()
      : folder_(std::filesystem::temp_directory_path() /
                (std::string("run_bag_test_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    arguments_.input = path("in.bag");
    arguments_.output = path("out.bag");
    arguments_.config = path("sensors.yaml");
    writeConfig("grid_slam: {map_period: 0.5}\n");
    writeDrive();
  }
  ~RunBag() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void writeConfig(const std::string& text) const { std::ofstream(arguments_.config) << text; }

  void writeDrive(bool with_mount = true) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      const ros::Time time = toTime(stamp);
      const nav_msgs::Odometry odometry = odometryAt(stamp);
      bag.write("/odometry", time, odometry);
      bag.write("/tf", time,
                transform(fromMessage(odometry.pose.pose), stamp, "odom", "base_link"));
      bag.write("/scan", time, scanAt(stamp));
      bag.write("/ground_truth/pose", time, odometry);
    }
    if (with_mount) {
      bag.write("/tf_static", toTime(kStart + 1.0),
                transform(Pose2(2.0, 0.0, 0.0), kStart, "base_link", "scanner"));
    }
  }

  std::string run() const {
    std::ostringstream out;
    runBag(arguments_, out, nullptr);
    return out.str();
  }

  /// Returns the message of the exception that runBag throws; expects that no output is left.
  std::string failure() const {
    std::string message = "no exception";
    try {
      run();
    } catch (const std::exception& error) {
      message = error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(arguments_.output));
    EXPECT_FALSE(std::filesystem::exists(arguments_.output + ".part"));
    return message;
  }

  static std::string bytes(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
  }

  static std::size_t count(const std::string& file, const std::string& topic) {
    rosbag::Bag bag(file);
    return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
  }

  /// Returns all messages of a topic of the output.
  template <typename Message>
  std::vector<Message> listsOf(const std::string& topic) const {
    rosbag::Bag bag(arguments_.output);
    std::vector<Message> lists;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      lists.push_back(*message.template instantiate<Message>());
    }
    return lists;
  }

  std::filesystem::path folder_;
  Arguments arguments_;
};

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace datmo
