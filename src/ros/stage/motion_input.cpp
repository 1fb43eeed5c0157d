// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/motion_input.h"

#include <string>
#include <utility>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/slam/motion_compensation.h"

namespace datmo {

namespace {

/// Cannot be the name of a source of a stage that fuses several.
constexpr char kMotionStream[] = "/motion";

/// Throws InputError (`wrong_frame`) unless the odometry has the vehicle's frames.
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

}  // namespace

OdometryReader::OdometryReader(const Checked<MotionOptions>& options, FrameOptions frames,
                               std::string stream, StageRunner& runner)
    : options_(*options),
      frames_(std::move(frames)),
      stream_(std::move(stream)),
      runner_(runner),
      frozen_(options->hold),
      gate_(options->change, options->noise) {}

OdometrySample OdometryReader::sampleOf(const nav_msgs::Odometry& message) const {
  if (!options_.fromOdometry() || !options_.odometry_pose) {
    return toSample(message);
  }
  OdometrySample sample;
  sample.stamp = toStamp(message.header.stamp);
  sample.base_in_odom = fromMessage(message.pose.pose);
  try {
    sample.twist = toSample(message).twist;
  } catch (const InputError& error) {
    sample.twist_measured = false;
    runner_.monitor().warned(
        InputError("bad_twist", std::string(error.what()) + "; uses its pose alone"));
  }
  return sample;
}

OdometrySample OdometryReader::read(const nav_msgs::Odometry& message) {
  checkFrames(message, frames_);
  OdometrySample sample = sampleOf(message);
  runner_.check(stream_, message.header.stamp);
  if (frozen_.update(message)) {
    throw InputError("frozen_odometry",
                     "odometry repeats its last pose and twist bit for bit although it reports "
                     "motion: its driver or the device hangs; drops it until it changes");
  }
  if (!sample.twist_measured || gate_.passes(sample.stamp, sample.twist)) {
    return sample;
  }
  const std::string text = "odometry with speed " + std::to_string(sample.twist.forward_speed) +
                           " m/s and yaw rate " + std::to_string(sample.twist.yaw_rate) +
                           " rad/s: expected what the vehicle can reach from the previous ones "
                           "(motion/max_acceleration, max_yaw_acceleration)";
  if (!sample.base_in_odom) {
    throw InputError("impossible_twist", text + "; drops it until a second one confirms it");
  }
  sample.twist_measured = false;
  runner_.monitor().warned(InputError("bad_twist", text + "; uses its pose alone"));
  return sample;
}

MotionInput::MotionInput(const Checked<MotionOptions>& options, FrameOptions frames,
                         StageRunner& runner)
    : options_(*options),
      runner_(runner),
      odometry_(options, std::move(frames), kMotionStream, runner),
      buffer_(options->hold, kOdometryMemory),
      poses_(options->change, options->noise) {}

void MotionInput::update(const nav_msgs::Odometry& message) {
  if (options_.hasSpeed()) {
    buffer_.add(odometry_.read(message));
  }
}

void MotionInput::update(const geometry_msgs::PoseWithCovarianceStamped& message) {
  if (options_.hasSpeed()) {
    return;
  }
  const PoseWithCovariance pose = fromMessage(message.pose);
  runner_.check(kMotionStream, message.header.stamp);
  const Stamp stamp = toStamp(message.header.stamp);
  const std::optional<PoseStep> step = poses_.add(stamp, pose);
  if (!step) {
    return;
  }
  if (step->jumped) {
    throw InputError(
        "pose_jump",
        "pose that moved at " + std::to_string(step->twist.forward_speed) + " m/s and " +
            std::to_string(step->twist.yaw_rate) +
            " rad/s: expected what the vehicle can do (motion/max_acceleration, "
            "max_yaw_acceleration); a correction of the pose in the map is not motion");
  }
  // The motion up to this pose is the prediction for the time after it.
  buffer_.add({stamp, step->twist, step->traveled});
}

Scan MotionInput::compensated(const Scan& scan) const {
  const double duration = sweepDuration(scan);
  if (duration == 0.0) {
    return scan;
  }
  const auto motion = between(scan.stamp, scan.stamp + duration);
  return motion ? compensateMotion(scan, twistOf(*motion, duration)) : scan;
}

void MotionInput::reset() {
  odometry_.reset();
  buffer_ = OdometryBuffer(options_.hold, kOdometryMemory);
  poses_.reset();
}

}  // namespace datmo
