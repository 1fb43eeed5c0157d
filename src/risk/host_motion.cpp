// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/host_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/common/turned.h"

namespace datmo {

namespace {

/// m/s; below this, a yaw rate does not determine the steering.
constexpr double kRolling = 0.5;

/// Time derivative of a state.
struct Rates {
  Point2 position;
  double heading;
};

/// Returns the curvature of the rear axle's path, 1/m.
double curvatureOf(double speed, double steering, const HostVehicleOptions& vehicle) {
  const double curvature = std::tan(steering) / vehicle.wheelbase;
  const double limit = vehicle.max_lateral / std::max(speed * speed, kRolling * kRolling);
  return std::clamp(curvature, -limit, limit);
}

/// `direction`: of length 1.
Rates ratesOf(const Point2& direction, double speed, double curvature) {
  return {speed * direction, speed * curvature};
}

/// Returns the speed after an acceleration that does not reverse the direction of travel: a
/// stationary vehicle remains stationary.
double speedAfter(double speed, double acceleration, double seconds) {
  const double after = speed + acceleration * seconds;
  return speed * after <= 0.0 ? 0.0 : after;
}

}  // namespace

void HostVehicleOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "length of the vehicle, bumper to bumper", Tier::kPublic}, length,
                 {0.1, 30.0});
  visitor.number({"width", "m", "width of the vehicle without mirrors", Tier::kPublic}, width,
                 {0.1, 5.0});
  visitor.number(
      {"rear_overhang", "m", "from the rear bumper to the rear axle (base_link)", Tier::kPublic},
      rear_overhang, {0.0, 10.0});
  visitor.number(
      {"wheelbase", "m", "distance between the axles, for the bicycle model (thesis 5.3.5)",
       Tier::kPublic},
      wheelbase, {0.1, 15.0});
  visitor.number({"max_steering", "rad", "angle of the front wheels at full lock"}, max_steering,
                 {0.05, 1.5});
  visitor.number({"max_steering_rate", "rad/s",
                  "steering rate of the front wheels; a quick driver turns the steering wheel by "
                  "500 degrees a second, geared down by 15"},
                 max_steering_rate, {0.01, 5.0});
  visitor.number(
      {"max_braking", "m/s^2",
       "deceleration that a driver can reach on a dry road; automatic brakes are tested at 6 to 9"},
      max_braking, {0.5, 12.0});
  visitor.number({"max_lateral", "m/s^2",
                  "lateral acceleration up to which the tires grip and a driver dares to steer"},
                 max_lateral, {0.5, 12.0});
}

double steeringOf(double speed, double yaw_rate, const HostVehicleOptions& vehicle) {
  if (std::abs(speed) < kRolling) {
    return 0.0;
  }
  return std::clamp(std::atan(vehicle.wheelbase * yaw_rate / speed), -vehicle.max_steering,
                    vehicle.max_steering);
}

double steeringVariance(const Twist2& twist, const Eigen::Matrix2d& covariance,
                        const HostVehicleOptions& vehicle) {
  const double speed = twist.forward_speed;
  if (std::abs(speed) < kRolling) {
    return std::numeric_limits<double>::infinity();
  }
  // The tangent of the angle is this slope; its derivatives are slope / speed and wheelbase /
  // speed.
  const double slope = vehicle.wheelbase * twist.yaw_rate / speed;
  const double of_slope =
      (square(slope) * covariance(0, 0) + square(vehicle.wheelbase) * covariance(1, 1)) /
      square(speed);
  return of_slope / square(1.0 + square(slope));
}

double combined(const Estimate& a, const Estimate& b) {
  const double weight = std::isinf(a.variance) ? 1.0 : a.variance / (a.variance + b.variance);
  return a.value + weight * (b.value - a.value);
}

BicycleState bicycleState(const HostState& host) {
  return {bodyPose(host.pose.position(), host.pose.heading()), host.speed, host.steering};
}

BicycleState afterStep(const BicycleState& state, const HostCommand& command, double seconds,
                       const HostVehicleOptions& vehicle) {
  const double half = 0.5 * seconds;
  const auto steering_at = [&](double time) {
    return std::clamp(state.steering + command.steering_rate * time, -vehicle.max_steering,
                      vehicle.max_steering);
  };
  const double speed_mid = speedAfter(state.speed, command.acceleration, half);
  const double speed_end = speedAfter(state.speed, command.acceleration, seconds);
  const double curvature_mid = curvatureOf(speed_mid, steering_at(half), vehicle);
  const double steering_end = steering_at(seconds);
  const BodyPose& from = state.rear_axle;
  const auto direction_after = [&](double turn) { return turned(from.direction, turn); };
  const Rates k1 =
      ratesOf(from.direction, state.speed, curvatureOf(state.speed, state.steering, vehicle));
  const Rates k2 = ratesOf(direction_after(half * k1.heading), speed_mid, curvature_mid);
  const Rates k3 = ratesOf(direction_after(half * k2.heading), speed_mid, curvature_mid);
  const Rates k4 = ratesOf(direction_after(seconds * k3.heading), speed_end,
                           curvatureOf(speed_end, steering_end, vehicle));
  const double sixth = seconds / 6.0;
  return {bodyPose(
              from.center + sixth * (k1.position + 2.0 * (k2.position + k3.position) + k4.position),
              from.heading + sixth * (k1.heading + 2.0 * (k2.heading + k3.heading) + k4.heading)),
          speed_end, steering_end};
}

BodyPose outlineOf(const BicycleState& state, const HostVehicleOptions& vehicle) {
  BodyPose pose = state.rear_axle;
  pose.center += vehicle.middleAhead() * pose.direction;
  return pose;
}

Point2 BodyPath::velocity(std::size_t index) const {
  if (index + 1 >= poses.size()) {
    return Point2::Zero();
  }
  return (poses[index + 1].center - poses[index].center) / step;
}

std::optional<double> firstContact(const BodyPath& a, const BodySize& size_a, const BodyPath& b,
                                   const BodySize& size_b) {
  const std::size_t steps = std::min(a.poses.size(), b.poses.size()) - 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const auto share =
        firstContact({a.poses[i], a.poses[i + 1], size_a}, {b.poses[i], b.poses[i + 1], size_b});
    if (share) {
      return (static_cast<double>(i) + *share) * a.step;
    }
  }
  return std::nullopt;
}

}  // namespace datmo
