// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/visibility/scan_history.h"
#include "datmo_fusion/visibility/seen_points.h"

namespace datmo {

struct MotionLikelihoodOptions {
  double window = 2.0;                 ///< s
  double detection = 0.8;              ///< 1
  double detection_strength = 4.0;     ///< 1
  double echo_detection = 0.6;         ///< 1
  double background = 0.05;            ///< 1
  double grazing_share = 0.1;          ///< 1
  double free_path = 1.75;             ///< m
  double apparent_motion = 0.1;        ///< 1
  double apparent_box_motion = 0.005;  ///< 1
  double wrong_velocity = 0.02;        ///< 1
  double moving_prior = 0.5;           ///< 1
  double required_probability = 0.95;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// A target as it is thought to move, now, in the fixed frame.
struct MovingBody {
  Box2 box;
  Eigen::Vector2d size_variance = Eigen::Vector2d::Zero();  ///< m^2, of length and width
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();       ///< m/s
  double speed_variance = 0.0;                              ///< (m/s)^2, along any axis
};

/// What the beams of the last scans say of a target.
struct BeamEvidence {
  double log_ratio = 0.0;  ///< that it moves over that it stands, as a surface that faces the beams
  /// That it moves over that it is the end of a beam along a wall.
  double log_ratio_to_grazing = 0.0;
  double grazing_share = 0.0;  ///< of what stands there, the share of such ends; 0: it is none
  std::size_t observed = 0;    ///< informative beams; 0: nothing is known
  bool by_others = false;      ///< no beam ended on it: other sensors see it
};

/// Asks all beams of a window of scans whether something was at the positions where a target was
/// seen, at the times when it was seen elsewhere. What stands was there all the time, hidden or
/// not; what moves left its positions free before it came and after it left, but where its body
/// still covers them.
///
/// One observation is a beam that crossed such a position (ScanHistory::look). If the target moves
/// the beam ends there with the probability c * detection + (1 - c) * background, where c is the
/// probability that the moving body covers the position at that time. If it stands the beam ends
/// there as often as its surface reflects, which is not known: a beta variable of the mean
/// `detection`, integrated over all beams, so that an edge that is hit now and then is no mover.
/// Positions of different scans that one scan looks at are next to each other, so their mean
/// counts; scans are independent.
///
/// Of a single echo the surface's direction is not known. Either it faces the beam; or the echo is
/// the end of one beam that slides along a wall as the vehicle passes, and the surface runs along
/// the target's motion (motionLogRatio). Walls, hedges and parked rows stand beside the vehicle's
/// path, not in it: the nearer to its course an echo is, the less likely is that, as far as the
/// course is known: it is not at rest, nor far ahead in a bend.
///
/// Sources of the idea: Wang, Posner, Newman, Model-free detection
/// and tracking of dynamic objects with 2D lidar, 2015 (one likelihood of all beams); Petrovskaya
/// and Thrun, Model based vehicle detection and tracking for autonomous urban driving, 2009,
/// section 4 (free space before and behind).
///
/// `now`: the time of `body`, `clock` (s) the same on the clock of `seen`.
BeamEvidence beamEvidence(const ScanHistory& history, const SeenPointHistory& seen,
                          const MovingBody& body, Stamp now, double clock,
                          const MotionLikelihoodOptions& options);

/// Logarithm of how much likelier a velocity is for a target that moves than for one that stands.
/// `velocity` (m/s, fixed frame) with `covariance` is that of its filter; the speeds of what moves
/// are normal, each component of one of `speed_stds` (m/s), all of them as likely. What stands has
/// an apparent velocity as if it moved with the probability `apparent_motion`: what is seen of it
/// slides, or echoes of different things were joined. So no velocity alone weighs more than its
/// inverse. Source: the Bayes factor of nested models, with an outlier component (Kass and Raftery,
/// Bayes factors, 1995).
double velocityLogRatio(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                        std::initializer_list<double> speed_stds, double apparent_motion);

/// Logarithm of how much likelier all that was observed is for a target that moves than for one
/// that stands: by its beams and by its velocity. The end of a beam along a wall has an apparent
/// velocity, so that this says nothing then.
double motionLogRatio(const BeamEvidence& beams, double velocity_log_ratio);

/// That a target moves and exists: neither something that stands nor a chain of false alarms.
/// `log_ratio`: logarithm of how much likelier what is known of it is if it moves than if it
/// stands: what the beams say, its velocity, and where it lies. `existence_log_odds`: of one moving
/// object against clutter (ExistenceScore).
double motionProbability(double log_ratio, double existence_log_odds,
                         const MotionLikelihoodOptions& options);

}  // namespace datmo
