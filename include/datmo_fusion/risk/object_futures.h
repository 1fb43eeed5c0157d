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

/// Length, step and number of the futures.
struct HorizonOptions {
  double horizon = 4.0;  ///< s
  double step = 0.2;     ///< s
  int futures = 256;
  int seed = 1;

  void visit(OptionVisitor& visitor);

  std::size_t steps() const;
};

struct ObjectFutureOptions {
  double vehicle_turning = 0.03;  ///< rad/sqrt(s)
  /// rad/sqrt(s), 0 to 3: as vehicle_turning, of cyclists and unknown objects
  double cyclist_turning = 0.08;
  /// rad/sqrt(s), 0 to 3: the same of pedestrians, who change direction easily (thesis 5.3.5)
  double pedestrian_turning = 0.25;
  double turning_time = 2.0;  ///< s
  /// m/s^2, 0 to 10: standard deviation of the acceleration of an object that begins to accelerate
  /// or brake
  double start_acceleration = 1.5;
  /// m/s^2, 0.1 to 10: deceleration with which an object comes to a stop
  double stop_deceleration = 3.0;
  double max_acceleration = 8.0;  ///< m/s^2
  double max_lateral = 4.0;       ///< m/s^2
  RoadFollowingOptions road_following;
  ClassMotionOptions motion;      ///< the tracker's
  TransitionOptions transitions;  ///< the tracker's sojourn times

  void visit(OptionVisitor& visitor);
};

/// Returns the most likely motion mode of an object: the first of equally likely ones.
MotionMode likeliestMode(const Track& track);

/// Possible futures of one tracked object.
///
/// Each is sampled from the track's state and covariance and from its mode probabilities; the modes
/// switch according to their sojourn times (Markov jumps, as in the tracker's IMM). In a mode the
/// object moves according to that mode, with the tracker's noise on its speed, and turns randomly
/// according to its class: pedestrians freely, drivers and riders about their course, to which they
/// return. Drivers and riders may follow the road (RoadFollowingOptions): then they follow its
/// bends, and do not turn off it; or they may turn into it, and follow it once their course leads
/// along it. Beyond the tracker's models, a braking object comes to rest and does not reverse, one
/// that is stopping brakes until it is stationary, and no turn is sharper than tires allow.
class ObjectFutures {
 public:
  /// `track`: valid (isValid), at the time at which the futures begin. `road`: beside it; none:
  /// unknown. All must outlive this.
  ObjectFutures(const Track& track, const std::optional<RoadCourse>& road,
                const ObjectFutureOptions& options, const HorizonOptions& horizon,
                const RandomDraws& draws);

  /// State of the object at one time of one future.
  struct State {
    Point2 position = Point2::Zero();  ///< m
    Point2 course = Point2::UnitX();   ///< of length 1, along the velocity
    double speed = 0.0;                ///< m/s, at least 0
    double heading = 0.0;              ///< rad, of the box
    double acceleration = 0.0;         ///< m/s^2, along the course
    double sway = 0.0;                 ///< rad, deviation of the course from that of the mode
    MotionMode mode = MotionMode::kConstantVelocity;
    bool follows_road = false;  ///< it does not turn off the road
    double into_road = 0.0;     ///< rad, remaining turn until it moves along the road
    double curvature = 0.0;     ///< 1/m, of the road, in its direction
  };

  /// Returns the initial state of a future.
  State begin(std::size_t future) const;
  /// Advances the state of a future by one step; `step`: number of steps before.
  void advance(State& state, std::size_t future, std::size_t step) const;

  /// Returns a whole future.
  BodyPath path(std::size_t future) const;
  /// Returns the path of the likeliest mode, without noise or switching.
  BodyPath nominalPath() const;
  /// Returns the same for any mode.
  BodyPath nominalPath(MotionMode mode) const;

 private:
  void followRoad(State& state) const;
  State stateOf(const TrackState& state, double heading, MotionMode mode) const;
  void move(State& state, double turn) const;
  void enter(State& state, MotionMode mode, DrawKey key) const;
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
