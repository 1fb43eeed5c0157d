// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/transition_model.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// Minimum weight of a row, as a share of its prior's.
constexpr double kMinWeight = 0.1;

/// For a step so long that a mode is hardly ever kept, rates cannot be estimated.
constexpr double kMinKept = 1e-3;

JumpCounts operator+(const JumpCounts& a, const JumpCounts& b) {
  return {a.jumps + b.jumps, a.exposure + b.exposure};
}

JumpCounts operator-(const JumpCounts& a, const JumpCounts& b) {
  return {a.jumps - b.jumps, a.exposure - b.exposure};
}

/// Disabled modes have a sojourn time of 0.
ModeVector sojournTimes(const TransitionOptions& options) {
  ModeVector times;
  times << options.straight_sojourn, options.accelerating_sojourn, options.turn_sojourn,
      options.turn_sojourn, options.standing ? options.standing_sojourn : 0.0;
  return times;
}

/// Clamps a row to its bounds: each jump to its minimum share, their sum to the bounds of the
/// sojourn time. Jumps that the prior excludes stay impossible, and a row with hardly any weight
/// left is reset to the prior.
void boundRow(JumpCounts& counts, int from, const JumpCounts& prior,
              const TransitionLearningOptions& options) {
  if (counts.exposure[from] < kMinWeight * prior.exposure[from]) {
    counts.exposure[from] = prior.exposure[from];
    counts.jumps.row(from) = prior.jumps.row(from);
  }
  const double min = counts.exposure[from] / options.max_sojourn;
  // If the bounds contradict each other, max_sojourn takes precedence.
  const double max = std::max(min, counts.exposure[from] / options.min_sojourn);
  const double floor = options.min_share * std::max(counts.jumps.row(from).sum(), min);
  for (int to = 0; to < kMotionModes; ++to) {
    double& jumps = counts.jumps(from, to);
    jumps = prior.jumps(from, to) > 0.0 ? std::max(jumps, floor) : 0.0;
  }
  const double sum = counts.jumps.row(from).sum();
  if (sum > 0.0) {
    counts.jumps.row(from) *= std::clamp(sum, min, max) / sum;
  }
}

/// The counts with the exposure of each row limited to this (s).
JumpCounts limited(JumpCounts counts, double max_exposure) {
  const ModeVector factor = (max_exposure / counts.exposure.array()).min(1.0);
  return {factor.asDiagonal() * counts.jumps, factor.cwiseProduct(counts.exposure)};
}

/// 1 - sum p_j^2: the total variance of a Dirichlet distribution is this over its strength + 1.
double spreadOf(const ModeVector& mean) { return (mean.array() * (1.0 - mean.array())).sum(); }

/// Strength of the Dirichlet distribution of mean `next` with the total variance of the mixture of
/// Dir(strength mean + e_j) with weights (mean + change)_j. Sum of variances of the mixture, from
/// the second moments of its parts: spread / (A + 1) - 4 c'p / ((A + 1) (A + 2)) - c'c / (A + 1)^2.
double strengthAfter(const ModeVector& mean, const ModeVector& change, double strength,
                     const ModeVector& next) {
  const double variance = spreadOf(mean) - 4.0 * change.dot(mean) / (strength + 2.0) -
                          change.squaredNorm() / (strength + 1.0);
  return (strength + 1.0) * spreadOf(next) / variance - 1.0;
}

}  // namespace

void TransitionLearningOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kExposure{1.0, 1e5};
  visitor.number({"prior_exposure", "s",
                  "weight of the prior of a target's transition probabilities, as equivalent time "
                  "in each mode"},
                 prior_exposure, kExposure);
  visitor.number({"class_exposure", "s",
                  "maximum time in each mode that a class remembers; older targets fade"},
                 class_exposure, kExposure);
  visitor.number(
      {"forgetting", "s", "time constant with which a target forgets the transitions it has made"},
      forgetting, {0.1, 1e6});
  visitor.number({"min_sojourn", "s", "no mode lasts less on average, whatever is learned"},
                 min_sojourn, {0.01, 10.0});
  visitor.number({"max_sojourn", "s", "no mode lasts longer on average, whatever is learned"},
                 max_sojourn, {1.0, 1e6});
  visitor.number({"min_share", "1", "minimum share of each other mode in the jumps from a mode"},
                 min_share, {0.0, 0.2});
}

void TransitionOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kSojourn{0.1, 1000.0};
  visitor.number({"straight_sojourn", "s", "how long an object keeps its velocity, on average"},
                 straight_sojourn, kSojourn);
  visitor.number({"accelerating_sojourn", "s", "how long it accelerates or brakes, on average"},
                 accelerating_sojourn, kSojourn);
  visitor.number({"turn_sojourn", "s", "how long it turns, on average"}, turn_sojourn, kSojourn);
  visitor.number({"standing_sojourn", "s", "how long it is stationary, on average"},
                 standing_sojourn, kSojourn);
  visitor.toggle({"standing", "", "whether standing is a mode; false: the four of thesis 3.3.4"},
                 standing);
  visitor.toggle({"adaptive", "",
                  "whether the transition probabilities are learned while tracking (thesis 3.3.4; "
                  "Jilkov & Li 2004); false: they follow from the sojourn times alone"},
                 adaptive);
  visitor.group("learning", [&] { learning.visit(visitor); });
}

