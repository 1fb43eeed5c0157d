// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/target.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/tracking/association_scan.h"

namespace datmo {

namespace {

/// The first object gives the position; the velocity is only assumed.
ImmFilter birth(const Object& object, const PositionMeasurement& measured,
                const TargetOptions& options, const std::optional<TransitionModel>& transitions) {
  StateEstimate estimate;
  estimate.mean.head<2>() = measured.position;
  estimate.covariance.setZero();
  estimate.covariance.topLeftCorner<2, 2>() = measured.covariance;
  estimate.covariance.diagonal().segment<2>(2).setConstant(options.birth_speed_std *
                                                           options.birth_speed_std);
  const double acceleration = options.filter.motionOf(object.objectClass()).acceleration_std;
  estimate.covariance.diagonal().tail<2>().setConstant(acceleration * acceleration);
  return {carriedOn(estimate, -measured.delay), priorModeProbabilities(options.filter),
          transitions};
}

/// Probability of an even chance.
constexpr double kEven = 0.5;

/// Log-likelihood ratio of a velocity for a moving versus a standing target.
double velocityEvidence(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                        double false_motion, const TargetOptions& options) {
  return velocityLogRatio(velocity, covariance,
                          {options.class_by_speed.pedestrian.componentStd(),
                           options.class_by_speed.cyclist.componentStd(), options.birth_speed_std},
                          false_motion);
}

}  // namespace

void SensorClassOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"class_by_size", "",
                  "whether the classes of its objects are inferred from their size, so that size "
                  "is not counted twice; sensors not listed: true"},
                 class_by_size);
  visitor.toggle({"measures_size", "",
                  "whether it measures the size of its objects; sensors not listed: true"},
                 measures_size);
}

void TargetOptions::visit(OptionVisitor& visitor) {
  visitor.group("filter", [&] { filter.visit(visitor); });
  visitor.group("box", [&] { box.visit(visitor); });
  visitor.group("existence", [&] { existence.visit(visitor); });
  visitor.group("motion_likelihood", [&] { motion_likelihood.visit(visitor); });
  visitor.group("class_by_speed", [&] { class_by_speed.visit(visitor); });
  visitor.group("motion_by_class", [&] { motion_by_class.visit(visitor); });
  visitor.number({"birth_speed_std", "m/s",
                  "standard deviation of each component of the velocity of a new object"},
                 birth_speed_std, {0.1, 100.0});
  visitor.number({"stop_speed", "m/s", "a moving object becomes stationary below this speed"},
                 stop_speed, {0.01, 100.0});
  visitor.each({"sensors", "", "sensors that see the objects"}, sensors);
}

bool TargetOptions::hasClassBySize(const Object& object) const {
  bool by_size = object.sensors.empty();
  bool measured_otherwise = false;
  for (const std::string& sensor : object.sensors) {
    const auto found = sensors.find(sensor);
    const SensorClassOptions options =
        found == sensors.end() ? SensorClassOptions() : found->second;
    by_size = by_size || options.class_by_size;
    measured_otherwise = measured_otherwise || (options.measures_size && !options.class_by_size);
  }
  return by_size && !measured_otherwise;
}

Target::Target(const Object& object, std::size_t index, std::uint64_t number,
               const TargetOptions& options, const std::optional<TransitionModel>& transitions)
    : number_(number),
      measurement_index_(index),
      existence_(object.log_odds, options.existence),
      box_(object, options.box),
      filter_(birth(object, box_.measurementOf(object), options, transitions)),
      height_(object.height),
      motion_log_odds_(object.motion_log_odds),
      sensors_(std::make_shared<const std::vector<std::string>>(object.sensors)) {
  updateClass(object, options);
  seen_points_.add(object, 0.0, options.motion_likelihood.window);
  if (object.velocity) {
    updateVelocity(*object.velocity, options);
  }
}

void Target::predict(double seconds, const ImmSteps& steps, const TargetOptions& options) {
  filter_.predict(steps[static_cast<std::size_t>(objectClass())]);
  box_.predict(seconds, options.box);
  age_ += seconds;
  since_update_ += seconds;
  measurement_index_ = kUnseen;
}

void Target::update(const Observation& observation, std::size_t index, double detection_probability,
                    const TargetOptions& options) {
  const Object& object = observation.object;
  const PositionMeasurement measured = measurementOf(object);
  const double likelihood = filter_.update(measured, options.filter.outlier_probability);
  existence_.detect(likelihood, detection_probability, observation.log_density, object.log_odds,
                    options.existence);
  if (object.velocity) {
    updateVelocity(*object.velocity, options);
  }
  const Point2 shift = box_.update(object, since_update_, options.box);
  filter_.shift(shift);
  judgeMotion(options);
  if (moving_) {
    const StateEstimate& estimate = filter_.estimate();
    filter_.shift(box_.followVelocity(estimate.mean.segment<2>(2),
                                      estimate.covariance.block<2, 2>(2, 2), options.box));
  } else {
    box_.stand();
  }
  ++hits_;
  measurement_index_ = index;
  since_update_ = 0.0;
  height_ = object.height > 0.0 ? object.height : height_;
  motion_log_odds_ = object.motion_log_odds;
  if (object.sensors != *sensors_) {
    sensors_ = std::make_shared<const std::vector<std::string>>(object.sensors);
  }
  updateClass(object, options);
  if (!confirmed()) {
    seen_points_.add(object, age_, options.motion_likelihood.window);
  }
}

