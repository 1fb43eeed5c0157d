// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/host_conversion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <boost/make_shared.hpp>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Standard deviations by which a measurement may exceed a limit of the vehicle.
constexpr double kSigmas = 3.0;

/// False for NaN.
bool isReachable(double value, double max, double sigma) {
  return std::abs(value) <= max + kSigmas * sigma;
}

}  // namespace

Estimate steeringFrom(const sensor_msgs::JointState& message, const SteeringFormat& format) {
  const std::size_t joints = format.joint.empty()
                                 ? message.position.size()
                                 : std::min(message.name.size(), message.position.size());
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < joints; ++i) {
    if (!format.joint.empty() && message.name[i].find(format.joint) == std::string::npos) {
      continue;
    }
    sum += message.position[i];
    ++count;
  }
  if (count == 0) {
    throw InputError(
        "no_steering",
        "JointState without a position of " +
            (format.joint.empty() ? std::string("any joint")
                                  : "a joint with '" + format.joint + "' in its name") +
            ": expected the angles of the front wheels (host_state/steering_joint)");
  }
  // Of a car's front wheels, the inner one turns farther than that of the bicycle, the outer one
  // less: only their mean has its limit. It is not finite if one of them is not.
  const double angle = sum / static_cast<double>(count);
  if (!isReachable(angle, format.max, format.sigma)) {
    throw InputError("bad_steering",
                     "steering angle of " + std::to_string(angle) + " rad: expected at most " +
                         std::to_string(format.max) +
                         " rad (vehicle/max_steering), the mean angle of the front wheels, not of "
                         "the steering wheel");
  }
  return {angle, square(format.sigma)};
}

std::optional<Estimate> accelerationFrom(const geometry_msgs::AccelWithCovarianceStamped& message,
                                         const AccelerationFormat& format) {
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != format.frame) {
    throw InputError("wrong_frame", "acceleration in '" + frame + "': expected it in '" +
                                        format.frame + "', without gravity");
  }
  const double along = message.accel.accel.linear.x;
  const double given = message.accel.covariance[0];
  const double variance = given == 0.0 ? square(format.sigma) : given;
  const double sigma = std::sqrt(std::max(variance, 0.0));
  if (!(variance > 0.0) || !std::isfinite(variance) ||
      !isReachable(along, format.max, std::min(sigma, format.max))) {
    throw InputError("bad_acceleration",
                     "acceleration of " + std::to_string(along) + " m/s^2 with variance " +
                         std::to_string(given) + ": expected at most " +
                         std::to_string(format.max) +
                         " m/s^2 (motion/max_acceleration), and a variance that is positive, or 0 "
                         "if unknown");
  }
  return sigma <= format.max ? std::make_optional(Estimate{along, variance}) : std::nullopt;
}

sensor_msgs::JointStatePtr toSteering(double angle, Stamp stamp) {
  auto message = boost::make_shared<sensor_msgs::JointState>();
  message->header.stamp = toTime(stamp);
  message->name = {"front_wheels"};
  message->position = {angle};
  return message;
}

geometry_msgs::AccelWithCovarianceStampedPtr toAcceleration(const Estimate& along, Stamp stamp) {
  auto message = boost::make_shared<geometry_msgs::AccelWithCovarianceStamped>();
  message->header.stamp = toTime(stamp);
  message->accel.accel.linear.x = along.value;
  message->accel.covariance[0] = along.variance;
  return message;
}

}  // namespace datmo
