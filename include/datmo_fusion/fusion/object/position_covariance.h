// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/range_bearing.h"

namespace datmo {

/// How well a sensor measures where an object is, by the object's range. Empty lists: as the object
/// itself says.
struct PositionCovarianceOptions {
  double bin_width = 2.0;                ///< m
  std::vector<double> range_variance;    ///< m^2, by range bin
  std::vector<double> bearing_variance;  ///< rad^2, by range bin

  void visit(OptionVisitor& visitor);

  bool empty() const { return range_variance.empty(); }

  /// Throws OptionError, with `name` before the names of the options, unless the two lists are of
  /// the same length.
  void check(const std::string& name) const;

  /// m^2, at a position (m) relative to a sensor, both in one frame, by the bin of its range;
  /// beyond the last bin as in that. Not for empty lists (std::out_of_range).
  Eigen::Matrix2d at(const Point2& position, const Point2& sensor) const;
};

}  // namespace datmo
