// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/risk/box_contact.h"

namespace datmo {

/// The host vehicle: its outline about base_link (below the rear axle), and its limits.
struct HostVehicleOptions {
  double length = 4.6;             ///< m
  double width = 1.85;             ///< m
  double rear_overhang = 0.9;      ///< m
  double wheelbase = 2.7;          ///< m
  double max_steering = 0.6;       ///< rad
  double max_steering_rate = 0.6;  ///< rad/s
  double max_braking = 6.0;        ///< m/s^2
  double max_lateral = 5.0;        ///< m/s^2

  void visit(OptionVisitor& visitor);

  BodySize size() const { return {0.5 * length, 0.5 * width}; }
  /// Distance from base_link forward to the center of the outline, m.
  double middleAhead() const { return 0.5 * length - rear_overhang; }
};

/// State of the host at one time: base_link in the fixed frame.
struct HostState {
  Pose2 pose;
  double speed = 0.0;                        ///< m/s, forward; negative: it reverses
  double steering = 0.0;                     ///< rad, of the front wheels, positive to the left
  double acceleration = 0.0;                 ///< m/s^2, along the heading
  std::optional<double> acceleration_sigma;  ///< m/s^2, of a measured one; none: it is not measured
};

/// Returns the steering angle (rad, within the vehicle's limits) that gives this yaw rate (rad/s).
/// 0 for a vehicle that hardly moves: it cannot be observed.
double steeringOf(double speed, double yaw_rate, const HostVehicleOptions& vehicle);

/// Returns the variance of that angle, rad^2; infinite for a vehicle that hardly moves.
/// `covariance`: of speed (m/s) and yaw rate (rad/s); only its diagonal is used.
double steeringVariance(const Twist2& twist, const Eigen::Matrix2d& covariance,
                        const HostVehicleOptions& vehicle);

/// An estimate of one quantity.
struct Estimate {
  double value = 0.0;
  double variance = 0.0;  ///< at least 0; infinite: nothing is known
};

/// Returns the mean of two independent estimates of one quantity, weighted by the inverse of their
/// variances. That of `b` must be finite and more than 0.
double combined(const Estimate& a, const Estimate& b);

/// Inputs of the bicycle model, both constant over a step.
struct HostCommand {
  double acceleration = 0.0;   ///< m/s^2
  double steering_rate = 0.0;  ///< rad/s
};

/// State of the bicycle model.
struct BicycleState {
  BodyPose rear_axle;
  double speed = 0.0;     ///< m/s
  double steering = 0.0;  ///< rad
};

BicycleState bicycleState(const HostState& host);

/// Returns the state after `seconds` (at least 0) of the kinematic bicycle model (Rajamani, Vehicle
/// Dynamics and Control, 2012, 2.2; rear axle), integrated by the 4th-order Runge-Kutta method with
/// acceleration and steering rate as inputs (thesis 5.3.5). A braking vehicle comes to rest and
/// does not reverse, nor vice versa, and a stationary one remains stationary; the steering stays
/// within its limits, and if the tires would slide (max_lateral) the path is as wide as their grip
/// requires.
BicycleState afterStep(const BicycleState& state, const HostCommand& command, double seconds,
                       const HostVehicleOptions& vehicle);

/// Returns the pose of the outline.
BodyPose outlineOf(const BicycleState& state, const HostVehicleOptions& vehicle);

/// Poses of a body at equal time steps.
struct BodyPath {
  double step = 0.0;            ///< s, more than 0
  std::vector<BodyPose> poses;  ///< the first at time 0; at least one

  /// Returns the velocity over the step that begins at an index, m/s; 0 beyond the last.
  Point2 velocity(std::size_t index) const;
  double duration() const { return step * static_cast<double>(poses.size() - 1); }
};

/// Returns the first time at which two bodies on paths with equal steps touch, s; none if they do
/// not.
std::optional<double> firstContact(const BodyPath& a, const BodySize& size_a, const BodyPath& b,
                                   const BodySize& size_b);

}  // namespace datmo
