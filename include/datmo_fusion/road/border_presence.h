// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace datmo {

/// Probability of a border on one side along the vehicle's path, at equally spaced stations.
struct SidePresence {
  double first_station = 0.0;   ///< m, distance driven at the middle of station 0
  double station_length = 1.0;  ///< m
  /// 0 to 1 for each station, from behind the vehicle to ahead of it; 0.5: unknown.
  std::vector<double> probability;
};

/// Both sides at the same time.
struct BorderPresence {
  double arc_length = 0.0;  ///< m, distance driven so far
  SidePresence left;
  SidePresence right;
};

}  // namespace datmo
