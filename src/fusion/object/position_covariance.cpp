// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/position_covariance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace datmo {

namespace {

/// A covariance must be positive definite.
constexpr Bounds kVariance{1e-9, 1e6};

}  // namespace

void PositionCovarianceOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"bin_width", "m", "width of the range bins of both lists, starting at 0 (thesis 3.3.3)"},
      bin_width, {0.1, 100.0});
  visitor.numbers({"range_variance", "m^2",
                   "variance of an object's range from this sensor, by range bin; empty: each "
                   "object's own covariance is used"},
                  range_variance, kVariance);
  visitor.numbers({"bearing_variance", "rad^2",
                   "variance of an object's bearing about this sensor, by range bin"},
                  bearing_variance, kVariance);
}

void PositionCovarianceOptions::check(const std::string& name) const {
  if (range_variance.size() != bearing_variance.size()) {
    throw OptionError(name + "/bearing_variance has " + std::to_string(bearing_variance.size()) +
                      " numbers: expected as many as range_variance has, " +
                      std::to_string(range_variance.size()));
  }
}

Eigen::Matrix2d PositionCovarianceOptions::at(const Point2& position, const Point2& sensor) const {
  const Point2 line = position - sensor;
  const double last = static_cast<double>(range_variance.size()) - 1.0;
  const double bin = std::min(std::floor(line.norm() / bin_width), last);
  const auto i = static_cast<std::size_t>(std::max(bin, 0.0));
  return rangeBearingCovariance(line, range_variance.at(i), bearing_variance.at(i));
}

}  // namespace datmo
