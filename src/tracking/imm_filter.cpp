#include "datmo_fusion/tracking/imm_filter.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

ModeVector sojournTimes(const ImmOptions& options) {
  ModeVector times;
  times << options.straight_sojourn, options.accelerating_sojourn, options.turn_sojourn,
      options.turn_sojourn;
  return times;
}

}  // namespace

void ImmOptions::visit(OptionVisitor& visitor) {
  visitor.group("motion", [&] { motion.visit(visitor); });
  constexpr Bounds kSojourn{0.1, 1000.0};
  visitor.number({"straight_sojourn", "s", "how long an object keeps its velocity, on average"},
                 straight_sojourn, kSojourn);
  visitor.number({"accelerating_sojourn", "s", "how long it accelerates or brakes, on average"},
                 accelerating_sojourn, kSojourn);
  visitor.number({"turn_sojourn", "s", "how long it turns, on average"}, turn_sojourn, kSojourn);
  visitor.number(
      {"least_probability", "1", "no mode becomes less likely, so that it can come back"},
      least_probability, {0.0, 0.1});
}

ImmStep immStep(const ImmOptions& options, double seconds) {
  const ModeVector sojourn = sojournTimes(options);
  ImmStep step;
  step.motions = targetMotions(options.motion, seconds);
  for (int from = 0; from < kMotionModes; ++from) {
    const double kept = std::exp(-seconds / sojourn[from]);
    step.transition.row(from).setConstant((1.0 - kept) / (kMotionModes - 1));
    step.transition(from, from) = kept;
  }
  return step;
}

ModeVector priorModeProbabilities(const ImmOptions& options) {
  const ModeVector sojourn = sojournTimes(options);
  return sojourn / sojourn.sum();
}

ImmFilter::ImmFilter(const StateEstimate& estimate, const ModeVector& mode_probabilities)
    : probabilities_(mode_probabilities), combined_(estimate) {
  modes_.fill(estimate);
}

void ImmFilter::predict(const ImmStep& step) {
  const ModeVector predicted = step.transition.transpose() * probabilities_;
  std::array<StateEstimate, kMotionModes> next;
  for (int to = 0; to < kMotionModes; ++to) {
    // A mode that nothing leads to starts from all of them, as it would with equal transitions.
    const ModeVector weights =
        predicted[to] > 0.0
            ? ModeVector(step.transition.col(to).cwiseProduct(probabilities_) / predicted[to])
            : probabilities_;
    const auto mode = static_cast<std::size_t>(to);
    next[mode] = datmo::predict(mixture(weights), step.motions[mode]);
  }
  modes_ = next;
  probabilities_ = predicted;
  combined_ = mixture(probabilities_);
}

void ImmFilter::update(const PositionMeasurement& measured, double least_probability) {
  const ModeVector log_weights = logWeights(measured);
  for (StateEstimate& mode : modes_) {
    mode = datmo::update(mode, measured);
  }
  const ModeVector weights = (log_weights.array() - log_weights.maxCoeff()).exp();
  probabilities_ = (weights / weights.sum()).cwiseMax(least_probability);
  probabilities_ /= probabilities_.sum();
  combined_ = mixture(probabilities_);
}

double ImmFilter::logLikelihood(const PositionMeasurement& measured) const {
  const ModeVector log_weights = logWeights(measured);
  const double largest = log_weights.maxCoeff();
  return largest + std::log((log_weights.array() - largest).exp().sum());
}

ModeVector ImmFilter::logWeights(const PositionMeasurement& measured) const {
  ModeVector result;
  for (int mode = 0; mode < kMotionModes; ++mode) {
    const Innovation innovation = innovationOf(modes_[static_cast<std::size_t>(mode)], measured);
    result[mode] = std::log(probabilities_[mode]) + innovation.logLikelihood();
  }
  return result;
}

StateEstimate ImmFilter::mixture(const ModeVector& weights) const {
  StateEstimate result{TrackState::Zero(), TrackCovariance::Zero()};
  for (int mode = 0; mode < kMotionModes; ++mode) {
    result.mean += weights[mode] * modes_[static_cast<std::size_t>(mode)].mean;
  }
  for (int mode = 0; mode < kMotionModes; ++mode) {
    const StateEstimate& part = modes_[static_cast<std::size_t>(mode)];
    const TrackState offset = part.mean - result.mean;
    result.covariance += weights[mode] * (part.covariance + offset * offset.transpose());
  }
  return result;
}

}  // namespace datmo
