// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/range_bearing.h"

namespace datmo {

/// A sensor's position accuracy as a function of range. Empty lists: the object's own covariance is
/// used.
struct PositionCovarianceOptions {
  double bin_width = 2.0;                ///< m
  std::vector<double> range_variance;    ///< m^2, by range bin
  std::vector<double> bearing_variance;  ///< rad^2, by range bin

  void visit(OptionVisitor& visitor);

  bool empty() const { return range_variance.empty(); }

  /// Throws OptionError, with `name` before the names of the options, unless both lists have the
  /// same length.
  void check(const std::string& name) const;

  /// Returns the covariance, m^2, at a position (m) relative to a sensor, both in one frame, by its
  /// range bin; beyond the last bin, that of the last. Throws std::out_of_range for empty lists.
  Eigen::Matrix2d at(const Point2& position, const Point2& sensor) const;
};

}  // namespace datmo
