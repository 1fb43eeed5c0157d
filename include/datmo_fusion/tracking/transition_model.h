// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

using ModeVector = Eigen::Matrix<double, kMotionModes, 1>;
using ModeMatrix = Eigen::Matrix<double, kMotionModes, kMotionModes>;

/// Limits of the learning of jumps between modes.
struct TransitionLearningOptions {
  double prior_exposure = 20.0;   ///< s
  double class_exposure = 300.0;  ///< s
  double forgetting = 60.0;       ///< s
  double min_sojourn = 0.3;       ///< s
  double max_sojourn = 300.0;     ///< s
  double min_share = 0.02;

  void visit(OptionVisitor& visitor);
};

/// Transitions of objects between motion modes.
struct TransitionOptions {
  double straight_sojourn = 10.0;     ///< s
  double accelerating_sojourn = 3.0;  ///< s
  double turn_sojourn = 3.0;          ///< s
  double standing_sojourn = 10.0;     ///< s
  bool standing = true;
  bool adaptive = true;
  TransitionLearningOptions learning;

  void visit(OptionVisitor& visitor);
};

/// Knowledge about jumps between modes, as equivalent counts. Counts of independent observations
/// add up. The rate of jumps from mode i to mode j is jumps(i, j) / exposure[i].
struct JumpCounts {
  ModeMatrix jumps = ModeMatrix::Zero();     ///< 1; row: from, column: to; diagonal 0
  ModeVector exposure = ModeVector::Zero();  ///< s, in each mode; must be more than 0 for a rate
};

/// Returns the counts that correspond to the sojourn times, with the weight of
/// learning/prior_exposure: a mode is left for the others in equal shares. A disabled mode is
/// neither entered nor left.
JumpCounts countsOfSojourns(const TransitionOptions& options);

/// Returns the prior mode probabilities: the share of time in each.
ModeVector priorModeProbabilities(const TransitionOptions& options);

/// Returns the probabilities of the mode (column) that follows each mode (row) after `seconds` >=
/// 0: mode i is kept with exp(-seconds / sojourn_i), and left in the shares of its jumps. Rows sum
/// to 1 for any step; multiple jumps within a step are neglected.
ModeMatrix transitionMatrix(const JumpCounts& counts, double seconds);

/// The transition probabilities of one target, learned online: the quasi-Bayesian estimator of
/// Jilkov and Li, Online Bayesian Estimation of Transition Probabilities for Markovian Jump
/// Systems, IEEE Trans. Signal Processing 52(6), 2004, for varying time steps.
///
/// Row i of the matrix P has a Dirichlet distribution of strength A = exposure_i / seconds and mean
/// p_i. With mode probabilities m before the step and mode likelihoods L after it, the data have
/// the likelihood m' P L, which is linear in each row. By Bayes the row is therefore the mixture of
/// "it jumped to j", one more count of j, with the weights x_ij = m_i p_ij L_j / (m' P L), and of
/// "it was not in mode i", nothing counted, with 1 - sum_j x_ij. The mean of the mixture is p_ij +
/// (x_ij - p_ij sum_l x_il) / (A + 1), which is the estimator of the paper. The paper counts one
/// more observation of every row in every step; here the Dirichlet distribution that approximates
/// the mixture also matches its total variance, so that uninformative data change nothing.
///
/// Beyond the paper: rows are kept as rates (JumpCounts), so that steps of all lengths have the
/// same effect; what was learned decays toward the prior; rates are bounded.
class TransitionModel {
 public:
  TransitionModel(const JumpCounts& prior, const TransitionLearningOptions& options);

  /// Decays over a step of `seconds` >= 0, and returns the transition matrix of that step.
  const ModeMatrix& predict(double seconds);

  /// Learns from the measurement at the end of the last predicted step. `before`: mode
  /// probabilities at its start; `likelihoods`: of the measurement given each mode, 0 or more and
  /// not all 0, in any unit. `stop_shares`, 0 to 1, by the previous mode, 1 for standing: the share
  /// of jumps into the standing mode that the object's speed allows; for the rest it kept its mode.
  void update(const ModeVector& before, const ModeVector& likelihoods,
              const ModeVector& stop_shares = ModeVector::Ones());

  /// Replaces the prior, as when the class becomes known; what was learned is kept.
  void setPrior(const JumpCounts& prior);

  /// Returns what this target has shown beyond its prior; may be negative.
  const JumpCounts& learned() const { return learned_; }
  JumpCounts counts() const;

 private:
  void updateRow(JumpCounts& counts, int from, const ModeVector& joint) const;

  TransitionLearningOptions options_;
  JumpCounts prior_;
  JumpCounts learned_;
  bool learns_ = false;  ///< false: nothing was learned yet
  ModeMatrix matrix_ = ModeMatrix::Identity();
  double seconds_ = 0.0;
};

/// The jumps that the targets of each class have shown, as the prior of new targets. Starts from
/// the sojourn times.
class TransitionPriors {
 public:
  explicit TransitionPriors(const TransitionOptions& options);

  /// Returns the model of a new target, or one whose class has become known; none if not adaptive.
  std::optional<TransitionModel> modelOf(ObjectClass object_class) const;

  /// Returns the counts of a class, with at most the weight of learning/prior_exposure, so that a
  /// target can deviate.
  JumpCounts of(ObjectClass object_class) const;

  /// Learns from a target, once, at its end. The jumps of all classes are also the prior of the
  /// unknown class.
  void learn(ObjectClass object_class, const TransitionModel& target);

 private:
  void add(ObjectClass object_class, const JumpCounts& learned);

  TransitionOptions options_;
  JumpCounts sojourns_;
  std::array<JumpCounts, kObjectClasses> classes_;
};

}  // namespace datmo
