// SPDX-License-Identifier: BSD-3-Clause
// The bag runner on a drive whose scans are made of a 3D lidar's clouds.
#include <cstring>

#include "run_bag_drive.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/point_field.h"

namespace datmo::run_bag_cloud_test {
namespace {

/// A road around the scanner and, 0.6 m above it, what its planar scan measures.
std::vector<float> pointsOf(const sensor_msgs::LaserScan& scan) {
  std::vector<float> numbers;
  const auto add = [&numbers](double bearing, double range, float z) {
    numbers.insert(numbers.end(), {static_cast<float>(range * std::cos(bearing)),
                                   static_cast<float>(range * std::sin(bearing)), z});
  };
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double bearing = scan.angle_min + scan.angle_increment * static_cast<double>(beam);
    add(bearing, scan.ranges[beam], 0.6F);
    for (double range = 3.0; range < scan.ranges[beam]; range += 1.0) {
      add(bearing, range, 0.0F);
    }
  }
  return numbers;
}

sensor_msgs::PointCloud2 cloudAt(Stamp stamp) {
  const sensor_msgs::LaserScan scan = scanAt(stamp);
  const std::vector<float> numbers = pointsOf(scan);
  sensor_msgs::PointCloud2 cloud;
  cloud.header = scan.header;
  cloud.fields = floatFields({"x", "y", "z"});
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(numbers.size() / 3);
  cloud.point_step = 3 * sizeof(float);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  std::memcpy(cloud.data.data(), numbers.data(), cloud.data.size());
  return cloud;
}

class RunBagOnClouds : public RunBag {
 protected:
  /// The drive with clouds instead of scans.
  void writeClouds(const std::string& topic) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      bag.write("/odometry", toTime(stamp), odometryAt(stamp));
      bag.write(topic, toTime(stamp), cloudAt(stamp));
    }
    bag.write("/tf_static", toTime(kStart + 1.0),
              transform(Pose2(2.0, 0.0, 0.0), kStart, "base_link", "scanner"));
  }
};

TEST_F(RunBagOnClouds, EveryCloudLeadsToAScanAndAPose) {
  writeClouds("/cloud");
  run();
  EXPECT_EQ(count(arguments_.output, "/cloud_scan"), std::size_t{kScans});
  EXPECT_EQ(count(arguments_.output, "/pose"), std::size_t{kScans});
  EXPECT_EQ(count(arguments_.output, "/labeled_scan"), std::size_t{kScans});
  EXPECT_GE(count(arguments_.output, "/tf_static"), 1U) << "where the scans are from";
}

TEST_F(RunBagOnClouds, PosesFollowTheDrive) {
  writeClouds("/cloud");
  run();
  rosbag::Bag bag(arguments_.output);
  double x = 0.0;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/pose"))) {
    x = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose.pose.position.x;
  }
  EXPECT_NEAR(x, kSpeed * kPeriod * (kScans - 1), 0.2);
}

TEST_F(RunBagOnClouds, ANamedCloudReplacesScans) {
  writeClouds("/velodyne_points");
  EXPECT_NE(failure().find("cloud:=TOPIC"), std::string::npos) << "how to name it";
  arguments_.remappings["/cloud"] = "/velodyne_points";
  run();
  EXPECT_EQ(count(arguments_.output, "/pose"), std::size_t{kScans});
}

TEST_F(RunBagOnClouds, ObjectsOfCloudsAreFusedOnlyWithTheirSwitch) {
  writeClouds("/cloud");
  arguments_.cloud_objects = true;
  run();
  std::size_t of_clouds = 0;
  for (const ObjectArray& list : listsOf<ObjectArray>("/objects/fused")) {
    for (const auto& object : list.objects) {
      of_clouds += static_cast<std::size_t>(
          std::count(object.sensors.begin(), object.sensors.end(), "cloud"));
    }
  }
  EXPECT_GT(of_clouds, 0U);
}

TEST_F(RunBagOnClouds, AMissingCloudIsNamed) {
  arguments_.remappings["/cloud"] = "/velodyne_points";
  EXPECT_NE(failure().find("no PointCloud2 on /velodyne_points"), std::string::npos);
}

}  // namespace
}  // namespace datmo::run_bag_cloud_test
