// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

struct MapChangeOptions {
  double sure = 0.85;
  double same_within = 1.5;  ///< cells

  void visit(OptionVisitor& visitor);
};

/// Values of a grid of changes; all other cells are kUnknownPercent.
inline constexpr Percent kNewPercent = 100;
inline constexpr Percent kVanishedPercent = 0;

struct MapChanges {
  SensorGrid grid;  ///< in the map's frame, with the window of the inputs
  int appeared = 0;
  int vanished = 0;
};

/// Compares an earlier map with the current one; both must have the same window, in the map's frame
/// (else std::invalid_argument).
///
/// A cell is new if `now` is occupied and `before` was free, and vanished in the opposite case,
/// each with a probability of at least `sure`; and if the other map has nothing occupied within
/// `same_within` cells plus two standard deviations of the pose, which grow with the distance from
/// the vehicle by those of the heading: a smaller apparent motion may be a pose error. Cells
/// unknown in either map are unchanged.
MapChanges changesBetween(const SensorGrid& before, const SensorGrid& now,
                          const PoseWithCovariance& base_in_map, const MapChangeOptions& options);

}  // namespace datmo
