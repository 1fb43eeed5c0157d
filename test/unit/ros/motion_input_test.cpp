// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/motion_input.h"

#include <limits>

#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::motion_input_test {
namespace {

using samples::reasonOf;

Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

/// Odometry of a vehicle that drives ahead at 10 m/s, whose wheels measure 11 m per second.
nav_msgs::Odometry odometry(double seconds) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.twist.twist.linear.x = 10.0;
  message.pose.pose = toMessage(Pose2(11.0 * seconds, 0.0, 0.0));
  return message;
}

/// Pose of a vehicle that drives ahead at 12 m/s according to the SLAM.
geometry_msgs::PoseWithCovarianceStamped pose(double seconds) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = "map";
  message.pose.pose = toMessage(Pose2(3.0, 12.0 * seconds, kQuarterTurn));
  return message;
}

MotionOptions optionsWith(bool with_odometry, bool use_poses) {
  MotionOptions options;
  options.source = with_odometry ? MotionSource::kOdometry : MotionSource::kNone;
  options.odometry_pose = use_poses;
  return options;
}

/// A stage whose only input is its motion.
class MovingStage {
 public:
  explicit MovingStage(bool with_odometry, bool use_poses = false)
      : runner_(monitor_, StreamOptions(), "forgets the motion", [this] { input.reset(); }),
        input(optionsWith(with_odometry, use_poses), {}, runner_) {}

  std::uint64_t warningCount() const { return monitor_.warningCount(); }

 private:
  StageMonitor monitor_{"stage"};
  StageRunner runner_;

 public:
  MotionInput input;
};

TEST(MotionInput, OdometryGivesTheMotionBySpeedOrByPose) {
  MovingStage speed_stage(true);
  MovingStage pose_stage(true, true);
  MotionInput& by_speed = speed_stage.input;
  MotionInput& by_pose = pose_stage.input;
  for (const double t : {100.0, 100.1, 100.2}) {
    by_speed.update(odometry(t));
    by_pose.update(odometry(t));
    by_speed.update(pose(t));  // not read
  }
  EXPECT_NEAR(by_speed.between(at(100.05), at(100.15))->x(), 1.0, 1e-9);
  EXPECT_NEAR(by_pose.between(at(100.05), at(100.15))->x(), 1.1, 1e-9);
  EXPECT_FALSE(by_speed.between(at(100.2), at(101.0))) << "longer than hold";
}

TEST(MotionInput, RepeatedOdometryIsUsedAsLongAsItsLastMeasurement) {
  for (const bool use_poses : {false, true}) {
    MovingStage stage(true, use_poses);
    stage.input.update(odometry(100.0));
    nav_msgs::Odometry frozen = odometry(100.1);
    for (const double t : {100.1, 100.3, 100.6}) {
      frozen.header.stamp = ros::Time(t);
      stage.input.update(frozen);
    }
    frozen.header.stamp = ros::Time(100.7);
    EXPECT_EQ(reasonOf([&] { stage.input.update(frozen); }), "frozen_odometry");
    stage.input.update(odometry(100.8));
    EXPECT_TRUE(stage.input.between(at(100.8), at(100.9)));
  }
}

TEST(MotionInput, OdometryAtRestOrWithoutAPoseMayRepeatItself) {
  MovingStage standing(true);
  MovingStage without_pose(true);
  for (const double t : {100.0, 101.0, 102.0, 103.0}) {
    nav_msgs::Odometry message = odometry(t);
    message.pose.pose = toMessage(Pose2(1.0, 2.0, 0.3));
    without_pose.input.update(message);
    message.twist.twist.linear.x = t > 100.0 ? 0.0 : 10.0;
    message.pose.pose = toMessage(Pose2(t > 100.0 ? 1.0 : 0.0, 2.0, 0.3));
    standing.input.update(message);
  }
  EXPECT_EQ(standing.warningCount() + without_pose.warningCount(), 0U);
}

TEST(MotionInput, WithoutOdometryThePosesOfTheSlamAreUsed) {
  MovingStage stage(false);
  MotionInput& input = stage.input;
  input.update(odometry(100.0));  // not read
  input.update(pose(100.0));
  EXPECT_FALSE(input.between(at(100.0), at(100.1))) << "one pose tells no motion";
  input.update(pose(100.1));
  input.update(pose(100.2));
  const auto motion = input.between(at(100.2), at(100.3));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->x(), 1.2, 1e-9) << "as it was before";
  EXPECT_NEAR(motion->y(), 0.0, 1e-9);
}

TEST(MotionInput, BadOdometryIsRefused) {
  MovingStage stage(true);
  MotionInput& input = stage.input;
  nav_msgs::Odometry bad = odometry(100.0);
  bad.twist.twist.linear.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reasonOf([&] { input.update(bad); }), "bad_odometry");
  bad = odometry(100.0);
  bad.child_frame_id = "trailer";
  EXPECT_EQ(reasonOf([&] { input.update(bad); }), "wrong_frame");
  input.update(odometry(100.0));
  EXPECT_EQ(reasonOf([&] { input.update(odometry(100.0)); }), "repeated_stamp");
}

TEST(MotionInput, APoseIsUsedWithoutItsAbsurdTwist) {
  MovingStage stage(true, true);
  stage.input.update(odometry(100.0));
  nav_msgs::Odometry spinning = odometry(103.0);
  spinning.twist.twist.angular.z = 26.0;
  stage.input.update(spinning);
  EXPECT_EQ(stage.warningCount(), 1U);
  EXPECT_NEAR(stage.input.between(at(100.0), at(103.0))->x(), 33.0, 1e-9);
  EXPECT_FALSE(stage.input.between(at(103.0), at(103.1)));
  spinning.header.stamp = ros::Time(103.1);
  spinning.pose.pose.orientation.w = 2.0;
  EXPECT_EQ(reasonOf([&] { stage.input.update(spinning); }), "bad_pose");
}

TEST(MotionInput, PoseJumpsAreRefusedAndTheNextPosesUsed) {
  MovingStage stage(false);
  MotionInput& input = stage.input;
  geometry_msgs::PoseWithCovarianceStamped bad = pose(100.0);
  bad.pose.pose.orientation.w = 2.0;
  EXPECT_EQ(reasonOf([&] { input.update(bad); }), "bad_pose");
  input.update(pose(100.0));
  bad = pose(100.1);
  bad.pose.pose.position.x = 1000.0;
  EXPECT_EQ(reasonOf([&] { input.update(bad); }), "pose_jump");
  EXPECT_EQ(reasonOf([&] { input.update(pose(100.2)); }), "pose_jump") << "back again";
  input.update(pose(100.3));
  EXPECT_NEAR(input.between(at(100.3), at(100.4))->x(), 1.2, 1e-9);
}

TEST(MotionInput, AJumpBackStartsOver) {
  MovingStage stage(true);
  MotionInput& input = stage.input;
  input.update(odometry(200.0));
  input.update(odometry(100.0));
  EXPECT_EQ(stage.warningCount(), 1U);
  input.update(odometry(100.1));
  EXPECT_NEAR(input.between(at(100.0), at(100.1))->x(), 1.0, 1e-9);
  input.reset();
  EXPECT_FALSE(input.between(at(100.0), at(100.1)));
}

}  // namespace
}  // namespace datmo::motion_input_test
