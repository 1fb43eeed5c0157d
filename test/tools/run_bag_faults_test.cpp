// SPDX-License-Identifier: BSD-3-Clause
// A message that cannot be valid is dropped without further effects: stamps far off, impossible
// velocities.
#include <functional>
#include <limits>
#include <set>

#include "run_bag_drive.h"
#include <gtest/gtest.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>

namespace datmo::run_bag_faults_test {
namespace {

constexpr int kBad = kScans / 2;  // the scan at which something is wrong
constexpr double kDriven = (kScans - 1) * kPeriod * kSpeed;

class RunBagFaults : public RunBag {
 protected:
  struct Step {
    nav_msgs::Odometry odometry;
    tf2_msgs::TFMessage transform;
    sensor_msgs::LaserScan scan;
  };
  using Spoil = std::function<void(int index, Step& step)>;

  static Step stepAt(Stamp stamp) {
    const nav_msgs::Odometry odometry = odometryAt(stamp);
    return {odometry, transform(fromMessage(odometry.pose.pose), stamp, "odom", "base_link"),
            scanAt(stamp)};
  }

  /// The drive with `spoil` applied to each step; record times are unchanged.
  std::string runSpoiled(const Spoil& spoil) {
    writeConfig("mounts: {scanner: {x: 2.0}}\n");
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      Step step = stepAt(stamp);
      spoil(i, step);
      writeStep(bag, toTime(stamp), step);
    }
    bag.close();
    return run();
  }

  static void writeStep(rosbag::Bag& bag, const ros::Time& time, const Step& step) {
    bag.write("/odometry", time, step.odometry);
    bag.write("/tf", time, step.transform);
    bag.write("/scan", time, step.scan);
  }

  std::vector<double> poses() const {
    std::vector<double> x;
    rosbag::Bag bag(arguments_.output);
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/pose"))) {
      x.push_back(
          message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose.pose.position.x);
    }
    return x;
  }

  std::size_t poseCount() const { return poses().size(); }
};

TEST_F(RunBagFaults, AScanWithAStampFarOffCostsOneScan) {
  for (const double off : {1.0, -1.0, 3600.0, 1e6, -900.0}) {
    const std::string table = runSpoiled([off](int i, Step& step) {
      step.scan.header.stamp += ros::Duration(i == kBad ? off : 0.0);
    });
    EXPECT_EQ(poseCount(), kScans - 1U) << off;
    EXPECT_NEAR(poses().back(), kDriven, 0.3) << off;
    EXPECT_FALSE(holds(table, "clock_restart")) << off;
  }
}

TEST_F(RunBagFaults, OdometryWithAStampFarOffCostsOneMessage) {
  for (const double off : {1.0, -1.0, 3600.0, 1e6, -900.0}) {
    const std::string table = runSpoiled([off](int i, Step& step) {
      step.odometry.header.stamp += ros::Duration(i == kBad ? off : 0.0);
    });
    EXPECT_EQ(poseCount(), static_cast<std::size_t>(kScans)) << off;
    EXPECT_NEAR(poses().back(), kDriven, 0.3) << off;
    EXPECT_FALSE(holds(table, "clock_restart")) << off;
  }
}

TEST_F(RunBagFaults, ATransformWithAStampFarOffCostsOneMessage) {
  for (const double off : {1.0, -1.0, 3600.0, 1e6, -900.0}) {
    runSpoiled([off](int i, Step& step) {
      step.transform.transforms[0].header.stamp += ros::Duration(i == kBad ? off : 0.0);
    });
    EXPECT_EQ(poseCount(), static_cast<std::size_t>(kScans)) << off;
    EXPECT_NEAR(poses().back(), kDriven, 0.3) << off;
  }
}

