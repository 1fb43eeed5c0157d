// SPDX-License-Identifier: BSD-3-Clause
// The running cloud_to_scan nodelet: the scan and the mount that it makes of a cloud, and what it
// does with an invalid one.
#include <cmath>
#include <vector>

#include "chain.h"
#include "ros/lidar_messages.h"
#include <gtest/gtest.h>

#include <rosgraph_msgs/Clock.h>

namespace datmo::cloud_to_scan_test {
namespace {

class CloudHarness : public Listener {
 public:
  CloudHarness() {
    scan_ = node_.subscribe<sensor_msgs::LaserScan>(
        "scan", kQueue,
        [this](const sensor_msgs::LaserScanConstPtr& scan) { scans.push_back(scan); });
    mounts_ = node_.subscribe<tf2_msgs::TFMessage>(
        "/tf_static", kQueue,
        [this](const tf2_msgs::TFMessageConstPtr& list) { transforms.addStatic(*list); });
    tf2_msgs::TFMessage mount;
    mount.transforms = {samples::transform("base_link", "velodyne", 0.5)};
    mount.transforms[0].transform.translation.z = samples::kLidarHeight;
    tf_static_.publish(mount);
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time(samples::kStart);
    clock_.publish(clock);
  }

  bool waitForNodelet() {
    return waitFor([this] {
      return cloud_.getNumSubscribers() >= 1 && scan_.getNumPublishers() >= 1 &&
             tf_static_.getNumSubscribers() >= 2 && !diagnosticMessage("cloud_to_scan").empty();
    });
  }

  void send(const sensor_msgs::PointCloud2& cloud) { cloud_.publish(cloud); }

  std::vector<sensor_msgs::LaserScanConstPtr> scans;

 private:
  static constexpr std::uint32_t kQueue = 10;

  ros::NodeHandle node_;
  ros::Publisher clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", kQueue, true);
  ros::Publisher tf_static_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", kQueue, true);
  ros::Publisher cloud_ = node_.advertise<sensor_msgs::PointCloud2>("cloud", kQueue);
  ros::Subscriber scan_;
  ros::Subscriber mounts_;
};

TEST(CloudToScanNodelet, ACloudBecomesAScanBelowTheLidar) {
  CloudHarness harness;
  ASSERT_TRUE(harness.waitForNodelet());
  samples::LidarCloudMaker maker;
  maker.addGround();
  maker.addWall(10.5);
  auto cloud = samples::lidarMessage(maker.cloud);
  // The mount may not have arrived yet: sends clouds until one comes out.
  ASSERT_TRUE(harness.waitFor([&] {
    cloud.header.stamp += ros::Duration(0.1);
    harness.send(cloud);
    return !harness.scans.empty();
  })) << harness.diagnosticMessage("cloud_to_scan");
  const sensor_msgs::LaserScan& scan = *harness.scans.front();
  EXPECT_EQ(scan.header.frame_id, "cloud_scan");
  const auto ahead = static_cast<std::size_t>(std::lround(-scan.angle_min / scan.angle_increment));
  EXPECT_NEAR(scan.ranges.at(ahead), 10.0F, 0.02F);
  EXPECT_TRUE(harness.waitFor([&harness] {
    return harness.transforms.core().canTransform("base_link", "cloud_scan", ros::Time(0));
  }));
  EXPECT_TRUE(harness.waitFor([&harness] { return harness.timings["cloud_to_scan"] > 0; }));
  cloud.is_bigendian = 1;
  harness.send(cloud);
  EXPECT_TRUE(harness.waitFor(
      [&harness] { return harness.diagnostic("cloud_to_scan", "dropped: big_endian") == 1.0; }));
}

}  // namespace
}  // namespace datmo::cloud_to_scan_test
