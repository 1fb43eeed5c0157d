// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/host_input.h"

#include <cmath>
#include <utility>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// Cannot be the name of a source of tracks.
constexpr char kOdometryStream[] = "/odometry";

}  // namespace

void HostInputOptions::visit(OptionVisitor& visitor) {
  visitor.number({"acceleration_time", "s",
                  "time over which the host's acceleration is computed from its speed: long enough "
                  "for the steps of a wheel encoder"},
                 acceleration_time, {0.05, 5.0});
  visitor.number(
      {"max_age", "s", "maximum time between the tracks' stamp and the newest pose and odometry"},
      max_age, {0.0, 5.0});
}

HostInput::HostInput(const Checked<HostInputOptions>& options, const MotionOptions& motion,
                     FrameOptions frames, StageRunner& runner)
    : options_(*options),
      motion_(motion),
      reader_(motion, std::move(frames), kOdometryStream, runner),
      poses_(motion.change, motion.noise) {}

void HostInput::add(Twists& twists, const StampedTwist& twist) const {
  twists.push_back(twist);
  while (twists.size() > 2 &&
         secondsBetween(twists.front().stamp, twist.stamp) > options_.acceleration_time) {
    twists.pop_front();
  }
}

void HostInput::take(const nav_msgs::Odometry& message) {
  const OdometrySample sample = reader_.read(message);
  if (sample.twist_measured) {
    add(odometry_, {sample.stamp, sample.twist});
  }
}

void HostInput::take(const LabeledScan& scan) {
  if (last_pose_ && scan.stamp <= last_pose_->stamp) {
    return;
  }
  const std::optional<PoseStep> step = poses_.add(scan.stamp, scan.base_in_map);
  if (step && !step->jumped) {
    add(from_poses_, {scan.stamp, step->twist});
  }
  last_pose_ = {scan.stamp, scan.base_in_map.pose};
}

bool HostInput::serves(const Twists& twists, Stamp stamp) const {
  return !twists.empty() &&
         std::abs(secondsBetween(twists.back().stamp, stamp)) <= options_.max_age;
}

bool HostInput::hasOdometry(Stamp stamp) const {
  return motion_.hasSpeed() && serves(odometry_, stamp);
}

HostState HostInput::at(Stamp stamp, const HostVehicleOptions& vehicle) const {
  if (!last_pose_ || std::abs(secondsBetween(last_pose_->stamp, stamp)) > options_.max_age) {
    throw InputError("no_pose", "no labeled scan within " + std::to_string(options_.max_age) +
                                    " s of the tracks: expected labeled_scan of grid_slam");
  }
  const Twists& twists = hasOdometry(stamp) ? odometry_ : from_poses_;
  if (!serves(twists, stamp)) {
    throw InputError("no_motion", "no odometry and no second pose within " +
                                      std::to_string(options_.max_age) +
                                      " s of the tracks: expected the host's speed");
  }
  const Twist2& twist = twists.back().twist;
  HostState host;
  host.pose = last_pose_->pose * arc(twist, secondsBetween(last_pose_->stamp, stamp));
  host.speed = twist.forward_speed;
  host.steering = steeringOf(twist.forward_speed, twist.yaw_rate, vehicle);
  const double seconds = secondsBetween(twists.front().stamp, twists.back().stamp);
  if (seconds >= 0.5 * options_.acceleration_time) {
    host.acceleration = (twist.forward_speed - twists.front().twist.forward_speed) / seconds;
  }
  return host;
}

void HostInput::reset() {
  reader_.reset();
  odometry_.clear();
  from_poses_.clear();
  poses_.reset();
  last_pose_.reset();
}

}  // namespace datmo
