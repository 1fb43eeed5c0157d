// SPDX-License-Identifier: BSD-3-Clause
// Fixed versus adaptive transition probabilities on objects that jump between the modes by a known
// matrix. Both filters see the same objects, so that their errors are compared in pairs.
#include <array>
#include <cmath>
#include <vector>

#include "jump_system.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/imm_filter.h"

namespace datmo::imm_adaptation_test {
namespace {

constexpr int kTargets = 240;  // of one class, one after the other
constexpr int kTaught = 80;    // of them before the comparison starts
constexpr int kWarmUp = 10;    // steps until the velocity is known
constexpr int kCounted = 190;  // steps, each target
constexpr double kMinProbability = 1e-3;

struct Comparison {
  std::vector<double> fixed_velocity;       ///< mean squared error of each target, m^2/s^2
  std::vector<double> velocity_change;      ///< the same, adaptive less fixed
  std::vector<double> fixed_normalized;     ///< see normalizedError
  std::vector<double> adaptive_normalized;  ///< the same
  JumpCounts learned;
};

/// Mean errors of one filter over the life of one target.
struct Errors {
  double velocity = 0.0;
  double normalized = 0.0;

  void add(const TrackState& truth, const StateEstimate& estimate) {
    velocity += (truth - estimate.mean).segment<2>(2).squaredNorm() / kCounted;
    normalized += normalizedError(truth, estimate) / kCounted;
  }
};

/// Time steps of an irregular sensor.
double secondsOf(int step) { return step % 3 == 0 ? 0.16 : 0.07; }

/// Both filters track the same object.
std::array<Errors, 2> follow(std::array<ImmFilter, 2>& filters, JumpSystem& object,
                             const ImmOptions& options, const JumpCounts& truth) {
  std::array<Errors, 2> errors;
  for (int i = 0; i < kWarmUp + kCounted; ++i) {
    const ImmStep step = immStep(options, secondsOf(i));
    object.move(step, transitionMatrix(truth, step.seconds));
    const PositionMeasurement seen = object.measure();
    for (std::size_t filter = 0; filter < filters.size(); ++filter) {
      filters[filter].predict(step);
      filters[filter].update(seen, kMinProbability);
      if (i >= kWarmUp) {
        errors[filter].add(object.truth(), filters[filter].estimate());
      }
    }
  }
  return errors;
}

/// The filters initially assume the default sojourn times.
Comparison compare(const JumpCounts& truth) {
  ImmOptions options;
  options.transitions.adaptive = true;
  const ModeVector modes = priorModeProbabilities(options);
  TransitionPriors priors(options.transitions);
  Comparison result;
  for (int target = 0; target < kTargets; ++target) {
    JumpSystem object(static_cast<std::uint64_t>(1000 + target), modes);
    std::array<ImmFilter, 2> filters{
        ImmFilter(JumpSystem::start(), modes),
        ImmFilter(JumpSystem::start(), modes, priors.modelOf(ObjectClass::kVehicle))};
    const auto [fixed, adaptive] = follow(filters, object, options, truth);
    priors.learn(ObjectClass::kVehicle, *filters[1].transitions());
    if (target >= kTaught) {
      result.fixed_velocity.push_back(fixed.velocity);
      result.velocity_change.push_back(adaptive.velocity - fixed.velocity);
      result.fixed_normalized.push_back(fixed.normalized);
      result.adaptive_normalized.push_back(adaptive.normalized);
    }
  }
  result.learned = priors.of(ObjectClass::kVehicle);
  return result;
}

JumpCounts assumed() { return countsOfSojourns(TransitionOptions()); }

/// Objects that change much more often than assumed, and that mostly turn left.
JumpCounts restlessLeftTurners() {
  TransitionOptions options;
  options.straight_sojourn = 3.0;
  options.accelerating_sojourn = 1.0;
  options.turn_sojourn = 6.0;
  options.standing_sojourn = 4.0;
  JumpCounts counts = countsOfSojourns(options);
  const double jumps = counts.jumps.row(0).sum();
  counts.jumps.row(0) << 0.0, 0.1 * jumps, 0.8 * jumps, 0.05 * jumps, 0.05 * jumps;
  return counts;
}

/// Distance of two matrices as one step of 0.1 s shows them: mean Kullback-Leibler divergence of
/// the rows from the true ones.
double divergence(const JumpCounts& truth, const JumpCounts& estimate) {
  const ModeMatrix p = transitionMatrix(truth, 0.1);
  const ModeMatrix q = transitionMatrix(estimate, 0.1);
  return (p.array() * (p.array() / q.array()).log()).sum() / kMotionModes;
}

TEST(ImmAdaptation, WrongTransitionsAreLearnedAndErrorsShrink) {
  const JumpCounts truth = restlessLeftTurners();
  const Comparison result = compare(truth);
  EXPECT_LT(divergence(truth, result.learned), 0.5 * divergence(truth, assumed()));

  const SampleMean change(result.velocity_change);
  EXPECT_LT(change.mean + change.bound, 0.0) << "not better with 95 %";
  const SampleMean fixed(result.fixed_normalized);
  const SampleMean adaptive(result.adaptive_normalized);
  EXPECT_LT(std::abs(adaptive.mean - 4.0), std::abs(fixed.mean - 4.0));
  EXPECT_NEAR(adaptive.mean, 4.0, adaptive.bound);
}

TEST(ImmAdaptation, RightTransitionsAreKeptAndErrorsDoNotGrow) {
  const Comparison result = compare(assumed());
  EXPECT_LT(divergence(assumed(), result.learned),
            0.1 * divergence(restlessLeftTurners(), assumed()));

  // No more than 1 % of the squared error may be lost, with 95 % confidence.
  const SampleMean change(result.velocity_change);
  EXPECT_LT(change.mean + change.bound, 0.01 * SampleMean(result.fixed_velocity).mean);
  const SampleMean adaptive(result.adaptive_normalized);
  EXPECT_NEAR(adaptive.mean, 4.0, adaptive.bound);
}

}  // namespace
}  // namespace datmo::imm_adaptation_test