JumpCounts countsOfSojourns(const TransitionOptions& options) {
  const ModeVector sojourn = sojournTimes(options);
  const ModeVector used = (sojourn.array() > 0.0).cast<double>();
  JumpCounts counts;
  counts.exposure.setConstant(options.learning.prior_exposure);
  for (int from = 0; from < kMotionModes; ++from) {
    if (sojourn[from] > 0.0) {
      const double jumps = counts.exposure[from] / sojourn[from];
      counts.jumps.row(from) = used.transpose() * (jumps / (used.sum() - 1.0));
      counts.jumps(from, from) = 0.0;
    }
  }
  return counts;
}

ModeVector priorModeProbabilities(const TransitionOptions& options) {
  const ModeVector sojourn = sojournTimes(options);
  return sojourn / sojourn.sum();
}

ModeMatrix transitionMatrix(const JumpCounts& counts, double seconds) {
  ModeMatrix matrix = counts.jumps;
  for (int from = 0; from < kMotionModes; ++from) {
    const double jumps = counts.jumps.row(from).sum();
    if (jumps > 0.0) {
      const double left = -std::expm1(-seconds * jumps / counts.exposure[from]);
      matrix.row(from) *= left / jumps;
      matrix(from, from) = 1.0 - left;
    } else {
      matrix(from, from) = 1.0;
    }
  }
  return matrix;
}

TransitionModel::TransitionModel(const JumpCounts& prior, const TransitionLearningOptions& options)
    : options_(options), prior_(prior) {}

JumpCounts TransitionModel::counts() const { return prior_ + learned_; }

void TransitionModel::setPrior(const JumpCounts& prior) {
  JumpCounts all = prior + learned_;
  for (int from = 0; from < kMotionModes; ++from) {
    boundRow(all, from, prior, options_);
  }
  prior_ = prior;
  learned_ = all - prior;
  learns_ = true;
}

const ModeMatrix& TransitionModel::predict(double seconds) {
  if (!learns_) {  // only the prior, and most sensors have a constant period
    matrix_ = seconds == seconds_ ? matrix_ : transitionMatrix(prior_, seconds);
    seconds_ = seconds;
    return matrix_;
  }
  const double kept = std::exp(-seconds / options_.forgetting);
  learned_.jumps *= kept;
  learned_.exposure *= kept;
  matrix_ = transitionMatrix(counts(), seconds);
  seconds_ = seconds;
  return matrix_;
}

void TransitionModel::update(const ModeVector& before, const ModeVector& likelihoods,
                             const ModeVector& stop_shares) {
  if (seconds_ <= 0.0) {
    return;
  }
  constexpr int kStanding = static_cast<int>(MotionMode::kStanding);
  const ModeVector stops = before.cwiseProduct(matrix_.col(kStanding));
  ModeMatrix joint = before.asDiagonal() * matrix_ * likelihoods.asDiagonal();
  joint.col(kStanding) =
      stops.cwiseProduct(likelihoods[kStanding] * stop_shares +
                         likelihoods.cwiseProduct(ModeVector::Ones() - stop_shares));
  const double evidence = joint.sum();
  if (!(evidence > 0.0)) {
    return;  // below double precision
  }
  JumpCounts all = counts();
  for (int from = 0; from < kMotionModes; ++from) {
    updateRow(all, from, joint.row(from).transpose() / evidence);
  }
  learned_ = all - prior_;
  learns_ = true;
}

/// `joint`: probabilities that the mode was `from` and is each of the modes now.
void TransitionModel::updateRow(JumpCounts& counts, int from, const ModeVector& joint) const {
  const ModeVector mean = matrix_.row(from).transpose();
  if (mean[from] < kMinKept || mean[from] >= 1.0) {
    return;
  }
  const double strength = counts.exposure[from] / seconds_;
  const ModeVector change = joint - mean * joint.sum();
  const ModeVector next = mean + change / (strength + 1.0);
  const double next_strength = strengthAfter(mean, change, strength, next);

  const double left = next.sum() - next[from];
  counts.exposure[from] = next_strength * seconds_;
  counts.jumps.row(from) = next.transpose() * (-std::log1p(-left) * next_strength / left);
  counts.jumps(from, from) = 0.0;
  boundRow(counts, from, prior_, options_);
}

TransitionPriors::TransitionPriors(const TransitionOptions& options)
    : options_(options), sojourns_(countsOfSojourns(options)) {
  classes_.fill(sojourns_);
}

std::optional<TransitionModel> TransitionPriors::modelOf(ObjectClass object_class) const {
  if (!options_.adaptive) {
    return std::nullopt;
  }
  return TransitionModel(of(object_class), options_.learning);
}

JumpCounts TransitionPriors::of(ObjectClass object_class) const {
  return limited(classes_[static_cast<std::size_t>(object_class)],
                 options_.learning.prior_exposure);
}

void TransitionPriors::learn(ObjectClass object_class, const TransitionModel& target) {
  add(object_class, target.learned());
  if (object_class != ObjectClass::kUnknown) {
    add(ObjectClass::kUnknown, target.learned());
  }
}

void TransitionPriors::add(ObjectClass object_class, const JumpCounts& learned) {
  JumpCounts& counts = classes_[static_cast<std::size_t>(object_class)];
  counts = counts + learned;
  for (int from = 0; from < kMotionModes; ++from) {
    boundRow(counts, from, sojourns_, options_.learning);
  }
  counts = limited(counts, options_.learning.class_exposure);
}

}  // namespace datmo
