// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Prior that drivers and riders follow the direction of the road.
struct RoadFollowingOptions {
  double probability = 0.9;  ///< 1
  double turning = 0.15;     ///< 1
  /// rad, 0.05 to 1: standard deviation of the angle between crossing roads about a right angle
  double crossing_sigma = 0.35;
  /// rad, 0.001 to 1: standard deviation of a course about the road's direction: swaying, and bends
  /// beyond the known part of the road
  double direction_sigma = 0.05;
  double min_speed = 1.0;  ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Direction of the road beside an object, in either direction along it.
struct RoadCourse {
  double direction = 0.0;  ///< rad, fixed frame
  double curvature = 0.0;  ///< 1/m, rate of change of the direction along it
};

/// Initial distribution from which the futures of one object are sampled.
struct ObjectStart {
  TrackState state = TrackState::Zero();               ///< fixed frame
  TrackCovariance root = TrackCovariance::Identity();  ///< Cholesky factor of its covariance
  double heading = 0.0;                                ///< rad, of the box
  double heading_sigma = 0.0;                          ///< rad
};

/// Returns the current state of the track. `max_heading_sigma`: rad.
ObjectStart startOf(const Track& track, double max_heading_sigma);

/// The same object under the hypothesis that it follows the road.
struct RoadFollower {
  ObjectStart start;
  double probability = 0.0;  ///< that it does
  double joining = 0.0;      ///< that it does not yet, but turns into the road
};

/// Returns the angle (rad) by which a course (rad) must turn to lead along the road, in its nearer
/// direction.
double turnIntoRoad(double course, double road);

/// Returns whether an object follows the road, in either direction: drivers and riders do so with a
/// prior probability, unless their velocity leads off the road. Bayes over two hypotheses: along
/// the road, the velocity across it is Gaussian and no mode is a turn; otherwise all directions are
/// equally likely and turns are as frequent as their share of time. In the first one, state and
/// heading are conditioned on it (Kalman). None for a certain pedestrian, or below `min_speed`.
///
/// Drivers that do not follow it cross it, or turn into it or off it. Crossing vehicles move
/// straight at about a right angle to it (`crossing_sigma`), turning ones at any angle; the
/// direction in which the modes turn decides between turning in and turning off.
///
/// `road`: direction of the road beside the object, rad, fixed frame. `turn_share`: 0 to 1, of
/// prior share of turns among the motion modes.
std::optional<RoadFollower> roadFollower(const Track& track, const ObjectStart& start, double road,
                                         double turn_share, const RoadFollowingOptions& options);

}  // namespace datmo
