#include "datmo_fusion/ros/motion_input.h"

#include <utility>

#include "datmo_fusion/ros/input_error.h"
#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {

void MotionInputOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"odometry", "", "the vehicle has odometry; false: it is not read"}, odometry);
  visitor.toggle({"odometry_pose", "",
                  "the odometry's poses tell the motion, as a robot's wheel encoders count it; "
                  "false: its speed and yaw rate do"},
                 odometry_pose);
  visitor.text({"odom_frame", "", "frame of the odometry"}, odom_frame, {});
  visitor.number(
      {"odometry_hold", "s", "how long the last odometry serves when no newer one comes"},
      odometry_hold, {0.0, 10.0});
}

MotionInput::MotionInput(const MotionInputOptions& options, std::string base_frame,
                         double restart_after)
    : options_(options),
      base_frame_(std::move(base_frame)),
      restart_after_(restart_after),
      stamps_(restart_after),
      buffer_(options.odometry_hold, kOdometryMemory) {
  checkOptions(options);
}

Arrival MotionInput::take(const nav_msgs::Odometry& message) {
  if (!options_.odometry) {
    return Arrival::kNext;
  }
  if (message.header.frame_id != options_.odom_frame || message.child_frame_id != base_frame_) {
    throw InputError("wrong_frame", "odometry of '" + message.child_frame_id + "' in '" +
                                        message.header.frame_id + "': expected '" + base_frame_ +
                                        "' in '" + options_.odom_frame + "'");
  }
  OdometrySample sample = toSample(message);
  if (options_.odometry_pose) {
    sample.base_in_odom = fromMessage(message.pose.pose);
  }
  const Arrival arrival = checkStamp(message.header.stamp);
  buffer_.add(sample);
  return arrival;
}

Arrival MotionInput::take(const geometry_msgs::PoseWithCovarianceStamped& message) {
  if (options_.odometry) {
    return Arrival::kNext;
  }
  const Pose2 pose = fromMessage(message.pose.pose);
  const Arrival arrival = checkStamp(message.header.stamp);
  const std::optional<StampedPose> before = last_pose_;
  last_pose_ = {toStamp(message.header.stamp), pose};
  if (!before) {
    return arrival;
  }
  const double seconds = secondsBetween(before->stamp, last_pose_->stamp);
  const Pose2 motion = before->pose.inverse() * pose;
  const Twist2 twist = twistOf(motion, seconds);
  // The twist knows nothing of a jump sideways.
  const double speed = motion.position().norm() / seconds;
  if (!isPlausible({speed, twist.yaw_rate})) {
    throw InputError("pose_jump", "pose that moved at " + std::to_string(speed) + " m/s and " +
                                      std::to_string(twist.yaw_rate) + " rad/s: expected at most " +
                                      std::to_string(kMostSpeed) + " m/s and " +
                                      std::to_string(kMostYawRate) + " rad/s");
  }
  // What the vehicle did up to this pose is what it is expected to do after it.
  buffer_.add({last_pose_->stamp, twist, pose});
  return arrival;
}

Arrival MotionInput::checkStamp(const ros::Time& stamp) {
  const Arrival arrival = stamps_.check(stamp);
  if (arrival == Arrival::kRestart) {
    reset();
    stamps_.check(stamp);
  }
  return arrival;
}

void MotionInput::reset() {
  stamps_ = StampCheck(restart_after_);
  buffer_ = OdometryBuffer(options_.odometry_hold, kOdometryMemory);
  last_pose_.reset();
}

}  // namespace datmo
