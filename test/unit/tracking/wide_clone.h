// SPDX-License-Identifier: BSD-3-Clause
// The wide functions (common/wide.h) compiled for one processor only, and wideResults() with them.
// Included once by a file that defines DATMO_FUSION_WIDE as that processor's attribute and `datmo`
// as a name of its own, so that both may be in one program.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "imm_moments.cpp"
#include "kalman_filter.cpp"
#include "wide_results.h"

namespace datmo {

namespace {

/// Numbers of the magnitude of tracks' states, and valid covariances.
class RandomStates {
 public:
  explicit RandomStates(std::uint32_t seed) : generator_(seed) {}

  double number(double sigma) { return sigma * normal_(generator_); }

  TrackCovariance covariance() {
    TrackCovariance root;
    for (int i = 0; i < root.size(); ++i) {
      root.data()[i] = number(1.0);
    }
    return root * root.transpose() + 0.1 * TrackCovariance::Identity();
  }

  StateEstimate estimate() {
    StateEstimate result;
    for (int i = 0; i < kTrackState; ++i) {
      result.mean[i] = number(30.0);
    }
    result.covariance = covariance();
    return result;
  }

  /// As predict() expects it: positions change by the rest, which they do not affect.
  LinearMotion motion() {
    LinearMotion result;
    result.transition.setIdentity();
    for (int column = 2; column < kTrackState; ++column) {
      for (int row = 0; row < kTrackState; ++row) {
        result.transition(row, column) += number(0.3);
      }
    }
    result.noise = covariance();
    return result;
  }

  /// The second mode is impossible.
  ModeVector probabilities() {
    ModeVector result;
    for (int mode = 0; mode < kMotionModes; ++mode) {
      result[mode] = mode == 1 ? 0.0 : 0.05 + std::abs(number(1.0));
    }
    return result / result.sum();
  }

 private:
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
};

template <typename Numbers>
void append(const Numbers& numbers, std::vector<double>& results) {
  results.insert(results.end(), numbers.data(), numbers.data() + numbers.size());
}

void append(const StateEstimate& estimate, std::vector<double>& results) {
  append(estimate.mean, results);
  append(estimate.covariance, results);
}

}  // namespace

std::vector<double> wideResults(std::uint32_t seed) {
  RandomStates random(seed);
  std::vector<double> results;
  const StateEstimate before = random.estimate();
  append(predict(before, random.motion()), results);

  ModeEstimates modes;
  for (StateEstimate& mode : modes) {
    mode = random.estimate();
  }
  const ModeVector probabilities = random.probabilities();
  ModeMatrix weights;
  for (int mode = 0; mode < kMotionModes; ++mode) {
    weights.col(mode) = random.probabilities();
  }
  const TrackState origin = modes.front().mean;
  ModeMoments moments;
  momentsAbout(origin, modes, probabilities, moments);
  append(moments, results);
  ModeMoments mixed;
  mix(moments, weights, mixed);
  append(mixed, results);
  for (int mode = 0; mode < kMotionModes; ++mode) {
    StateEstimate estimate;
    estimateOf(origin, mixed, mode, estimate);
    append(estimate, results);
  }
  StateEstimate all;
  mixture(origin, modes, probabilities, all);
  append(all, results);
  return results;
}

}  // namespace datmo
