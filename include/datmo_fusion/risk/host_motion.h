// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/risk/box_contact.h"

namespace datmo {

/// The host vehicle: its outline about base_link (below the rear axle), and what it can do.
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
  /// From base_link ahead to the middle of the outline, m.
  double middleAhead() const { return 0.5 * length - rear_overhang; }
};

/// The host as it is at one time: base_link in the fixed frame.
struct HostState {
  Pose2 pose;
  double speed = 0.0;         ///< m/s, forward; negative: it reverses
  double steering = 0.0;      ///< rad, of the front wheels, positive to the left
  double acceleration = 0.0;  ///< m/s^2, along the heading
};

/// Steering (rad, within the vehicle's) at which it turns as fast as that (rad/s). A vehicle that
/// hardly moves shows none.
double steeringOf(double speed, double yaw_rate, const HostVehicleOptions& vehicle);

/// What moves a bicycle model: both held over a step.
struct HostCommand {
  double acceleration = 0.0;   ///< m/s^2
  double steering_rate = 0.0;  ///< rad/s
};

/// State of the bicycle model.
struct BicycleState {
  Point2 position = Point2::Zero();  ///< m, of the rear axle
  double heading = 0.0;              ///< rad, continuous
  double speed = 0.0;                ///< m/s
  double steering = 0.0;             ///< rad
};

BicycleState bicycleState(const HostState& host);

/// The state after `seconds` (at least 0) of the kinematic bicycle model (Rajamani, Vehicle
/// Dynamics and Control, 2012, 2.2; rear axle), integrated by the 4th-order Runge-Kutta method with
/// acceleration and steering rate as inputs (thesis 5.3.5). Who brakes comes to rest and does not
/// reverse, nor the other way round, and who stands stays; the steering stays within its limits,
/// and where the tires would slide (max_lateral) the path is as wide as they hold it.
BicycleState afterStep(const BicycleState& state, const HostCommand& command, double seconds,
                       const HostVehicleOptions& vehicle);

/// Where the outline is.
BodyPose outlineOf(const BicycleState& state, const HostVehicleOptions& vehicle);

/// Poses of a body and its speeds at equal steps of time.
struct BodyPath {
  double step = 0.0;            ///< s, more than 0
  std::vector<BodyPose> poses;  ///< the first at time 0; one at least

  /// m/s, over the step that begins at an index; 0 beyond the last.
  Point2 velocity(std::size_t index) const;
  double duration() const { return step * static_cast<double>(poses.size() - 1); }
};

/// The first time at which two bodies on paths of equal steps touch, s; none within them.
std::optional<double> firstContact(const BodyPath& a, const BodySize& size_a, const BodyPath& b,
                                   const BodySize& size_b);

}  // namespace datmo
