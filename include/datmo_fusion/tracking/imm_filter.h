#pragma once

#include <array>

#include <Eigen/Core>

#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

struct ImmOptions {
  TargetMotionOptions motion;
  double straight_sojourn = 10.0;     ///< s
  double accelerating_sojourn = 3.0;  ///< s
  double turn_sojourn = 3.0;          ///< s
  double least_probability = 1e-3;

  void visit(OptionVisitor& visitor);
};

using ModeVector = Eigen::Matrix<double, kMotionModes, 1>;
using ModeMatrix = Eigen::Matrix<double, kMotionModes, kMotionModes>;

/// What all filters share in one time step: made once, used for every track.
struct ImmStep {
  std::array<LinearMotion, kMotionModes> motions;
  ModeMatrix transition;  ///< row: from, column: to; rows sum to 1
};

/// A mode lasts its sojourn time on average: it is kept over `seconds` >= 0 with exp(-seconds /
/// sojourn), and left to the others in equal shares.
ImmStep immStep(const ImmOptions& options, double seconds);

/// Probabilities of the modes of an object of which nothing is known: each by its share of time.
ModeVector priorModeProbabilities(const ImmOptions& options);

/// Interacting multiple models: four Kalman filters over one state, mixed before each step (Blom
/// and Bar-Shalom 1988; Bar-Shalom, Li, Kirubarajan 2001, 11.6.6; thesis 3.3.4).
class ImmFilter {
 public:
  /// All modes start from the same estimate. Probabilities sum to 1.
  ImmFilter(const StateEstimate& estimate, const ModeVector& mode_probabilities);

  /// Mixes and predicts. The mode probabilities become the predicted ones, which is also what they
  /// are after a missed detection.
  void predict(const ImmStep& step);

  /// Each mode takes in the measurement and is weighed by how well it had predicted it; none falls
  /// below `least_probability`, so that it can come back.
  void update(const PositionMeasurement& measured, double least_probability);

  /// Logarithm of the density of a measurement over all modes, of 1/m^2.
  double logLikelihood(const PositionMeasurement& measured) const;

  /// Mean and covariance of the mixture of all modes.
  const StateEstimate& estimate() const { return combined_; }
  const ModeVector& modeProbabilities() const { return probabilities_; }

 private:
  ModeVector logWeights(const PositionMeasurement& measured) const;
  StateEstimate mixture(const ModeVector& weights) const;

  std::array<StateEstimate, kMotionModes> modes_;
  ModeVector probabilities_;
  StateEstimate combined_;
};

}  // namespace datmo
