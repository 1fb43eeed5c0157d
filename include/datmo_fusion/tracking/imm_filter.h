// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/tracking/class_motion.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/transition_model.h"

namespace datmo {

struct ImmOptions : ClassMotionOptions {
  TransitionOptions transitions;
  double outlier_probability = 0.05;

  void visit(OptionVisitor& visitor);
};

/// What all filters of a class share in one time step: computed once, used for every track.
struct ImmStep {
  double seconds = 0.0;
  std::array<LinearMotion, kMotionModes> motions;
  TrackState start_variance;   ///< see startVariance
  double stop_variance = 1.0;  ///< m^2/s^2, of the velocity from which an object may stop
  ModeMatrix transition;       ///< from the sojourn times; row: from, column: to; rows sum to 1
};

/// Returns the step of `seconds` >= 0.
ImmStep immStep(const ImmOptions& options, double seconds,
                ObjectClass object_class = ObjectClass::kUnknown);

/// Steps by class.
using ImmSteps = std::array<ImmStep, kObjectClasses>;
ImmSteps immSteps(const ImmOptions& options, double seconds);

/// Returns the prior mode probabilities: the share of time in each.
ModeVector priorModeProbabilities(const ImmOptions& options);

/// Interacting multiple model filter: a Kalman filter for each mode over one common state, mixed
/// before each step (Blom and Bar-Shalom 1988; Bar-Shalom, Li, Kirubarajan 2001, 11.6.6; thesis
/// 3.3.4).
///
/// A target that starts moving may have any velocity: estimates that are mixed from the standing
/// mode into another one get ImmStep::start_variance added. A target can only stop within a step if
/// its velocity is within ImmStep::stop_variance: the transition depends on the velocity (Seah and
/// Hwang, State estimation for stochastic linear hybrid systems with continuous-state-dependent
/// transitions, 2009). A mode of probability 0 is skipped, and costs nothing, until transitions
/// lead to it. Of fixed size; copies are cheap.
class ImmFilter {
 public:
  /// All modes start from the same estimate. Probabilities sum to 1. With `transitions`, the filter
  /// learns its own transition probabilities; otherwise it uses those of each step.
  ImmFilter(const StateEstimate& estimate, const ModeVector& mode_probabilities,
            const std::optional<TransitionModel>& transitions = std::nullopt);

  /// Mixes and predicts. The mode probabilities become the predicted ones, which also hold after a
  /// missed detection.
  void predict(const ImmStep& step);

  /// Updates each mode with the measurement, in the fixed frame, and its probability by the
  /// likelihood. The measurement is an outlier, uninformative of the mode, with
  /// `outlier_probability`, 0 to 1: this bounds by how much a single measurement can reduce a
  /// mode's probability. Returns the logLikelihood of the measurement before the update.
  double update(const PositionMeasurement& measured, double outlier_probability);

  double update(const MeasuredVelocity& measured, double outlier_probability);

  /// Returns the log density of a measurement over all modes, in 1/m^2 or 1/(m/s)^2.
  double logLikelihood(const PositionMeasurement& measured) const;
  double logLikelihood(const MeasuredVelocity& measured) const;

  /// Shifts the position of all modes (m, fixed frame): not because the object has moved, but
  /// because its reference point has.
  void shift(const Point2& offset);

  /// Sets the prior once the target's class is known; no effect if nothing is learned.
  void setTransitionPrior(const JumpCounts& prior);

  /// Returns mean and covariance of the mixture of all modes.
  const StateEstimate& estimate() const { return combined_; }
  const ModeVector& modeProbabilities() const { return probabilities_; }
  const std::optional<TransitionModel>& transitions() const { return transitions_; }

 private:
  /// Likelihoods of a measurement given each mode.
  struct ModeLikelihoods {
    ModeVector relative;  ///< of each possible mode, over exp(log_scale); 0 for the others
    double log_scale;     ///< of 1/m^2 or 1/(m/s)^2
  };
  template <typename Measurement>
  ModeLikelihoods likelihoodsOf(const Measurement& measured) const;
  template <typename Measurement>
  double updateModes(const Measurement& measured, double outlier_probability, bool learn);
  double logOverModes(const ModeLikelihoods& likelihoods) const;
  void combine();

  StateEstimate combined_;
  ModeVector probabilities_;
  std::array<StateEstimate, kMotionModes> modes_;
  ModeVector probabilities_before_;  ///< before the last prediction
  /// 0 to 1, share of the jumps from each mode into standing that the mode's speed allows.
  ModeVector stop_shares_ = ModeVector::Ones();
  std::optional<TransitionModel> transitions_;
};

}  // namespace datmo
