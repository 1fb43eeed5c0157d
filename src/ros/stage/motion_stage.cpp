// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/motion_stage.h"

#include <cmath>
#include <numeric>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/frames.h"

namespace datmo {

namespace {

/// (m/s)^2: variance of an unknown speed.
constexpr double kUnknownSpeedVariance = kMaxSpeed * kMaxSpeed;

/// In sensor_msgs/Imu, the first covariance element of a quantity that is not measured.
constexpr double kNotMeasured = -1.0;

Twist2 checked(const Twist2& twist, const std::string& what) {
  if (!isPlausible(twist)) {
    throw InputError("bad_motion", what + " with speed " + std::to_string(twist.forward_speed) +
                                       " m/s and yaw rate " + std::to_string(twist.yaw_rate) +
                                       " rad/s: expected at most " + std::to_string(kMaxSpeed) +
                                       " m/s and " + std::to_string(kMaxYawRate) + " rad/s");
  }
  return twist;
}

}  // namespace

MotionStage::MotionStage(const MotionStageOptions& options, const TransformBuffer& transforms,
                         StageMonitor& monitor)
    : options_(options),
      transforms_(transforms),
      runner_(monitor, options.input, "forgets the vehicle's motion", [this] { reset(); }) {
  checkOptions(options.motion);
  checkFrames(options.frames);
}

nav_msgs::OdometryPtr MotionStage::handleImu(const sensor_msgs::Imu& message) {
  return runner_.serve([&]() -> nav_msgs::OdometryPtr {
    if (message.angular_velocity_covariance[0] == kNotMeasured) {
      throw InputError("no_angular_velocity",
                       "Imu whose angular_velocity_covariance says that it measures no angular "
                       "velocity: expected one with gyroscopes");
    }
    const Eigen::Vector3d turn = inBase(message.header.frame_id, message.angular_velocity);
    const Twist2 turning = checked({0.0, turn.z()}, "Imu");
    runner_.check("imu", message.header.stamp);
    return odometryOf(message.header.stamp,
                      {speedAt(toStamp(message.header.stamp)), turning.yaw_rate});
  });
}

nav_msgs::OdometryPtr MotionStage::handleTwist(const geometry_msgs::TwistStamped& message) {
  return handleTwist(message.header, message.twist);
}

nav_msgs::OdometryPtr MotionStage::handleTwist(
    const geometry_msgs::TwistWithCovarianceStamped& message) {
  return handleTwist(message.header, message.twist.twist);
}

nav_msgs::OdometryPtr MotionStage::handleTwist(const std_msgs::Header& header,
                                               const geometry_msgs::Twist& message) {
  return runner_.serve([&]() -> nav_msgs::OdometryPtr {
    const bool uses_imu = options_.motion.usesImu();  // if so, the yaw rate is the IMU's
    const double yaw_rate = uses_imu ? 0.0 : inBase(header.frame_id, message.angular).z();
    const Twist2 twist = checked({inBase(header.frame_id, message.linear).x(), yaw_rate}, "twist");
    runner_.check("twist", header.stamp);
    return uses_imu ? keepSpeed(toStamp(header.stamp), twist.forward_speed)
                    : odometryOf(header.stamp, twist);
  });
}

nav_msgs::OdometryPtr MotionStage::handleWheels(const sensor_msgs::JointState& message) {
  return runner_.serve([&]() -> nav_msgs::OdometryPtr {
    const auto& rates = message.velocity;
    if (rates.empty()) {
      throw InputError("no_wheel_speed",
                       "JointState without velocity: expected the velocity of each wheel in rad/s");
    }
    const double mean =
        std::accumulate(rates.begin(), rates.end(), 0.0) / static_cast<double>(rates.size());
    const Twist2 twist = checked({options_.motion.wheel_radius * mean, 0.0}, "wheels");
    runner_.check("wheels", message.header.stamp);
    return keepSpeed(toStamp(message.header.stamp), twist.forward_speed);
  });
}

nav_msgs::OdometryPtr MotionStage::keepSpeed(Stamp stamp, double speed) {
  speed_ = {stamp, speed};
  return nullptr;
}

double MotionStage::speedAt(Stamp stamp) const {
  if (!options_.motion.hasSpeed()) {
    return 0.0;
  }
  if (!speed_ || std::abs(secondsBetween(speed_->stamp, stamp)) > options_.motion.hold) {
    throw InputError("no_speed", "Imu without a speed within " +
                                     std::to_string(options_.motion.hold) +
                                     " s of its stamp: expected that of the " +
                                     (options_.motion.usesWheels() ? "wheels" : "twist"));
  }
  return speed_->speed;
}

Eigen::Vector3d MotionStage::inBase(const std::string& frame,
                                    const geometry_msgs::Vector3& vector) const {
  const Eigen::Vector3d in_sensor(vector.x, vector.y, vector.z);
  const std::string& base = options_.frames.base;
  if (frame.empty() || frame == base) {
    return in_sensor;
  }
  if (frame == options_.frames.odom || frame == options_.frames.map) {
    throw InputError("wrong_frame", "motion in '" + frame + "': expected it in '" + base +
                                        "' or a frame fixed to it");
  }
  return sensorMount(transforms_.core(), base, frame).linear() * in_sensor;
}

void MotionStage::reset() {
  speed_.reset();
  last_.reset();
  base_in_odom_ = Pose2();
}

nav_msgs::OdometryPtr MotionStage::odometryOf(const ros::Time& stamp, const Twist2& twist) {
  const Stamp now = toStamp(stamp);
  if (last_) {
    base_in_odom_ = base_in_odom_ * arc(last_twist_, secondsBetween(*last_, now));
  }
  last_ = now;
  last_twist_ = twist;
  const auto odometry = boost::make_shared<nav_msgs::Odometry>();
  odometry->header.stamp = stamp;
  odometry->header.frame_id = options_.frames.odom;
  odometry->child_frame_id = options_.frames.base;
  odometry->pose.pose = toMessage(base_in_odom_);
  odometry->twist.twist.linear.x = twist.forward_speed;
  odometry->twist.twist.angular.z = twist.yaw_rate;
  odometry->twist.covariance[0] = options_.motion.hasSpeed() ? 0.0 : kUnknownSpeedVariance;
  runner_.processed(now);
  return odometry;
}

void MotionStage::connect(StagePorts& ports) {
  const MotionOptions& motion = options_.motion;
  if (!motion.fromSensors()) {
    return;
  }
  const auto odometry = ports.out<nav_msgs::Odometry>(motion.odometryTopic());
  if (motion.usesImu()) {
    const auto callback = [this, odometry](const auto& imu, Stamp /*now*/) {
      odometry.publish(handleImu(*imu));
    };
    ports.in<sensor_msgs::Imu>(
        "imu", withClockCheck<sensor_msgs::Imu>(ports, "imu", runner_.monitor(), callback));
  }
  if (motion.usesTwist()) {
    using Twist = geometry_msgs::TwistStamped;
    using Covariant = geometry_msgs::TwistWithCovarianceStamped;
    const auto callback = [this, odometry](const auto& twist, Stamp /*now*/) {
      odometry.publish(handleTwist(*twist));
    };
    ports.in<Twist>("twist", withClockCheck<Twist>(ports, "twist", runner_.monitor(), callback));
    ports.inInsteadOf<Covariant>(
        "twist", "twist_with_covariance",
        withClockCheck<Covariant>(ports, "twist", runner_.monitor(), callback));
  }
  if (motion.usesWheels()) {
    const auto callback = [this, odometry](const auto& wheels, Stamp /*now*/) {
      odometry.publish(handleWheels(*wheels));
    };
    ports.in<sensor_msgs::JointState>(
        "joint_states", withClockCheck<sensor_msgs::JointState>(ports, "joint_states",
                                                                runner_.monitor(), callback));
  }
}

}  // namespace datmo