void Target::miss(double detection_probability, const TargetOptions& options) {
  existence_.miss(detection_probability, options.existence);
}

double Target::motionProbability(const ScanHistory& history, Stamp now,
                                 const TargetOptions& options) const {
  const StateEstimate& estimate = filter_.estimate();
  const MovingBody body{box(), box_.sizeVariance(), estimate.mean.segment<2>(2),
                        0.5 * estimate.covariance.block<2, 2>(2, 2).trace()};
  BeamEvidence beams =
      beamEvidence(history, seen_points_, body, now, age_, options.motion_likelihood);
  // The end of a beam moves along a standing wall, and the measured velocity is that of the wall.
  beams.log_ratio_to_grazing -= std::log(standing_velocity_ratio_);
  const double false_motion =
      beams.by_others ? options.motion_likelihood.apparent_box_motion : falseMotion(options);
  const double log_ratio = motion_log_odds_ +
                           classLogRatio(class_.probabilities(), options.motion_by_class) +
                           motionLogRatio(beams, trackedVelocityEvidence(false_motion, options));
  return datmo::motionProbability(log_ratio, existence_.logOdds(options.existence),
                                  options.motion_likelihood);
}

/// Probability that it seems to move while standing: its visible part slides, and a measured
/// velocity, if informative, is of something else. Not a product: one wrong match of points can
/// cause both.
double Target::falseMotion(const TargetOptions& options) const {
  return std::min(options.motion_likelihood.apparent_motion, standing_velocity_ratio_);
}

double Target::trackedVelocityEvidence(double false_motion, const TargetOptions& options) const {
  const StateEstimate& estimate = filter_.estimate();
  return velocityEvidence(estimate.mean.segment<2>(2), estimate.covariance.block<2, 2>(2, 2),
                          false_motion, options);
}

double Target::sameClassProbability(const Observation& observation) const {
  const std::optional<ClassProbabilities>& observed = observation.class_likelihoods;
  const ClassProbabilities& own = class_.probabilities();
  return observed ? std::inner_product(own.begin(), own.end(), observed->begin(), 0.0)
                  : kChanceOfClass;
}

void Target::confirm(std::uint64_t order, bool moves) {
  confirmed_as_ = order;
  moving_ = moves;
  seen_points_.clear();
}

void Target::updateClass(const Object& object, const TargetOptions& options) {
  class_.update(object.class_probabilities);
  if (options.hasClassBySize(object)) {
    class_by_size_.update(object.class_probabilities);
  }
}

/// The measured velocity is its own, or of something else: then it is distributed as that of a new
/// object, and the measurement is ignored if this explains it better.
void Target::updateVelocity(const MeasuredVelocity& measured, const TargetOptions& options) {
  const double wrong =
      std::max(options.motion_likelihood.wrong_velocity, measured.wrong_probability);
  const Eigen::Matrix2d of_new = square(options.birth_speed_std) * Eigen::Matrix2d::Identity();
  const double own = filter_.logLikelihood(measured);
  const double other = Innovation{measured.velocity, of_new + measured.covariance}.logLikelihood();
  if (own + std::log(1.0 - wrong) < other + std::log(wrong)) {
    return;
  }
  // Not a product: what misleads a detector in one image does so in the next.
  standing_velocity_ratio_ =
      std::min(standing_velocity_ratio_,
               std::exp(-velocityEvidence(measured.velocity, measured.covariance, wrong, options)));
  filter_.update(measured, options.filter.outlier_probability);
}

/// Between standing and a velocity that is more likely of a moving target, the state is kept. Which
/// of both is more likely does not depend on how often standing objects seem to move.
void Target::judgeMotion(const TargetOptions& options) {
  const double standing = filter_.modeProbabilities()[static_cast<int>(MotionMode::kStanding)];
  if (standing > kEven || filter_.estimate().mean.segment<2>(2).norm() < options.stop_speed) {
    moving_ = false;
  } else if (trackedVelocityEvidence(falseMotion(options), options) > 0.0) {
    moving_ = true;
  }
}

Track Target::track(const TargetOptions& options) const {
  const ModeVector& modes = filter_.modeProbabilities();
  Track track;
  track.id = id_;
  track.state = filter_.estimate().mean;
  track.covariance = filter_.estimate().covariance;
  track.covariance.topLeftCorner<2, 2>() = positionCovariance();
  for (int mode = 0; mode < kMotionModes; ++mode) {
    track.mode_probabilities[static_cast<std::size_t>(mode)] = modes[mode];
  }
  track.box = box();
  track.height = height_;
  track.heading_variance = box_.headingVariance();
  track.yaw_rate = options.filter.motionOf(objectClass()).turn_rate *
                   (modes[static_cast<int>(MotionMode::kLeftTurn)] -
                    modes[static_cast<int>(MotionMode::kRightTurn)]);
  track.moving = moving_;
  track.class_probabilities = class_.probabilities();
  if (!isInformative(class_by_size_.probabilities())) {  // otherwise these include the size
    track.class_probabilities =
        posterior(track.class_probabilities, ofEachClass(box_.sizeLikelihoods(options.box)));
  }
  if (moving_) {
    track.class_probabilities =
        withSpeed(track.class_probabilities, speedOf(filter_.estimate()), options.class_by_speed);
  }
  track.age = age_;
  track.since_update = since_update_;
  track.hits = hits_;
  track.sensors = *sensors_;
  return track;
}

}  // namespace datmo
