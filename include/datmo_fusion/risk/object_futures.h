// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/risk/object_start.h"
#include "datmo_fusion/risk/random_draws.h"
#include "datmo_fusion/tracking/class_motion.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/transition_model.h"

namespace datmo {

/// How far and how finely futures are looked at.
struct HorizonOptions {
  double horizon = 4.0;  ///< s
  double step = 0.2;     ///< s
  int futures = 256;
  int seed = 1;

  void visit(OptionVisitor& visitor);

  std::size_t steps() const;
};

struct ObjectFutureOptions {
  double vehicle_turning = 0.03;     ///< rad/sqrt(s)
  double cyclist_turning = 0.08;     ///< rad/sqrt(s)
  double pedestrian_turning = 0.25;  ///< rad/sqrt(s)
  double turning_time = 2.0;         ///< s
  double start_acceleration = 1.5;   ///< m/s^2
  double stop_deceleration = 3.0;    ///< m/s^2
  double max_acceleration = 8.0;     ///< m/s^2
  double max_lateral = 4.0;          ///< m/s^2
  RoadFollowingOptions road_following;
  ClassMotionOptions motion;      ///< the tracker's
  TransitionOptions transitions;  ///< the tracker's sojourn times

  void visit(OptionVisitor& visitor);
};

/// The most likely class of an object: the first of equally likely ones.
ObjectClass likeliestClass(const Track& track);
MotionMode likeliestMode(const Track& track);

/// Possible futures of one tracked object.
///
/// Each is drawn from the track's state and covariance and from its mode probabilities; the modes
/// switch by their sojourn times (Markov jumps, as the tracker's IMM has them). In a mode the
/// object goes as that mode says, with the tracker's noise on its speed, and turns at random as its
/// class does: pedestrians freely, who drives or rides about his course, to which he comes back.
/// Who drives or rides may follow the road (RoadFollowingOptions): then he bends with it, and does
/// not turn off it; or he may turn into it, and follows it once his course leads along it.
/// Beyond the tracker's models an object that brakes comes to rest and does not reverse, one that
/// comes to stand brakes until it does, and no turn is sharper than tires hold.
class ObjectFutures {
 public:
  /// `track`: valid (isValid), at the time at which the futures begin. `road`: beside it;
  /// none: not known. All must outlive this.
  ObjectFutures(const Track& track, const std::optional<RoadCourse>& road,
                const ObjectFutureOptions& options, const HorizonOptions& horizon,
                const RandomDraws& draws);

  /// One object at one time of one future.
  struct State {
    Point2 position = Point2::Zero();  ///< m
    Point2 course = Point2::UnitX();   ///< of length 1, along the velocity
    double speed = 0.0;                ///< m/s, at least 0
    double heading = 0.0;              ///< rad, of the box
    double acceleration = 0.0;         ///< m/s^2, along the course
    double sway = 0.0;                 ///< rad, of the course from where the mode leads
    MotionMode mode = MotionMode::kConstantVelocity;
    bool follows_road = false;  ///< it does not turn off
    double into_road = 0.0;     ///< rad, by which it has still to turn until it is along the road
    double curvature = 0.0;     ///< 1/m, of the road, in its direction
  };

  /// Where a future begins.
  State begin(std::size_t future) const;
  /// One step later; `step`: how many were taken before.
  State next(const State& state, std::size_t future, std::size_t step) const;

  /// A whole future.
  BodyPath path(std::size_t future) const;
  /// What the likeliest mode leads to, without noise or switching.
  BodyPath nominalPath() const;
  /// The same of any mode.
  BodyPath nominalPath(MotionMode mode) const;

 private:
  void followRoad(State& state) const;
  State stateOf(const TrackState& state, double heading, MotionMode mode) const;
  void advance(State& state, double turn) const;
  void enter(State& state, MotionMode mode, const DrawKey& key) const;
  double turnRate(const State& state) const;

  const Track& track_;
  const ObjectFutureOptions& options_;
  const HorizonOptions& horizon_;
  const RandomDraws& draws_;
  ObjectClass class_;
  ObjectStart start_;
  RoadCourse road_;
  RoadFollower follower_;
  ModeMatrix cumulated_;          ///< rows: sums of the transition probabilities
  double turning_ = 0.0;          ///< rad, standard deviation of a step
  double sway_kept_ = 1.0;        ///< share of the sway that is left after a step
  double speed_noise_ = 0.0;      ///< m/s, of a step
  double class_turn_rate_ = 0.0;  ///< rad/s
};

}  // namespace datmo
