// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Who drives or rides keeps to the direction of the road, more often than not.
struct RoadFollowingOptions {
  double probability = 0.9;       ///< 1
  double turning = 0.15;          ///< 1
  double crossing_sigma = 0.35;   ///< rad
  double direction_sigma = 0.05;  ///< rad
  double min_speed = 1.0;         ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Direction of the road beside an object, either way along it.
struct RoadCourse {
  double direction = 0.0;  ///< rad, fixed frame
  double curvature = 0.0;  ///< 1/m, by which the direction rises along it
};

/// What the futures of one object are drawn from.
struct ObjectStart {
  TrackState state = TrackState::Zero();               ///< fixed frame
  TrackCovariance root = TrackCovariance::Identity();  ///< Cholesky factor of its covariance
  double heading = 0.0;                                ///< rad, of the box
  double heading_sigma = 0.0;                          ///< rad
};

/// The track as it is. `max_heading_sigma`: rad.
ObjectStart startOf(const Track& track, double max_heading_sigma);

/// The same object, if it follows the road.
struct RoadFollower {
  ObjectStart start;
  double probability = 0.0;  ///< that it does
  double joining = 0.0;      ///< that it does not yet, and turns into the road
};

/// By how much a course (rad) must turn to lead along the road, the nearer way, rad.
double turnIntoRoad(double course, double road);

/// Whether an object follows the road, either way: who drives or rides does so by a prior, and
/// whose velocity leads off the road does not. Bayes over two hypotheses: along the road the
/// velocity across it is a Gaussian and no mode is a turn, else all directions are alike and turns
/// are as frequent as by their share of time; in the first one state and heading are conditioned on
/// it (Kalman). None for what is a pedestrian for sure, or is slower than `min_speed`.
///
/// Who drives and does not follow it crosses it, or turns into it or off it. Who crosses goes
/// straight on about a right angle to it (`crossing_sigma`), who turns does so at any angle; which
/// way the modes turn decides between the two that turn.
///
/// `road`: direction of the road beside the object, rad, fixed frame. `turn_share`: 0 to 1, of
/// turns among the motion modes of an object of which nothing is known.
std::optional<RoadFollower> roadFollower(const Track& track, const ObjectStart& start, double road,
                                         double turn_share, const RoadFollowingOptions& options);

}  // namespace datmo