TEST_F(RunBagFaults, AnImpossibleTwistCostsOneMessage) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Twist2& twist :
       {Twist2{kSpeed, 3.0}, Twist2{kSpeed, -15.0}, Twist2{300.0, 0.0}, Twist2{100.0, 0.0},
        Twist2{-40.0, 0.0}, Twist2{nan, 0.0}, Twist2{kSpeed, nan}}) {
    runSpoiled([&twist](int i, Step& step) {
      if (i == kBad) {
        step.odometry.twist.twist.linear.x = twist.forward_speed;
        step.odometry.twist.twist.angular.z = twist.yaw_rate;
      }
    });
    ASSERT_EQ(poseCount(), static_cast<std::size_t>(kScans));
    EXPECT_NEAR(poses().at(kBad + 1), (kBad + 1) * kPeriod * kSpeed, 0.1) << twist.forward_speed;
    EXPECT_NEAR(poses().back(), kDriven, 0.3) << twist.forward_speed << ", " << twist.yaw_rate;
  }
}

TEST_F(RunBagFaults, AScannersClockThatIsSetCostsOneScan) {
  constexpr int kBegin = 24;
  constexpr int kEnd = 28;
  for (const double off : {0.1, -0.1}) {
    const std::string table = runSpoiled([off](int i, Step& step) {
      step.scan.header.stamp += ros::Duration(i >= kBegin && i < kEnd ? off : 0.0);
    });
    EXPECT_TRUE(holds(table, "clock_off")) << off;
    const std::vector<double> x = poses();
    ASSERT_EQ(x.size(), static_cast<std::size_t>(kScans - 1)) << off;
    // The first one of a clock that is set back, which may be an old message.
    const int dropped = off > 0.0 ? kEnd : kBegin;
    for (int i = 20; i < kScans; ++i) {
      if (i != dropped) {
        EXPECT_NEAR(x[static_cast<std::size_t>(i < dropped ? i : i - 1)], i * kPeriod * kSpeed, 0.1)
            << off << ", scan " << i;
      }
    }
  }
}

TEST_F(RunBagFaults, AClockOffsetOfTheScannerSurvivesAStampFarOff) {
  runSpoiled([](int i, Step& step) {
    const double off = i < 24 ? 0.0 : 0.1;
    step.scan.header.stamp += ros::Duration(i == 26 ? 1.5 : off);
  });
  const std::vector<double> x = poses();
  ASSERT_EQ(x.size(), kScans - 1U);
  EXPECT_NEAR(x.back(), kDriven, 0.1);
}

TEST_F(RunBagFaults, ALoopedBagStartsANewMapAtItsSecondMessage) {
  writeConfig("mounts: {scanner: {x: 2.0}}\n");
  rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
  for (int i = 0; i < 2 * kScans; ++i) {
    const Stamp stamp = kStart + (i % kScans) * kPeriod;
    writeStep(bag, toTime(kStart + i * kPeriod), stepAt(stamp));
  }
  bag.close();
  run();
  const std::vector<double> x = poses();
  ASSERT_EQ(x.size(), 2U * kScans - 1U) << "the first scan of the second run is not confirmed";
  EXPECT_NEAR(x.back(), kDriven - kPeriod * kSpeed, 0.3) << "from where the new map begins";
}

TEST_F(RunBagFaults, AClockJumpAheadStartsANewMapAtTheSecondMessage) {
  for (const double off : {2.0, 50.0, 100.0}) {
    const std::string table = runSpoiled([off](int i, Step& step) {
      const ros::Duration ahead(i < kBad ? 0.0 : off);
      step.odometry.header.stamp += ahead;
      step.transform.transforms[0].header.stamp += ahead;
      step.scan.header.stamp += ahead;
    });
    const std::vector<double> x = poses();
    ASSERT_EQ(x.size(), kScans - 1U) << off;
    EXPECT_TRUE(holds(table, "clock_restart")) << "it is said";
    EXPECT_NEAR(x.at(kBad - 1), (kBad - 1) * kPeriod * kSpeed, 0.1) << off;
    EXPECT_NEAR(x.back(), (kScans - 1 - (kBad + 1)) * kPeriod * kSpeed, 0.3)
        << off << " s: from where the new map begins";
  }
}

}  // namespace
}  // namespace datmo::run_bag_faults_test
