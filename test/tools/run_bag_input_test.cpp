// SPDX-License-Identifier: BSD-3-Clause
// Recordings as found in practice: slashes in frame ids, no tf, no odometry, and rejected input.
#include "ros/raw_message.h"
#include "run_bag/input_refusals.h"
#include "run_bag_drive.h"
#include <gtest/gtest.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/Imu.h>

namespace datmo::run_bag_input_test {
namespace {

class RunBagInput : public RunBag {
 protected:
  /// The drive again, as `write` writes it at each scan.
  template <typename Write>
  void rewrite(const Write& write) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    for (int i = 0; i < kScans; ++i) {
      write(bag, kStart + i * kPeriod);
    }
  }

  void writeSlashedDrive() const {
    rewrite([](rosbag::Bag& bag, Stamp stamp) {
      nav_msgs::Odometry odometry = odometryAt(stamp);
      odometry.header.frame_id = "/odom";
      odometry.child_frame_id = "/base_link";
      sensor_msgs::LaserScan scan = scanAt(stamp);
      scan.header.frame_id = "/scanner";
      const ros::Time time = toTime(stamp);
      bag.write("/odometry", time, odometry);
      bag.write("/tf", time, transform(Pose2(2.0, 0.0, 0.0), stamp, "/base_link", "/scanner"));
      bag.write("/scan", time, scan);
    });
  }

  double endX() const {
    rosbag::Bag bag(arguments_.output);
    double x = 0.0;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/pose"))) {
      x = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose.pose.position.x;
    }
    return x;
  }

  void expectWholeDrive() const {
    EXPECT_EQ(count(arguments_.output, "/tracks"), static_cast<std::size_t>(kScans));
    EXPECT_NEAR(endX(), (kScans - 1) * kPeriod * kSpeed, 0.3);
  }
};

TEST_F(RunBagInput, LeadingSlashesAreStrippedAndCounted) {
  writeSlashedDrive();
  const std::string table = run();
  expectWholeDrive();
  EXPECT_TRUE(holds(table, "messages on /odometry with a leading slash stripped")) << table;
  EXPECT_TRUE(holds(table, "messages on /tf with a leading slash stripped")) << table;
  EXPECT_FALSE(holds(table, "refused")) << table;
}

TEST_F(RunBagInput, AnUndecodableMessageCostsOneMessage) {
  int written = 0;
  rewrite([&written](rosbag::Bag& bag, Stamp stamp) {
    const ros::Time time = toTime(stamp);
    bag.write("/odometry", time, odometryAt(stamp));
    bag.write("/tf", time, transform(Pose2(2.0, 0.0, 0.0), stamp, "base_link", "scanner"));
    RawMessage<sensor_msgs::LaserScan> scan = toRaw(scanAt(stamp));
    if (++written == kScans / 2) {
      scan.bytes.resize(30);
    }
    bag.write("/scan", time, scan);
  });
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/tracks"), static_cast<std::size_t>(kScans - 1));
  EXPECT_TRUE(holds(table, "undecodable_message")) << table;
}

TEST_F(RunBagInput, AStampAtTheEndOfTimeCostsOneMessage) {
  rewrite([](rosbag::Bag& bag, Stamp stamp) {
    const ros::Time time = toTime(stamp);
    nav_msgs::Odometry odometry = odometryAt(stamp);
    bag.write("/odometry", time, odometry);
    bag.write("/tf", time, transform(Pose2(2.0, 0.0, 0.0), stamp, "base_link", "scanner"));
    bag.write("/scan", time, scanAt(stamp));
    odometry.header.stamp = ros::Time(4294967295U, 0);
    bag.write("/odometry", time, odometry);
    auto nobody = transform(Pose2(), stamp, "nobody", "knows");
    nobody.transforms[0].header.stamp = ros::Time(4294967295U, 0);
    bag.write("/tf", time, nobody);
  });
  const std::string table = run();
  expectWholeDrive();
  EXPECT_TRUE(holds(table, "stamp_out_of_range")) << table;
}

TEST_F(RunBagInput, AMountInTheYamlFileReplacesTf) {
  writeDrive(false);
  writeConfig("mounts: {scanner: {x: 2.0}}\n");
  run();
  expectWholeDrive();
}

