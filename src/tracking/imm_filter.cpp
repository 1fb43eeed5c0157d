// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/imm_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "imm_moments.h"
#include <Eigen/LU>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

constexpr std::size_t kStanding = static_cast<std::size_t>(MotionMode::kStanding);

/// Standard deviation of the velocity from which an object can stop, relative to that with which it
/// starts (1 m/s): as estimated by the filter, which follows hard braking (8 m/s^2) within a third
/// of a second.
constexpr double kStopPerStart = 3.0;

/// Mean over the velocity v of exp(-v^2 / (2 stop_variance)): the share of jumps into standing
/// within the step that is slow enough.
double stopShare(const StateEstimate& estimate, const ImmStep& step) {
  const Eigen::Vector2d velocity = estimate.mean.segment<2>(2);
  Eigen::Matrix2d covariance = estimate.covariance.block<2, 2>(2, 2);
  covariance.diagonal().array() += step.stop_variance;
  return step.stop_variance / std::sqrt(covariance.determinant()) *
         std::exp(-0.5 * velocity.dot(covariance.inverse() * velocity));
}

/// By the mode that is left; a standing object continues to stand at any speed.
ModeVector stopShares(const std::array<StateEstimate, kMotionModes>& modes, const ImmStep& step) {
  ModeVector shares;
  std::transform(modes.begin(), modes.end(), shares.begin(),
                 [&](const StateEstimate& mode) { return stopShare(mode, step); });
  shares[static_cast<int>(kStanding)] = 1.0;
  return shares;
}

}  // namespace

void ImmOptions::visit(OptionVisitor& visitor) {
  ClassMotionOptions::visit(visitor);
  visitor.group("transitions", [&] { transitions.visit(visitor); });
  visitor.number({"outlier_probability", "1",
                  "probability that a measurement is of another part of the object or of something "
                  "else, and does not depend on how the object moves"},
                 outlier_probability, {0.0, 0.5});
}

ImmStep immStep(const ImmOptions& options, double seconds, ObjectClass object_class) {
  const TargetMotionOptions& motion = options.motionOf(object_class);
  return {seconds, targetMotions(motion, seconds), startVariance(motion),
          square(kStopPerStart * motion.start_speed_std),
          transitionMatrix(countsOfSojourns(options.transitions), seconds)};
}

ImmSteps immSteps(const ImmOptions& options, double seconds) {
  ImmSteps steps;
  steps.fill(immStep(options, seconds));
  for (const ObjectClass object_class : {ObjectClass::kPedestrian, ObjectClass::kCyclist}) {
    steps[static_cast<std::size_t>(object_class)] = immStep(options, seconds, object_class);
  }
  return steps;
}

ModeVector priorModeProbabilities(const ImmOptions& options) {
  return priorModeProbabilities(options.transitions);
}

ImmFilter::ImmFilter(const StateEstimate& estimate, const ModeVector& mode_probabilities,
                     const std::optional<TransitionModel>& transitions)
    : combined_(estimate),
      probabilities_(mode_probabilities),
      probabilities_before_(mode_probabilities),
      transitions_(transitions) {
  modes_.fill(estimate);
}

void ImmFilter::predict(const ImmStep& step) {
  const ModeMatrix& transition =
      transitions_ ? transitions_->predict(step.seconds) : step.transition;
  ModeMoments moments;
  momentsAbout(combined_.mean, modes_, probabilities_, moments);
  stop_shares_ = stopShares(modes_, step);
  ModeMatrix weights = probabilities_.asDiagonal() * transition;  // joint weights at first
  const ModeVector too_fast =
      weights.col(kStanding).cwiseProduct(ModeVector::Ones() - stop_shares_);
  weights.col(kStanding) -= too_fast;
  weights.diagonal() += too_fast;
  probabilities_before_ = probabilities_;
  probabilities_ = weights.colwise().sum().transpose();
  for (int to = 0; to < kMotionModes; ++to) {
    if (probabilities_[to] > 0.0) {
      weights.col(to) /= probabilities_[to];
    }
  }
  ModeMoments mixed;
  mix(moments, weights, mixed);
  StateEstimate start;
  for (std::size_t to = 0; to < modes_.size(); ++to) {
    const int column = static_cast<int>(to);
    if (probabilities_[column] > 0.0) {
      estimateOf(combined_.mean, mixed, column, start);
      if (to != kStanding) {
        start.covariance.diagonal() += weights(kStanding, column) * step.start_variance;
      }
      datmo::predict(start, step.motions[to], modes_[to]);
    }
  }
  combine();
}

