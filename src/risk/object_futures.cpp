// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/object_futures.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/turned.h"

namespace datmo {

namespace {

/// Purposes of random numbers: a state takes kTrackState of them.
enum ObjectDraw : std::uint32_t {
  kDrawState = 0,
  kDrawHeading = 16,
  kDrawFirstMode,
  kDrawStep,
  kDrawStartCourse,
  kDrawRoad,
  kDrawStartSpeed,
  kDrawStartAcceleration,
};

/// rad; limit of the standard deviation of a sampled heading: beyond it, the velocity is more
/// informative than the box.
constexpr double kMaxHeadingSigma = 0.3;

/// m/s; a slower object has come to rest.
constexpr double kRest = 1e-3;

std::uint32_t narrow(std::size_t value) { return static_cast<std::uint32_t>(value); }

double turningOf(ObjectClass object_class, const ObjectFutureOptions& options) {
  switch (object_class) {
    case ObjectClass::kPedestrian:
      return options.pedestrian_turning;
    case ObjectClass::kCyclist:
    case ObjectClass::kUnknown:  // anything from a pedestrian to a car
      return options.cyclist_turning;
    case ObjectClass::kVehicle:
    case ObjectClass::kPole:
      break;
  }
  return options.vehicle_turning;
}

bool isTurn(MotionMode mode) {
  return mode == MotionMode::kLeftTurn || mode == MotionMode::kRightTurn;
}

/// Replaces turns for objects that follow the road, since they would lead off it.
MotionMode modeIn(bool follows_road, MotionMode mode) {
  return follows_road && isTurn(mode) ? MotionMode::kConstantVelocity : mode;
}

/// Returns the mode whose range of the cumulative probabilities contains the uniform number.
template <typename Cumulated>
MotionMode modeAt(const Cumulated& cumulated, double uniform) {
  int mode = 0;
  while (mode + 1 < kMotionModes && uniform >= cumulated[mode]) {
    ++mode;
  }
  return static_cast<MotionMode>(mode);
}

}  // namespace

MotionMode likeliestMode(const Track& track) {
  const auto& shares = track.mode_probabilities;
  return static_cast<MotionMode>(std::max_element(shares.begin(), shares.end()) - shares.begin());
}

ObjectFutures::ObjectFutures(const Track& track, const std::optional<RoadCourse>& road,
                             const ObjectFutureOptions& options, const HorizonOptions& horizon,
                             const RandomDraws& draws)
    : track_(track),
      options_(options),
      horizon_(horizon),
      draws_(draws),
      class_(track.objectClass()),
      start_(startOf(track, kMaxHeadingSigma)),
      cumulated_(transitionMatrix(countsOfSojourns(options.transitions), horizon.step)) {
  for (int mode = 1; mode < kMotionModes; ++mode) {
    cumulated_.col(mode) += cumulated_.col(mode - 1);
  }
  const TargetMotionOptions& motion = options.motion.motionOf(class_);
  turning_ = turningOf(class_, options) * std::sqrt(horizon.step);
  sway_kept_ =
      class_ == ObjectClass::kPedestrian ? 1.0 : std::exp(-horizon.step / options.turning_time);
  speed_noise_ = std::sqrt(motion.acceleration_density * horizon.step);
  class_turn_rate_ = motion.turn_rate;
  if (road) {
    const ModeVector prior = priorModeProbabilities(options.transitions);
    const double turn_share = prior[static_cast<int>(MotionMode::kLeftTurn)] +
                              prior[static_cast<int>(MotionMode::kRightTurn)];
    road_ = *road;
    follower_ = roadFollower(track, start_, road->direction, turn_share, options.road_following)
                    .value_or(RoadFollower());
  }
}

/// Makes the object follow the road from now on, in its own direction of travel.
void ObjectFutures::followRoad(State& state) const {
  const Point2 along(std::cos(road_.direction), std::sin(road_.direction));
  state.follows_road = true;
  state.curvature = state.course.dot(along) < 0.0 ? -road_.curvature : road_.curvature;
}

/// `mode` standing: at rest, regardless of the velocity.
ObjectFutures::State ObjectFutures::stateOf(const TrackState& state, double heading,
                                            MotionMode mode) const {
  State result;
  result.position = state.head<2>();
  result.heading = heading;
  result.mode = mode;
  const Point2 velocity = state.segment<2>(2);
  const double speed = velocity.norm();
  if (speed > kRest) {
    result.course = velocity / speed;
    result.speed = mode == MotionMode::kStanding ? 0.0 : speed;
    result.acceleration = std::clamp(result.course.dot(state.tail<2>()), -options_.max_acceleration,
                                     options_.max_acceleration);
  }
  return result;
}

ObjectFutures::State ObjectFutures::begin(std::size_t future) const {
  DrawKey key{track_.id, narrow(future), 0, kDrawState};
  TrackState normals;
  for (int i = 0; i < kTrackState; ++i) {
    key.kind = kDrawState + static_cast<std::uint32_t>(i);
    normals[i] = draws_.normal(key);
  }
  std::array<double, kMotionModes> cumulated = track_.mode_probabilities;
  for (std::size_t mode = 1; mode < kMotionModes; ++mode) {
    cumulated[mode] += cumulated[mode - 1];
  }
  key.kind = kDrawRoad;
  const double drawn = draws_.uniform(key);
  const bool along_road = drawn < follower_.probability;
  const bool joins = !along_road && drawn < follower_.probability + follower_.joining;
  key.kind = kDrawFirstMode;
  const double total = cumulated.back();  // 0: the source knows no modes
  const MotionMode mode =
      modeIn(along_road || joins,
             total > 0.0 ? modeAt(cumulated, draws_.uniform(key) * total) : likeliestMode(track_));
  const ObjectStart& start = along_road ? follower_.start : start_;
  key.kind = kDrawHeading;
  const double heading = start.heading + start.heading_sigma * draws_.normal(key);
  State state = stateOf(start.state + start.root * normals, heading, mode);
  if (along_road || joins) {
    followRoad(state);
  }
  if (joins) {
    state.into_road = turnIntoRoad(std::atan2(state.course.y(), state.course.x()), road_.direction);
  }
  return state;
}

void ObjectFutures::enter(State& state, MotionMode mode, DrawKey key) const {
  if (state.mode == MotionMode::kStanding && state.speed <= kRest) {
    // It starts along its box; a pedestrian in any direction.
    key.kind = kDrawStartCourse;
    const double direction =
        class_ == ObjectClass::kPedestrian ? kTurn * draws_.uniform(key) : state.heading;
    state.course = {std::cos(direction), std::sin(direction)};
    key.kind = kDrawStartSpeed;
    state.speed = options_.motion.motionOf(class_).start_speed_std * std::abs(draws_.normal(key));
  }
  if (mode == MotionMode::kConstantAcceleration) {
    key.kind = kDrawStartAcceleration;
    state.acceleration = std::clamp(options_.start_acceleration * draws_.normal(key),
                                    -options_.max_acceleration, options_.max_acceleration);
  }
  state.mode = mode;
}

double ObjectFutures::turnRate(const State& state) const {
  if (!state.follows_road && !isTurn(state.mode)) {
    return 0.0;
  }
  const double most = options_.max_lateral / std::max(kRest, state.speed);
  const double rate = std::min(class_turn_rate_, most);
  if (state.follows_road) {
    const double into = std::clamp(state.into_road / horizon_.step, -rate, rate);
    return std::clamp(into + state.curvature * state.speed, -most, most);
  }
  return state.mode == MotionMode::kLeftTurn ? rate : -rate;
}

/// `turn`: rad, in this step. The position moves at the mean of the velocities before and after.
void ObjectFutures::move(State& state, double turn) const {
  double acceleration = 0.0;
  if (state.mode == MotionMode::kConstantAcceleration) {
    acceleration = state.acceleration;
  } else if (state.mode == MotionMode::kStanding) {
    acceleration = -options_.stop_deceleration;
  }
  Point2 moved = state.speed * state.course;
  if (state.speed > kRest) {
    state.course = turned(state.course, turn);
    state.heading += turn;
    state.speed = std::max(0.0, state.speed + acceleration * horizon_.step);
  } else {
    state.speed = 0.0;
  }
  moved += state.speed * state.course;
  state.position += 0.5 * horizon_.step * moved;
}

void ObjectFutures::advance(State& state, std::size_t future, std::size_t step) const {
  const DrawKey key{track_.id, narrow(future), narrow(step) + 1, kDrawStep};
  const StepDraws drawn = draws_.step(key);
  const MotionMode mode = modeIn(
      state.follows_road, modeAt(cumulated_.row(static_cast<int>(state.mode)), drawn.uniform));
  if (mode != state.mode) {
    enter(state, mode, key);
  }
  if (state.mode == MotionMode::kStanding) {
    if (state.speed <= kRest) {
      return;
    }
  } else {
    state.speed = std::max(0.0, state.speed + speed_noise_ * drawn.second);
  }
  const double sway = state.sway;
  state.sway = sway_kept_ * sway + turning_ * drawn.first;
  const double turn = turnRate(state) * horizon_.step;
  if (state.follows_road && state.speed > kRest) {
    state.into_road += state.curvature * state.speed * horizon_.step - turn;
  }
  move(state, turn + state.sway - sway);
}

BodyPath ObjectFutures::path(std::size_t future) const {
  BodyPath path{horizon_.step, {}};
  State state = begin(future);
  path.poses.push_back(bodyPose(state.position, state.heading));
  for (std::size_t step = 0; step < horizon_.steps(); ++step) {
    advance(state, future, step);
    path.poses.push_back(bodyPose(state.position, state.heading));
  }
  return path;
}

BodyPath ObjectFutures::nominalPath() const { return nominalPath(likeliestMode(track_)); }

BodyPath ObjectFutures::nominalPath(MotionMode mode) const {
  const bool along_road = !isTurn(mode) && follower_.probability > 0.5;
  const ObjectStart& start = along_road ? follower_.start : start_;
  State state = stateOf(start.state, start.heading, mode);
  if (along_road) {
    followRoad(state);
  }
  BodyPath path{horizon_.step, {bodyPose(state.position, state.heading)}};
  for (std::size_t step = 0; step < horizon_.steps(); ++step) {
    move(state, turnRate(state) * horizon_.step);
    path.poses.push_back(bodyPose(state.position, state.heading));
  }
  return path;
}

}  // namespace datmo
