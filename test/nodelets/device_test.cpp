// SPDX-License-Identifier: BSD-3-Clause
// The running device nodelet with a fake scanner: its scans, and what it says when the scanner is
// gone and comes back.
#include <vector>

#include "chain.h"
#include "device/fake_scanner.h"
#include <gtest/gtest.h>

namespace datmo::device_test {
namespace {

constexpr int kPort = 20940;  // device.test's

class ScanDoor : public Listener {
 public:
  ScanDoor() {
    scan_ = node_.subscribe<sensor_msgs::LaserScan>(
        "scan", kQueue,
        [this](const sensor_msgs::LaserScanConstPtr& scan) { scans.push_back(scan); });
  }

  bool isConnected() const { return scan_.getNumPublishers() > 0; }

  std::vector<sensor_msgs::LaserScanConstPtr> scans;

 private:
  static constexpr std::uint32_t kQueue = 10;

  ros::NodeHandle node_;
  ros::Subscriber scan_;
};

TEST(DeviceTest, AScannersScansComeAndItsFailureIsSaid) {
  samples::FakeScanner scanner(kPort);
  ScanDoor door;
  ASSERT_TRUE(door.waitFor([&door] { return door.isConnected(); }));
  scanner.accept();
  scanner.shakeHands();
  const ros::Time before = ros::Time::now();
  scanner.send(samples::FakeScanner::scan(100, {1000, 2000, 65533, 1, 5000}));
  ASSERT_TRUE(door.waitFor([&door] { return !door.scans.empty(); }));
  const sensor_msgs::LaserScan& scan = *door.scans.front();
  EXPECT_EQ(scan.header.frame_id, "front_laser");
  EXPECT_GE(scan.header.stamp, before - ros::Duration(samples::FakeScanner::kSweep + 1e-6));
  EXPECT_LE(scan.header.stamp, ros::Time::now());
  ASSERT_EQ(scan.ranges.size(), samples::FakeScanner::kBeams);
  EXPECT_FLOAT_EQ(scan.ranges[1], 2.0F);
  EXPECT_TRUE(std::isinf(scan.ranges[2]));
  EXPECT_TRUE(std::isnan(scan.ranges[3]));
  EXPECT_NEAR(scan.angle_min, -0.785398, 1e-6);
  EXPECT_NEAR(scan.angle_increment, samples::FakeScanner::kBeamSpacing, 1e-6);
  EXPECT_FLOAT_EQ(scan.range_min, 0.02F);
  EXPECT_FLOAT_EQ(scan.range_max, 30.0F);
  EXPECT_FLOAT_EQ(scan.scan_time, 0.025F);

  scanner.send(samples::FakeScanner::scan(175, {1000, 1000, 1000, 1000, 1000}));
  EXPECT_TRUE(door.waitFor([&door] {
    return door.diagnostic("device", "scans missed") == 2.0 &&
           door.diagnostic("device", "connections") == 1.0;
  }));

  scanner.close();
  EXPECT_TRUE(door.waitFor(
      [&door] { return door.diagnostic("device", "dropped: lost_connection") >= 1.0; }));
  EXPECT_NE(door.diagnosticMessage("device").find("127.0.0.1:20940 has closed the connection"),
            std::string::npos)
      << door.diagnosticMessage("device");
  scanner.accept();
  scanner.shakeHands();
  scanner.send(samples::FakeScanner::scan(5, {1000, 1000, 1000, 1000, 1000}));
  EXPECT_TRUE(door.waitFor([&door] { return door.scans.size() == 3; }));
  EXPECT_TRUE(door.waitFor([&door] { return door.diagnostic("device", "connections") == 2.0; }));
}

}  // namespace
}  // namespace datmo::device_test