template <typename Measurement>
ImmFilter::ModeLikelihoods ImmFilter::likelihoodsOf(const Measurement& measured) const {
  ModeVector distances;  // squared
  ModeVector determinants;
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
    const Innovation innovation = innovationOf(modes_[mode], measured);
    const int index = static_cast<int>(mode);
    distances[index] = innovation.squaredDistance();
    determinants[index] = innovation.covariance.determinant();
  }
  const auto possible = probabilities_.array() > 0.0;
  const double nearest =
      possible.select(distances.array(), std::numeric_limits<double>::infinity()).minCoeff();
  const ModeVector densities =
      ((nearest - distances.array()) / 2.0).exp() / determinants.array().sqrt();
  return {possible.select(densities.array(), 0.0), -0.5 * nearest - std::log(2.0 * kPi)};
}

/// `learn`: this is the first measurement since the prediction, from which transitions are learned.
template <typename Measurement>
double ImmFilter::updateModes(const Measurement& measured, double outlier_probability, bool learn) {
  const ModeLikelihoods likelihoods = likelihoodsOf(measured);
  const double total = probabilities_.dot(likelihoods.relative);
  // An outlier is equally likely in all modes, with the mean likelihood of the measurement: so the
  // mode probabilities are Bayes' with a weight of 1 - outlier_probability, and unchanged
  // otherwise.
  ModeVector contaminated = ModeVector::Ones();
  if (total > 0.0) {
    contaminated = (1.0 - outlier_probability) * likelihoods.relative +
                   ModeVector::Constant(outlier_probability * total);
  }
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
    if (probabilities_[static_cast<int>(mode)] > 0.0) {
      modes_[mode] = datmo::update(modes_[mode], measured);
    }
  }
  probabilities_ = probabilities_.cwiseProduct(contaminated);
  probabilities_ /= probabilities_.sum();
  if (transitions_ && learn) {
    transitions_->update(probabilities_before_, contaminated, stop_shares_);
  }
  combine();
  return likelihoods.log_scale + std::log(total);
}

double ImmFilter::update(const PositionMeasurement& measured, double outlier_probability) {
  return updateModes(measured, outlier_probability, true);
}

double ImmFilter::update(const MeasuredVelocity& measured, double outlier_probability) {
  return updateModes(measured, outlier_probability, false);
}

double ImmFilter::logOverModes(const ModeLikelihoods& likelihoods) const {
  return likelihoods.log_scale + std::log(probabilities_.dot(likelihoods.relative));
}

double ImmFilter::logLikelihood(const PositionMeasurement& measured) const {
  return logOverModes(likelihoodsOf(measured));
}

double ImmFilter::logLikelihood(const MeasuredVelocity& measured) const {
  return logOverModes(likelihoodsOf(measured));
}

void ImmFilter::shift(const Point2& offset) {
  for (StateEstimate& mode : modes_) {
    mode.mean.head<2>() += offset;
  }
  combined_.mean.head<2>() += offset;
}

void ImmFilter::setTransitionPrior(const JumpCounts& prior) {
  if (transitions_) {
    transitions_->setPrior(prior);
  }
}

void ImmFilter::combine() { mixture(combined_.mean, modes_, probabilities_, combined_); }

}  // namespace datmo
