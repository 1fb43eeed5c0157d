// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>

#include "datmo_fusion/tracking/imm_filter.h"

namespace datmo::samples {

constexpr double kPeriod = 0.1;  ///< s
constexpr double kSigma = 0.1;   ///< m, of the measurements

inline StateEstimate startAt(const Point2& position) {
  StateEstimate start;
  start.mean.head<2>() = position;
  start.covariance.diagonal() << 0.01, 0.01, 64.0, 64.0, 0.25, 0.25;
  return start;
}

/// Tracks a path (m, by time in s) with noisy measurements for `seconds`.
inline ImmFilter follow(const std::function<Point2(double)>& path, double seconds,
                        const ImmOptions& options = ImmOptions(), std::uint64_t seed = 23) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, kSigma);
  ImmFilter filter(startAt(path(0.0)), priorModeProbabilities(options));
  const ImmStep step = immStep(options, kPeriod);
  for (double time = kPeriod; time < seconds; time += kPeriod) {
    filter.predict(step);
    const double aside =
        noise(engine);  // first, whatever a compiler's evaluation order of arguments
    const Point2 seen = path(time) + Point2(noise(engine), aside);
    filter.update(PositionMeasurement{seen, Eigen::Matrix2d::Identity() * kSigma * kSigma},
                  options.outlier_probability);
  }
  return filter;
}

}  // namespace datmo::samples
