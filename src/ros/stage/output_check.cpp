// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/output_check.h"

#include <algorithm>
#include <utility>

#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/physical_bounds.h"

namespace datmo {

namespace {

/// Negative eigenvalues of a matrix of correlations, for each of its rows: rounding error of sums
/// of doubles.
constexpr double kRounding = 1e-6;

/// Variances that are smaller relative to the largest one are mere rounding errors.
constexpr double kMinVarianceRatio = 1e-9;

/// s, ahead of the newest input: results refer to measurements, not to the future.
constexpr double kMaxAhead = 1.0;

}  // namespace

bool isCovariance(const double* values, std::size_t size) {
  const auto rows = static_cast<Eigen::Index>(size);
  const Eigen::Map<const Eigen::MatrixXd> matrix(values, rows, rows);
  const double largest = matrix.diagonal().maxCoeff();
  if (!matrix.allFinite() || largest <= 0.0) {
    return matrix.isZero(0.0);
  }
  // Correlations have no units, in which the elements differ: a large variance of one quantity must
  // not hide what is wrong with the others.
  const Eigen::VectorXd scale =
      matrix.diagonal().cwiseMax(kMinVarianceRatio * largest).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlations = scale.asDiagonal() * matrix * scale.asDiagonal();
  if ((correlations - correlations.transpose()).cwiseAbs().maxCoeff() > kMaxAsymmetry) {
    return false;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlations, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() >= -kRounding * static_cast<double>(size);
}

OutputCheck::OutputCheck(std::string topic, StageMonitor& monitor)
    : topic_(std::move(topic)), monitor_(monitor) {}

bool OutputCheck::passes(const OutputContent& content) {
  if (resets_ != monitor_.resetCount()) {
    resets_ = monitor_.resetCount();
    newest_.reset();
  }
  const std::string fault = faultOf(content);
  if (!fault.empty()) {
    monitor_.dropped(InputError(
        "bad_output", "would publish on " + topic_ + " " + fault + ": drops it and starts over"));
    monitor_.requestReset();
    return false;
  }
  newest_ = content.stamp ? content.stamp : newest_;
  return true;
}

std::string OutputCheck::faultOf(const OutputContent& content) const {
  if (!content.fault.empty()) {
    return content.fault;
  }
  if (newest_ && content.stamp && *content.stamp < *newest_) {
    return "the stamp " + std::to_string(content.stamp->seconds()) + " s after " +
           std::to_string(newest_->seconds()) + " s";
  }
  const std::optional<Stamp>& input = monitor_.newestInput();
  if (input && content.stamp && secondsBetween(*input, *content.stamp) > kMaxAhead) {
    return "the stamp " + std::to_string(content.stamp->seconds()) +
           " s while its newest input has the stamp " + std::to_string(input->seconds()) + " s";
  }
  return "";
}

}  // namespace datmo
