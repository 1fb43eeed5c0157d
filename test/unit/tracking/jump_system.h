// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "datmo_fusion/tracking/imm_filter.h"

namespace datmo {

/// An object that moves by the motion models and jumps between them by a known matrix, and its
/// measurements. Seeded.
class JumpSystem {
 public:
  static constexpr double kPositionSigma = 0.1;  // m

  /// Starts with a velocity of 5 m/s in each component, in one of the modes by
  /// `mode_probabilities`.
  JumpSystem(std::uint64_t seed, const ModeVector& mode_probabilities) : engine_(seed) {
    truth_ = drawn(start().covariance);
    mode_ = drawnMode(mode_probabilities);
  }

  /// What a filter may know at the start.
  static StateEstimate start() {
    StateEstimate start;
    start.covariance.diagonal() << 0.01, 0.01, 25.0, 25.0, 0.25, 0.25;
    return start;
  }

  /// One step with the motions of `step`, and jumps by `transition`.
  void move(const ImmStep& step, const ModeMatrix& transition) {
    const int before = mode_;
    mode_ = drawnMode(transition.row(mode_).transpose());
    if (mode_ == kStanding && before != kStanding && !isSlow(step)) {
      mode_ = before;
    }
    if (before == kStanding && mode_ != kStanding) {
      truth_ += drawn(step.start_variance.asDiagonal());
    }
    const LinearMotion& motion = step.motions[static_cast<std::size_t>(mode_)];
    truth_ = motion.transition * truth_ + drawn(motion.noise);
  }

  PositionMeasurement measure() {
    const Point2 noise(normal_(engine_), normal_(engine_));
    return {truth_.head<2>() + kPositionSigma * noise,
            kPositionSigma * kPositionSigma * Eigen::Matrix2d::Identity()};
  }

  const TrackState& truth() const { return truth_; }
  int mode() const { return mode_; }

 private:
  static constexpr int kStanding = static_cast<int>(MotionMode::kStanding);

  TrackState drawn(const TrackCovariance& covariance) {
    // The semi-definite noise of a short step is not safe for LLT.
    const Eigen::SelfAdjointEigenSolver<TrackCovariance> solver(covariance);
    TrackState values;
    for (int i = 0; i < kTrackState; ++i) {
      values[i] = std::sqrt(std::max(0.0, solver.eigenvalues()[i])) * normal_(engine_);
    }
    return solver.eigenvectors() * values;
  }

  /// Returns whether it may stop: the slower it is, the more often.
  bool isSlow(const ImmStep& step) {
    const double squared = truth_.segment<2>(2).squaredNorm() / step.stop_variance;
    return std::generate_canonical<double, 53>(engine_) < std::exp(-0.5 * squared);
  }

  int drawnMode(const ModeVector& probabilities) {
    std::discrete_distribution<int> pick(probabilities.data(), probabilities.data() + kMotionModes);
    return pick(engine_);
  }

  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  TrackState truth_;
  int mode_ = 0;
};

/// Normalized squared error of position and velocity: 4 on average where the filter is consistent.
inline double normalizedError(const TrackState& truth, const StateEstimate& estimate) {
  const Eigen::Vector4d error = (truth - estimate.mean).head<4>();
  const Eigen::Matrix4d covariance = estimate.covariance.topLeftCorner<4, 4>();
  return error.dot(covariance.ldlt().solve(error));
}

/// Mean of independent values, and its 95 % confidence bound.
struct SampleMean {
  double mean = 0.0;
  double bound = 0.0;

  explicit SampleMean(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    double squares = 0.0;
    for (const double value : values) {
      mean += value / count;
    }
    for (const double value : values) {
      squares += (value - mean) * (value - mean);
    }
    bound = 1.96 * std::sqrt(squares / (count - 1.0) / count);
  }
};

}  // namespace datmo
