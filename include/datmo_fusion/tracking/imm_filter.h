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

/// What all filters of a class share in one time step: made once, used for every track.
struct ImmStep {
  double seconds = 0.0;
  std::array<LinearMotion, kMotionModes> motions;
  TrackState start_variance;   ///< see startVariance
  double stop_variance = 1.0;  ///< m^2/s^2, of the velocity of what may come to stand
  ModeMatrix transition;       ///< of the sojourn times; row: from, column: to; rows sum to 1
};

/// The step of `seconds` >= 0.
ImmStep immStep(const ImmOptions& options, double seconds,
                ObjectClass object_class = ObjectClass::kUnknown);

/// By class.
using ImmSteps = std::array<ImmStep, kObjectClasses>;
ImmSteps immSteps(const ImmOptions& options, double seconds);

/// Probabilities of the modes of an object of which nothing is known: each by its share of time.
ModeVector priorModeProbabilities(const ImmOptions& options);

/// Interacting multiple models: a Kalman filter for each mode over one common state, mixed before
/// each step (Blom and Bar-Shalom 1988; Bar-Shalom, Li, Kirubarajan 2001, 11.6.6; thesis 3.3.4).
///
/// A target that ceases to stand may have any velocity: what comes from the standing mode into
/// another one is mixed in with ImmStep::start_variance on top. Nor does it come to stand within a
/// step from more than ImmStep::stop_variance: the transition depends on the velocity (Seah and
/// Hwang, State estimation for stochastic linear hybrid systems with continuous-state-dependent
/// transitions, 2009). A mode of probability 0 takes no part, and costs nothing, until the
/// transition probabilities lead to it. Of fixed size; copies are cheap.
class ImmFilter {
 public:
  /// All modes start from the same estimate. Probabilities sum to 1. With `transitions`, the filter
  /// learns its own transition probabilities; else it takes those of each step.
  ImmFilter(const StateEstimate& estimate, const ModeVector& mode_probabilities,
            const std::optional<TransitionModel>& transitions = std::nullopt);

  /// Mixes and predicts. The mode probabilities become the predicted ones, which is also what they
  /// are after a missed detection.
  void predict(const ImmStep& step);

  /// Each mode is updated with the measurement, in the fixed frame, and weighted by how well it had
  /// predicted it. With `outlier_probability`, 0 to 1, it says nothing of the mode: no single
  /// measurement, however far from what a mode predicted, makes that mode less likely than by this
  /// factor. Returns the logLikelihood of the measurement, as it was before.
  double update(const PositionMeasurement& measured, double outlier_probability);

  double update(const MeasuredVelocity& measured, double outlier_probability);

  /// Logarithm of the density of a measurement over all modes, of 1/m^2 or 1/(m/s)^2.
  double logLikelihood(const PositionMeasurement& measured) const;
  double logLikelihood(const MeasuredVelocity& measured) const;

  /// Moves the position of all modes (m, fixed frame): not the object has moved, but the point of
  /// it that is followed.
  void shift(const Point2& offset);

  /// As the class of the target becomes known; without effect where nothing is learned.
  void setTransitionPrior(const JumpCounts& prior);

  /// Mean and covariance of the mixture of all modes.
  const StateEstimate& estimate() const { return combined_; }
  const ModeVector& modeProbabilities() const { return probabilities_; }
  const std::optional<TransitionModel>& transitions() const { return transitions_; }

 private:
  /// How well the modes had predicted a measurement.
  struct ModeLikelihoods {
    ModeVector relative;  ///< of each mode that is possible, over exp(log_scale); 0 for the others
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
  /// 0 to 1, of the jumps from each mode into standing: what the mode's speed allows.
  ModeVector stop_shares_ = ModeVector::Ones();
  std::optional<TransitionModel> transitions_;
};

}  // namespace datmo
