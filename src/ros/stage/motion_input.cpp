// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/motion_input.h"

#include <string>
#include <utility>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// No source of a stage that fuses several can have this name.
constexpr char kMotionStream[] = "/motion";

}  // namespace

void checkFrames(const nav_msgs::Odometry& message, const FrameOptions& frames) {
  const std::string& odom = message.header.frame_id;
  const std::string& base = message.child_frame_id;
  if (odom == frames.odom && base == frames.base) {
    return;
  }
  const bool named = !odom.empty() && !base.empty() && odom != base;
  const std::string remedy =
      named ? "; if these are its names, give them in the yaml file: frames: {odom: " + odom +
                  ", base: " + base + "}"
            : "";
  throw InputError("wrong_frame", "odometry of '" + base + "' in '" + odom + "': expected '" +
                                      frames.base + "' in '" + frames.odom + "'" + remedy);
}

OdometrySample readOdometry(const nav_msgs::Odometry& message, const MotionOptions& options,
                            StageMonitor& monitor) {
  if (!options.fromOdometry() || !options.odometry_pose) {
    return toSample(message);
  }
  OdometrySample sample;
  sample.stamp = toStamp(message.header.stamp);
  sample.base_in_odom = fromMessage(message.pose.pose);
  try {
    sample.twist = toSample(message).twist;
  } catch (const InputError& error) {
    sample.twist_measured = false;
    monitor.warned(InputError("bad_twist", std::string(error.what()) + "; its pose serves"));
  }
  return sample;
}

MotionInput::MotionInput(const Checked<MotionOptions>& options, FrameOptions frames,
                         StageRunner& runner)
    : options_(*options),
      frames_(std::move(frames)),
      runner_(runner),
      buffer_(options->hold, kOdometryMemory) {}

void MotionInput::take(const nav_msgs::Odometry& message) {
  if (!options_.hasSpeed()) {
    return;
  }
  checkFrames(message, frames_);
  const OdometrySample sample = readOdometry(message, options_, runner_.monitor());
  runner_.check(kMotionStream, message.header.stamp);
  buffer_.add(sample);
}

void MotionInput::take(const geometry_msgs::PoseWithCovarianceStamped& message) {
  if (options_.hasSpeed()) {
    return;
  }
  const Pose2 pose = fromMessage(message.pose.pose);
  runner_.check(kMotionStream, message.header.stamp);
  const std::optional<StampedPose> before = last_pose_;
  last_pose_ = {toStamp(message.header.stamp), pose};
  if (!before) {
    return;
  }
  const double seconds = secondsBetween(before->stamp, last_pose_->stamp);
  const Pose2 motion = before->pose.inverse() * pose;
  const Twist2 twist = twistOf(motion, seconds);
  // The twist knows nothing of a jump sideways.
  const double speed = motion.position().norm() / seconds;
  if (!isPlausible({speed, twist.yaw_rate})) {
    throw InputError("pose_jump", "pose that moved at " + std::to_string(speed) + " m/s and " +
                                      std::to_string(twist.yaw_rate) + " rad/s: expected at most " +
                                      std::to_string(kMaxSpeed) + " m/s and " +
                                      std::to_string(kMaxYawRate) + " rad/s");
  }
  // What the vehicle did up to this pose is what it is expected to do after it.
  buffer_.add({last_pose_->stamp, twist, pose});
}

void MotionInput::reset() {
  buffer_ = OdometryBuffer(options_.hold, kOdometryMemory);
  last_pose_.reset();
}

}  // namespace datmo
