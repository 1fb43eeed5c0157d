// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "evaluate/matching.h"
#include <Eigen/Cholesky>

namespace datmo::evaluation {

/// Consistency of the covariances. The normalized estimation error squared, e^T P^-1 e, of a
/// consistent filter is chi-square distributed with the error's dimension as degrees of freedom
/// (Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001,
/// section 5.4). Above the bounds the filter is overconfident, below them it is conservative.
struct Consistency {
  std::optional<double> mean_nees;  ///< none: no sample
  /// The mean of a consistent filter is between them with a probability of 95 %, if its samples are
  /// independent. Those of one track are not entirely independent: the true interval is somewhat
  /// wider.
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<double> inside_share;  ///< samples below the 95 % quantile of a single one
  std::size_t samples = 0;
  std::size_t unusable = 0;  ///< covariances that are not positive definite; no samples
  int degrees_of_freedom = 0;
};

struct TrackConsistency {
  Consistency position;  ///< x and y
  Consistency velocity;  ///< vx and vy
};

/// Quantile of the chi-square distribution; `probability` in (0, 1), degrees of freedom above 0.
double chiSquareQuantile(double probability, double degrees_of_freedom);

/// e^T P^-1 e of one error; none: the covariance is not positive definite.
template <int dimension>
std::optional<double> normalizedErrorSquared(
    const Eigen::Matrix<double, dimension, 1>& error,
    const Eigen::Matrix<double, dimension, dimension>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, dimension, dimension>> factors(covariance);
  const double result = error.dot(factors.solve(error));
  const bool usable = factors.info() == Eigen::Success && std::isfinite(result);
  return usable ? std::optional<double>(result) : std::nullopt;
}

/// Collects the errors of one quantity with this number of components.
class NeesSum {
 public:
  explicit NeesSum(int degrees_of_freedom);

  /// None: counted as unusable.
  void add(const std::optional<double>& nees);
  Consistency result() const;

 private:
  int degrees_of_freedom_;
  double limit_;
  double sum_ = 0.0;
  std::size_t inside_ = 0;
  std::size_t samples_ = 0;
  std::size_t unusable_ = 0;
};

/// Of the tracks that are matched to required truths. `matching` is of these frames.
TrackConsistency scoreConsistency(const Frames& frames, const Matching& matching);

}  // namespace datmo::evaluation
