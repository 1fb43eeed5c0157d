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

/// The assumed motion of a target, now, in the fixed frame.
struct MovingBody {
  Box2 box;
  Eigen::Vector2d size_variance = Eigen::Vector2d::Zero();  ///< m^2, of length and width
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();       ///< m/s
  double speed_variance = 0.0;                              ///< (m/s)^2, along any axis
};

/// Evidence of the beams of recent scans about a target.
struct BeamEvidence {
  double log_ratio = 0.0;  ///< moving versus standing, as a surface that faces the beams
  /// Moving versus being the end of a beam along a wall.
  double log_ratio_to_grazing = 0.0;
  double grazing_share = 0.0;  ///< share of such ends among standing objects; 0: it is none
  std::size_t observed = 0;    ///< informative beams; 0: no evidence
  bool by_others = false;      ///< no beam ended on it: other sensors detect it
};

/// Evaluates all beams of a window of scans at the positions where a target was seen, for the times
/// when it was elsewhere. A standing object was there all the time, occluded or not; a moving one
/// left its positions free before it arrived and after it left, except where its body still covers
/// them.
///
/// One observation is a beam that crossed such a position (ScanHistory::look). If the target moves,
/// the beam ends there with the probability c * detection + (1 - c) * background, where c is the
/// probability that the moving body covers the position at that time. If it stands, the beam ends
/// there as often as its surface reflects, which is unknown: a beta variable of the mean
/// `detection`, integrated over all beams, so that an edge that is hit occasionally does not look
/// like a mover. Positions of different scans that one scan observes are adjacent, so their mean
/// counts; scans are independent.
///
/// For a single echo, the surface's direction is unknown. Either it faces the beam; or the echo is
/// the end of one beam that slides along a wall as the vehicle passes, and the surface runs along
/// the target's motion (motionLogRatio). Walls, hedges and parked rows are beside the vehicle's
/// path, not in it: the closer an echo is to the path, the less likely this is, as far as the path
/// is known: not at rest, nor far ahead in a curve.
///
/// Based on: Wang, Posner, Newman, Model-free detection and tracking of dynamic objects with 2D
/// lidar, 2015 (one likelihood of all beams); Petrovskaya and Thrun, Model based vehicle detection
/// and tracking for autonomous urban driving, 2009, section 4 (free space before and behind).
///
/// `now`: the time of `body`; `clock` (s): the same on the clock of `seen`.
BeamEvidence beamEvidence(const ScanHistory& history, const SeenPointHistory& seen,
                          const MovingBody& body, Stamp now, double clock,
                          const MotionLikelihoodOptions& options);

/// Returns the log-likelihood ratio of a velocity for a moving versus a standing target. `velocity`
/// (m/s, fixed frame) with `covariance` is from its filter. Moving targets have a normal velocity,
/// with equal probability of each of `speed_stds` (m/s, per component). With the probability
/// `apparent_motion`, a standing target has an apparent velocity as if it moved: its visible part
/// slides, or echoes of different objects were associated. So the ratio never exceeds the inverse
/// of that. Source: the Bayes factor of nested models, with an outlier component (Kass and Raftery,
/// Bayes factors, 1995).
double velocityLogRatio(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                        std::initializer_list<double> speed_stds, double apparent_motion);

/// Returns the log-likelihood ratio of all observations for a moving versus a standing target: by
/// beams and velocity. For the end of a beam along a wall the velocity is only apparent, so it does
/// not count.
double motionLogRatio(const BeamEvidence& beams, double velocity_log_ratio);

/// Returns the probability that a target moves and exists: neither a standing object nor a chain of
/// false alarms. `log_ratio`: log-likelihood ratio of moving versus standing, from beams, velocity
/// and position. `existence_log_odds`: of one moving object versus clutter (ExistenceScore).
double motionProbability(double log_ratio, double existence_log_odds,
                         const MotionLikelihoodOptions& options);

}  // namespace datmo
