// SPDX-License-Identifier: BSD-3-Clause
// Two stacks on one master, each with its own namespace and frame prefix: one vehicle drives, the
// other one is stationary, and neither receives messages of the other.
#include <string>
#include <vector>

#include "chain.h"
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

namespace datmo::two_vehicles_test {
namespace {

constexpr double kStep = 1.0 / 16.0;  // s
constexpr std::uint32_t kQueue = 100;

class Vehicle {
 public:
  Vehicle(std::string name, double speed) : name_(std::move(name)), speed_(speed) {
    pose_ = node_.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
        "pose", kQueue, [this](const auto& pose) { poses.push_back(*pose); });
    tracks_ = node_.subscribe<TrackArray>(
        "tracks", kQueue, [this](const TrackArrayConstPtr& list) { tracks.push_back(*list); });
  }

  bool isConnected() const {
    return scan_.getNumSubscribers() >= 1 && odometry_.getNumSubscribers() >= 1 &&
           pose_.getNumPublishers() >= 1 && tracks_.getNumPublishers() >= 1;
  }

  geometry_msgs::TransformStamped mount() const { return prefixed(world_.scannerInBase()); }

  void sendMotion(double seconds, ros::Publisher& tf) {
    const double drive = speed_ * seconds;
    const ros::Time stamp(World::kStart + seconds);
    auto odometry = world_.odometry(drive);
    odometry.header.stamp = stamp;
    odometry.header.frame_id = name_ + "/" + odometry.header.frame_id;
    odometry.child_frame_id = name_ + "/" + odometry.child_frame_id;
    odometry.twist.twist.linear.x *= speed_;
    odometry_.publish(odometry);
    tf2_msgs::TFMessage transforms;
    transforms.transforms = {prefixed(world_.baseInOdom(drive))};
    transforms.transforms.front().header.stamp = stamp;
    tf.publish(transforms);
  }

  void sendScan(double seconds) {
    auto scan = world_.scan(speed_ * seconds);
    scan.header.stamp = ros::Time(World::kStart + seconds);
    scan.header.frame_id = name_ + "/" + scan.header.frame_id;
    scan_.publish(scan);
  }

  bool hasTracksOf(double seconds) const {
    return !tracks.empty() && tracks.back().header.stamp == ros::Time(World::kStart + seconds);
  }

  std::vector<geometry_msgs::PoseWithCovarianceStamped> poses;
  std::vector<TrackArray> tracks;

 private:
  geometry_msgs::TransformStamped prefixed(geometry_msgs::TransformStamped transform) const {
    transform.header.frame_id = name_ + "/" + transform.header.frame_id;
    transform.child_frame_id = name_ + "/" + transform.child_frame_id;
    return transform;
  }

  std::string name_;
  double speed_;  ///< as a multiple of the world's
  World world_;
  ros::NodeHandle node_{name_};
  ros::Publisher scan_ = node_.advertise<sensor_msgs::LaserScan>("scan", kQueue);
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odometry", kQueue);
  ros::Subscriber pose_;
  ros::Subscriber tracks_;
};

/// All of them belong to the vehicle.
void expectFrames(const Vehicle& vehicle, const std::string& map) {
  for (const auto& pose : vehicle.poses) {
    EXPECT_EQ(pose.header.frame_id, map);
  }
  for (const TrackArray& list : vehicle.tracks) {
    EXPECT_EQ(list.header.frame_id, map);
  }
}

TEST(TwoVehicles, TopicsAndFramesDoNotMix) {
  constexpr std::size_t kScans = 16;
  ros::NodeHandle node;
  ros::Publisher tf = node.advertise<tf2_msgs::TFMessage>("/tf", kQueue);
  ros::Publisher tf_static = node.advertise<tf2_msgs::TFMessage>("/tf_static", kQueue, true);
  Listener listener;
  Vehicle driving("car1", 1.0);
  Vehicle standing("car2", 0.0);
  listener.setClock(ros::Time(World::kStart));
  ASSERT_TRUE(listener.waitFor([&] {
    // One connection of each process, and this test's own.
    return driving.isConnected() && standing.isConnected() && tf.getNumSubscribers() >= 3 &&
           tf_static.getNumSubscribers() >= 2;
  }));
  tf2_msgs::TFMessage mounts;
  mounts.transforms = {driving.mount(), standing.mount()};
  tf_static.publish(mounts);
  for (Vehicle* vehicle : {&driving, &standing}) {
    vehicle->sendMotion(0.0, tf);
  }
  const auto knowsMotion = [&](const std::string& name) {
    return listener.diagnostic(name + "/grid_slam", "odometry received") > 0.0;
  };
  ASSERT_TRUE(listener.waitFor([&] { return knowsMotion("car1") && knowsMotion("car2"); }));
  for (std::size_t i = 1; i <= kScans; ++i) {
    const double now = kStep * static_cast<double>(i);
    listener.setClock(ros::Time(World::kStart + now));
    for (Vehicle* vehicle : {&driving, &standing}) {
      vehicle->sendMotion(now, tf);
      vehicle->sendScan(now);
    }
    ASSERT_TRUE(listener.waitFor([&] {
      return driving.hasTracksOf(now) && standing.hasTracksOf(now);
    })) << i
        << ": " << listener.diagnosticMessage("car1/grid_slam") << " | "
        << listener.diagnosticMessage("car2/grid_slam");
  }
  for (const Vehicle* vehicle : {&driving, &standing}) {
    EXPECT_TRUE(listener.waitFor([&] {
      return vehicle->poses.size() == kScans && vehicle->tracks.size() == kScans;
    })) << vehicle->poses.size()
        << " poses, " << vehicle->tracks.size() << " lists of tracks";
  }
  expectFrames(driving, "car1/map");
  expectFrames(standing, "car2/map");
  const auto traveled = [](const Vehicle& vehicle) {
    return vehicle.poses.back().pose.pose.position.x - vehicle.poses.front().pose.pose.position.x;
  };
  EXPECT_NEAR(traveled(driving), 5.0 * kStep * (static_cast<double>(kScans) - 1.0), 0.3);
  EXPECT_NEAR(traveled(standing), 0.0, 0.1);
  const tf2::BufferCore& frames = listener.transforms.core();
  EXPECT_TRUE(listener.waitFor([&] {
    return frames.canTransform("car1/map", "car1/base_link", ros::Time(0)) &&
           frames.canTransform("car2/map", "car2/base_link", ros::Time(0));
  }));
  EXPECT_FALSE(frames.canTransform("car1/map", "car2/base_link", ros::Time(0)));
  EXPECT_FALSE(frames.canTransform("map", "car1/map", ros::Time(0)));
  EXPECT_TRUE(listener.poses.empty() && listener.tracks.empty()) << "nothing outside of both";
}

}  // namespace
}  // namespace datmo::two_vehicles_test