TEST_F(RunBagInput, FramesAreSetOnceForAllStages) {
  rewrite([](rosbag::Bag& bag, Stamp stamp) {
    nav_msgs::Odometry odometry = odometryAt(stamp);
    odometry.header.frame_id = "wheels";
    odometry.child_frame_id = "robot";
    bag.write("/odometry", toTime(stamp), odometry);
    bag.write("/scan", toTime(stamp), scanAt(stamp));
  });
  writeConfig("frames: {map: world, odom: wheels, base: robot}\nmounts: {scanner: {x: 2.0}}\n");
  run();
  expectWholeDrive();
  rosbag::Bag bag(arguments_.output);
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/tracks"))) {
    EXPECT_EQ(message.instantiate<TrackArray>()->header.frame_id, "world");
  }
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/tf"))) {
    const auto tf = message.instantiate<tf2_msgs::TFMessage>();
    EXPECT_EQ(tf->transforms.at(0).header.frame_id, "world");
    EXPECT_EQ(tf->transforms.at(0).child_frame_id, "wheels");
  }
}

TEST_F(RunBagInput, AWholeInputThatIsRefusedEndsTheRun) {
  writeConfig("frames: {odom: wheels}\n");
  EXPECT_THROW(run(), NoUsableInput);
  const std::string message = failure();
  for (const char* const part :
       {"/odometry: all 30 messages were refused", "30 as wrong_frame", "'base_link' in 'odom'",
        "frames: {odom: odom, base: base_link}"}) {
    EXPECT_TRUE(holds(message, part)) << part << " not in: " << message;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

TEST_F(RunBagInput, APartThatIsRefusedIsSummedUp) {
  int written = 0;
  rewrite([&written](rosbag::Bag& bag, Stamp stamp) {
    nav_msgs::Odometry odometry = odometryAt(stamp);
    if (++written % 10 == 0) {
      odometry.twist.twist.linear.x = 1e6;
    }
    bag.write("/odometry", toTime(stamp), odometry);
    bag.write("/scan", toTime(stamp), scanAt(stamp));
  });
  writeConfig("mounts: {scanner: {x: 2.0}}\n");
  const std::string table = run();
  EXPECT_TRUE(holds(table, "refused on /odometry, bad_odometry")) << table;
  EXPECT_TRUE(holds(table, "3 of 30")) << table;
}

TEST_F(RunBagInput, ScansThatAreAllRefusedAreReportedWithWhatToDo) {
  writeDrive(false);
  const std::string message = failure();
  for (const char* const part :
       {"/scan: all 30 messages were refused", "missing_transform", "mounts: {scanner: "}) {
    EXPECT_TRUE(holds(message, part)) << part << " not in: " << message;
  }
}

class RunBagMotion : public RunBagInput {
 protected:
  void writeMotion(bool with_imu, bool with_twist) const {
    rewrite([&](rosbag::Bag& bag, Stamp stamp) {
      sensor_msgs::Imu imu;
      imu.header.stamp = toTime(stamp);
      imu.header.frame_id = "base_link";
      geometry_msgs::TwistStamped twist;
      twist.header = imu.header;
      twist.twist.linear.x = kSpeed;
      if (with_twist) {
        bag.write("/twist", toTime(stamp), twist);
      }
      if (with_imu) {
        bag.write("/imu", toTime(stamp), imu);
      }
      bag.write("/scan", toTime(stamp), scanAt(stamp));
    });
  }

  void runWith(const std::string& source) const {
    writeConfig("motion: {source: " + source + "}\nmounts: {scanner: {x: 2.0}}\n");
    run();
    EXPECT_EQ(count(arguments_.output, "/tracks"), static_cast<std::size_t>(kScans));
  }
};

TEST_F(RunBagMotion, ATwistReplacesOdometry) {
  writeMotion(false, true);
  runWith("twist");
  expectWholeDrive();
}

TEST_F(RunBagMotion, AnImuAndATwistReplaceOdometry) {
  writeMotion(true, true);
  runWith("imu_and_twist");
  expectWholeDrive();
}

TEST_F(RunBagMotion, AnImuAloneLeavesTheSpeedToTheScans) {
  writeMotion(true, false);
  runWith("imu");
  EXPECT_NEAR(endX(), (kScans - 1) * kPeriod * kSpeed, 0.5);
}

TEST_F(RunBagMotion, MissingInputsAreNamed) {
  writeMotion(true, false);
  writeConfig("motion: {source: imu_and_twist}\n");
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "no TwistStamped on /twist")) << message;
}

}  // namespace
}  // namespace datmo::run_bag_input_test
