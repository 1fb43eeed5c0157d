// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/host_input.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// Cannot be the name of a source of tracks.
constexpr char kOdometryStream[] = "/odometry";
constexpr char kSteering[] = "steering";
constexpr char kAcceleration[] = "acceleration";

}  // namespace

void HostInputOptions::visit(OptionVisitor& visitor) {
  visitor.number({"acceleration_time", "s",
                  "time over which the host's acceleration is computed from its speed: long enough "
                  "for the steps of a wheel encoder"},
                 acceleration_time, {0.05, 5.0});
  visitor.number({"max_age", "s",
                  "maximum time between the tracks' stamp and the newest pose, odometry, measured "
                  "steering and "
                  "measured acceleration"},
                 max_age, {0.0, 5.0});
  visitor.text({"steering_joint", "",
                "steering: only joints with this in their name are front wheels; empty: all of the "
                "message"},
               steering_joint, {});
  visitor.number(
      {"steering_sigma", "rad",
       "standard deviation of the measured angle of the front wheels as that of the path "
       "driven: offset and play of the steering, and slip of the tires, 0.002 to 0.005 "
       "rad for each m/s^2 of lateral acceleration (understeer gradient; Rajamani, "
       "Vehicle Dynamics and Control, 2012, 3.3)"},
      steering_sigma, {1e-4, 1.0});
  visitor.number({"acceleration_sigma", "m/s^2",
                  "standard deviation of the measured acceleration if its message has no "
                  "covariance: a road that climbs by 3 % adds as much"},
                 acceleration_sigma, {1e-3, 10.0});
}

HostInput::HostInput(const Checked<HostInputOptions>& options, const MotionOptions& motion,
                     const FrameOptions& frames, const HostVehicleOptions& vehicle,
                     StageRunner& runner)
    : options_(*options),
      motion_(motion),
      vehicle_(vehicle),
      steering_format_{options->steering_joint, options->steering_sigma, vehicle.max_steering},
      acceleration_format_{frames.base, options->acceleration_sigma,
                           motion.change.max_acceleration},
      runner_(runner),
      reader_(motion, frames, kOdometryStream, runner),
      poses_(motion.change, motion.noise) {}

void HostInput::add(Twists& twists, const StampedTwist& twist) const {
  twists.push_back(twist);
  while (twists.size() > 2 &&
         secondsBetween(twists.front().stamp, twist.stamp) > options_.acceleration_time) {
    twists.pop_front();
  }
}

void HostInput::update(const nav_msgs::Odometry& message) {
  const OdometrySample sample = reader_.read(message);
  if (sample.twist_measured) {
    add(odometry_, {sample.stamp, sample.twist, motion_.noise.covariance(sample.twist)});
  }
}

void HostInput::update(const sensor_msgs::JointState& message) {
  const Estimate angle = steeringFrom(message, steering_format_);
  runner_.check(kSteering, message.header.stamp);
  steering_ = {toStamp(message.header.stamp), angle};
}

void HostInput::update(const geometry_msgs::AccelWithCovarianceStamped& message) {
  const std::optional<Estimate> along = accelerationFrom(message, acceleration_format_);
  runner_.check(kAcceleration, message.header.stamp);
  acceleration_.reset();
  if (along) {
    acceleration_ = {toStamp(message.header.stamp), *along};
  } else {
    runner_.monitor().warned(
        {"unknown_acceleration",
         "acceleration with a variance of " + std::to_string(message.accel.covariance[0]) +
             " (m/s^2)^2: expected a standard deviation of at most " +
             std::to_string(acceleration_format_.max) +
             " m/s^2 (motion/max_acceleration); it is derived from the host's motion"});
  }
}

void HostInput::update(const LabeledScan& scan) {
  if (last_pose_ && scan.stamp <= last_pose_->stamp) {
    return;
  }
  const std::optional<PoseStep> step = poses_.add(scan.stamp, scan.base_in_map);
  if (step && !step->jumped) {
    add(from_poses_, {scan.stamp, step->twist, step->sigma.cwiseAbs2().asDiagonal()});
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

std::optional<Estimate> HostInput::near(const std::optional<StampedEstimate>& measured, Stamp stamp,
                                        const std::string& name) const {
  if (!measured) {
    return std::nullopt;
  }
  if (std::abs(secondsBetween(measured->stamp, stamp)) > options_.max_age) {
    runner_.monitor().warned(
        {"old_" + name, "no " + name + " within " + std::to_string(options_.max_age) +
                            " s of the tracks: it is derived from the host's motion"});
    return std::nullopt;
  }
  runner_.monitor().announce(name, "uses the host's measured " + name);
  return measured->estimate;
}

HostState HostInput::at(Stamp stamp) const {
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
  host.steering = steeringOf(twist.forward_speed, twist.yaw_rate, vehicle_);
  if (const auto steering = near(steering_, stamp, kSteering)) {
    const double variance = steeringVariance(twist, twists.back().covariance, vehicle_);
    host.steering = std::clamp(combined({host.steering, variance}, *steering),
                               -vehicle_.max_steering, vehicle_.max_steering);
  }
  const double seconds = secondsBetween(twists.front().stamp, twists.back().stamp);
  if (const auto acceleration = near(acceleration_, stamp, kAcceleration)) {
    host.acceleration = acceleration->value;
    host.acceleration_sigma = std::sqrt(acceleration->variance);
  } else if (seconds >= 0.5 * options_.acceleration_time) {
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
  steering_.reset();
  acceleration_.reset();
}

}  // namespace datmo
