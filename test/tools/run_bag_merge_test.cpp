// SPDX-License-Identifier: BSD-3-Clause
// The bag runner on a drive with two scanners.
#include "run_bag_drive.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

namespace datmo::run_bag_merge_test {
namespace {

class RunBagOnTwoScanners : public RunBag {
 protected:
  /// The drive with the right half of its scans on one topic and the left half on the other one.
  void writeHalves(const std::string& right_topic, const std::string& left_topic) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      bag.write("/odometry", toTime(stamp), odometryAt(stamp));
      sensor_msgs::LaserScan left = scanAt(stamp);
      sensor_msgs::LaserScan right = left;
      right.ranges.resize(right.ranges.size() / 2);
      right.angle_max = -right.angle_increment;
      left.angle_min = 0.0F;
      left.ranges.erase(left.ranges.begin(),
                        left.ranges.begin() + static_cast<std::ptrdiff_t>(right.ranges.size()));
      bag.write(right_topic, toTime(stamp), right);
      bag.write(left_topic, toTime(stamp), left);
    }
    bag.write("/tf_static", toTime(kStart),
              transform(Pose2(2.0, 0.0, 0.0), kStart, "base_link", "scanner"));
  }
};

TEST_F(RunBagOnTwoScanners, TheirScansBecomeOneAndPosesFollowTheDrive) {
  writeHalves("/scans/front", "/left");
  arguments_.merge_scans = true;
  arguments_.remappings["/rear_scan"] = "/left";
  run();
  EXPECT_EQ(count(arguments_.output, "/merged_scan"), std::size_t{kScans});
  EXPECT_EQ(count(arguments_.output, "/pose"), std::size_t{kScans});
  rosbag::Bag bag(arguments_.output);
  double x = 0.0;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/pose"))) {
    x = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose.pose.position.x;
  }
  EXPECT_NEAR(x, kSpeed * kPeriod * (kScans - 1), 0.3);
}

TEST_F(RunBagOnTwoScanners, AMissingScannerIsNamed) {
  writeHalves("/scans/front", "/left");
  arguments_.merge_scans = true;
  try {
    run();
    FAIL() << "expected an error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no LaserScan on /scans/rear for --merge-scans"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace datmo::run_bag_merge_test
