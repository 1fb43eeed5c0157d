// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace datmo {

/// Where along the vehicle's path one side has a border, in equal stations.
struct SidePresence {
  double first_station = 0.0;   ///< m, distance driven at the middle of station 0
  double station_length = 1.0;  ///< m
  /// 0 to 1 for each station, from behind the vehicle to ahead of it: that a border runs there; 0.5
  /// where nothing is known.
  std::vector<double> probability;
};

/// Both sides at one time.
struct BorderPresence {
  double arc_length = 0.0;  ///< m, distance driven up to now
  SidePresence left;
  SidePresence right;
};

}  // namespace datmo
