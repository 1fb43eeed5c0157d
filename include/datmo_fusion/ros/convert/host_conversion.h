// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/risk/host_motion.h"

namespace datmo {

/// How the joints of the front wheels are read.
struct SteeringFormat {
  std::string joint;   ///< only joints with this in their name; empty: all
  double sigma = 0.0;  ///< rad, standard deviation of the angle
  double max = 0.0;    ///< rad, angle of the front wheels at full lock
};

/// Returns the steering angle of the bicycle model, rad, positive to the left: the mean of the
/// joints' positions. Throws InputError: `no_steering` if no joint of that name has a position,
/// `bad_steering` if one is not finite, or their mean is beyond `max` by more than its noise.
Estimate steeringFrom(const sensor_msgs::JointState& message, const SteeringFormat& format);

/// How a longitudinal acceleration is read.
struct AccelerationFormat {
  std::string frame;   ///< of the vehicle
  double sigma = 0.0;  ///< m/s^2, standard deviation of a message without covariance
  double max = 0.0;    ///< m/s^2, what the vehicle can reach
};

/// Returns the acceleration over ground along the vehicle's heading, m/s^2. An empty frame_id is
/// assumed to be the vehicle's. None if its standard deviation exceeds `max`: drivers write a large
/// variance for what they do not measure. Throws InputError: `wrong_frame` in another frame,
/// `bad_acceleration` if it is not finite, beyond `max` by more than its noise, or its variance is
/// invalid.
std::optional<Estimate> accelerationFrom(const geometry_msgs::AccelWithCovarianceStamped& message,
                                         const AccelerationFormat& format);

/// Returns the steering angle of a bicycle (rad) as that of its one front wheel.
sensor_msgs::JointStatePtr toSteering(double angle, Stamp stamp);

/// Returns the acceleration along the vehicle's heading (m/s^2). `variance`: (m/s^2)^2, 0: unknown.
/// The frame is empty, meaning the vehicle's.
geometry_msgs::AccelWithCovarianceStampedPtr toAcceleration(const Estimate& along, Stamp stamp);

}  // namespace datmo
