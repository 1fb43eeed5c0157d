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

/// How the learning of jumps is held in check.
struct TransitionLearningOptions {
  double prior_exposure = 20.0;   ///< s
  double class_exposure = 300.0;  ///< s
  double forgetting = 60.0;       ///< s
  double min_sojourn = 0.3;       ///< s
  double max_sojourn = 300.0;     ///< s
  double min_share = 0.02;

  void visit(OptionVisitor& visitor);
};

/// How objects change between the motion modes.
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

/// What is known of the jumps between modes, as if it had been counted. Counts of independent
/// observations add up. The rate of jumps from mode i to mode j is jumps(i, j) / exposure[i].
struct JumpCounts {
  ModeMatrix jumps = ModeMatrix::Zero();     ///< 1; row: from, column: to; diagonal 0
  ModeVector exposure = ModeVector::Zero();  ///< s, in each mode; more than 0 to be of use
};

/// What the sojourn times say, with the weight of learning/prior_exposure: a mode is left to the
/// others in equal shares. A mode that is not in use is neither entered nor left.
JumpCounts countsOfSojourns(const TransitionOptions& options);

/// Probabilities of the modes of an object of which nothing is known: each by its share of time.
ModeVector priorModeProbabilities(const TransitionOptions& options);

/// Probabilities of the mode (column) that follows each mode (row) after `seconds` >= 0: mode i is
/// kept with exp(-seconds / sojourn_i), and left in the shares of its jumps. Rows sum to 1,
/// whatever the step; more than one jump within a step is not thought of.
ModeMatrix transitionMatrix(const JumpCounts& counts, double seconds);

/// The transition probabilities of one target, learned while it is followed: the quasi-Bayesian
/// estimator of Jilkov and Li, Online Bayesian Estimation of Transition Probabilities for Markovian
/// Jump Systems, IEEE Trans. Signal Processing 52(6), 2004, for time steps that vary.
///
/// Row i of the matrix P has a Dirichlet distribution of strength A = exposure_i / seconds and mean
/// p_i. With mode probabilities m before the step and mode likelihoods L after it, the data have
/// the likelihood m' P L, which is linear in each row. By Bayes the row is therefore the mixture of
/// "it jumped to j", one more count of j, with the weights x_ij = m_i p_ij L_j / (m' P L), and of
/// "it was not in mode i", nothing counted, with 1 - sum_j x_ij. The mean of the mixture is p_ij +
/// (x_ij - p_ij sum_l x_il) / (A + 1), which is the estimator of the paper. The paper counts one
/// more observation of every row in every step; here the Dirichlet distribution that stands for the
/// mixture has its total variance too, so that uninformative data change nothing.
///
/// Beyond the paper: rows are kept as rates (JumpCounts), so that steps of all lengths teach the
/// same; what was learned fades toward the prior; no rate leaves its bounds.
class TransitionModel {
 public:
  TransitionModel(const JumpCounts& prior, const TransitionLearningOptions& options);

  /// Forgets over a step of `seconds` >= 0, and returns the matrix of that step.
  const ModeMatrix& predict(double seconds);

  /// Learns from what was seen at the end of the step that was predicted last. `before`: mode
  /// probabilities at its start; `likelihoods`: of the measurement given each mode, 0 or more and
  /// not all 0, in any unit. `stop_shares`, 0 to 1, by the mode before, 1 for standing: of the
  /// jumps into the standing mode, those possible by the object's speed; in the others it kept its
  /// mode.
  void update(const ModeVector& before, const ModeVector& likelihoods,
              const ModeVector& stop_shares = ModeVector::Ones());

  /// Exchanges the prior, as when the class becomes known; what was learned stays.
  void setPrior(const JumpCounts& prior);

  /// What this target has shown by itself, beyond its prior; may be negative.
  const JumpCounts& learned() const { return learned_; }
  JumpCounts counts() const;

 private:
  void updateRow(JumpCounts& counts, int from, const ModeVector& joint) const;

  TransitionLearningOptions options_;
  JumpCounts prior_;
  JumpCounts learned_;
  bool learns_ = false;  ///< false: nothing was learned as yet
  ModeMatrix matrix_ = ModeMatrix::Identity();
  double seconds_ = 0.0;
};

/// What the targets of each class have shown of their jumps: the prior of the next ones. Starts
/// from the sojourn times.
class TransitionPriors {
 public:
  explicit TransitionPriors(const TransitionOptions& options);

  /// For a new target, or one whose class has become known; none where nothing is to be adapted.
  std::optional<TransitionModel> modelOf(ObjectClass object_class) const;

  /// The counts of a class with no more than the weight of learning/prior_exposure, so that a
  /// target can deviate.
  JumpCounts of(ObjectClass object_class) const;

  /// Takes in what a target has shown; once, at its end. What any class shows is also the prior of
  /// the unknown class.
  void learn(ObjectClass object_class, const TransitionModel& target);

 private:
  void add(ObjectClass object_class, const JumpCounts& learned);

  TransitionOptions options_;
  JumpCounts sojourns_;
  std::array<JumpCounts, kObjectClasses> classes_;
};

}  // namespace datmo
