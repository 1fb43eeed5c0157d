#include "datmo_fusion/tracking/target.h"

namespace datmo {

namespace {

/// The first object tells where it is; that it may have any velocity is an assumption.
ImmFilter birth(const Object& object, const TargetOptions& options) {
  StateEstimate estimate;
  estimate.mean.head<2>() = object.box.centre.position();
  estimate.covariance.setZero();
  estimate.covariance.topLeftCorner<2, 2>() = object.position_covariance;
  estimate.covariance.diagonal().segment<2>(2).setConstant(options.birth_speed_std *
                                                           options.birth_speed_std);
  const double acceleration = options.filter.motion.acceleration_std;
  estimate.covariance.diagonal().tail<2>().setConstant(acceleration * acceleration);
  return {estimate, priorModeProbabilities(options.filter)};
}

}  // namespace

void TargetOptions::visit(OptionVisitor& visitor) {
  visitor.group("filter", [&] { filter.visit(visitor); });
  visitor.group("box", [&] { box.visit(visitor); });
  visitor.group("evidence", [&] { evidence.visit(visitor); });
  visitor.number({"birth_speed_std", "m/s",
                  "standard deviation of each component of the velocity of a new object"},
                 birth_speed_std, {0.1, 100.0});
  visitor.number({"stop_speed", "m/s",
                  "a moving object stands when it is slower; below evidence/least_speed, so that "
                  "noise does not switch it"},
                 stop_speed, {0.01, 100.0});
}

Target::Target(const Object& object, const TargetOptions& options)
    : filter_(birth(object, options)),
      box_(object),
      evidence_(object),
      height_(object.height),
      object_class_(object.object_class),
      class_probability_(object.class_probability),
      sensors_(object.sensors) {}

void Target::predict(double seconds, const ImmStep& step, const TargetOptions& options) {
  filter_.predict(step);
  box_.predict(seconds, options.box);
  evidence_.predict(seconds, options.evidence);
  age_ += seconds;
  since_update_ += seconds;
}

void Target::update(const Object& object, const TargetOptions& options) {
  const PositionMeasurement measured = measurementOf(object);
  evidence_.update(object, measured, filter_.logLikelihood(measured), options.evidence);
  filter_.update(measured, options.filter.least_probability);
  box_.update(object, since_update_, options.box);
  judgeMotion(options);
  if (moving_) {
    const StateEstimate& estimate = filter_.estimate();
    box_.followVelocity(estimate.mean.segment<2>(2), estimate.covariance.block<2, 2>(2, 2),
                        options.box);
  }
  ++hits_;
  since_update_ = 0.0;
  height_ = object.height > 0.0 ? object.height : height_;
  sensors_ = object.sensors;
  classify(object);
}

bool Target::mayBe(const Object& object) const {
  return object_class_ == ObjectClass::kUnknown || object.object_class == ObjectClass::kUnknown ||
         object_class_ == object.object_class;
}

void Target::confirm(std::uint32_t id) {
  id_ = id;
  moving_ = true;
}

/// Between the two speeds it stays as it was.
void Target::judgeMotion(const TargetOptions& options) {
  const StateEstimate& estimate = filter_.estimate();
  if (evidence_.seemsToStand() || estimate.mean.segment<2>(2).norm() < options.stop_speed) {
    moving_ = false;
  } else if (velocityIsSignificant(estimate, options.evidence.speed_significance,
                                   options.evidence.least_speed)) {
    moving_ = true;
  }
}

void Target::classify(const Object& object) {
  if (object.object_class != ObjectClass::kUnknown &&
      object.class_probability >= class_probability_) {
    object_class_ = object.object_class;
    class_probability_ = object.class_probability;
  }
}

Track Target::track(const TargetOptions& options) const {
  const ModeVector& modes = filter_.modeProbabilities();
  Track track;
  track.id = id_;
  track.state = filter_.estimate().mean;
  track.covariance = filter_.estimate().covariance;
  for (int mode = 0; mode < kMotionModes; ++mode) {
    track.mode_probabilities[static_cast<std::size_t>(mode)] = modes[mode];
  }
  track.box = box();
  track.height = height_;
  track.yaw_rate =
      options.filter.motion.turn_rate * (modes[static_cast<int>(MotionMode::kLeftTurn)] -
                                         modes[static_cast<int>(MotionMode::kRightTurn)]);
  track.moving = moving_;
  track.object_class = object_class_;
  track.class_probability = class_probability_;
  track.age = age_;
  track.since_update = since_update_;
  track.hits = hits_;
  track.sensors = sensors_;
  return track;
}

}  // namespace datmo
