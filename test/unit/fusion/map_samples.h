// SPDX-License-Identifier: BSD-3-Clause
// Grids and poses for tests of maps on the map level.
#pragma once

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/fusion/map/aging_map.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo::map_samples {

inline constexpr Percent kOccupied = 80;  // log-odds ln 4
inline constexpr Percent kFree = 20;
inline constexpr double kTimeConstant = 60.0;  // s

/// 20 x 10 cells of 1 m about the vehicle.
inline const GridWindow kWindow{1.0, 20, 10, {-10, -5}};
inline const CellIndex kCell{3, 1};

/// An observation of a free cell is as informative as one of an occupied cell.
inline AgingMapOptions evenLooks() {
  AgingMapOptions options;
  options.free_probability = 0.2;
  return options;
}

inline Stamp stampAt(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

inline SensorGrid gridWith(CellIndex cell, Percent percent, double seconds) {
  SensorGrid grid(stampAt(seconds), kWindow);
  grid.at(cell) = percent;
  return grid;
}

inline PoseWithCovariance poseOf(const Pose2& pose, double sigma = 0.05,
                                 double heading_sigma = 0.0) {
  return {
      pose,
      Eigen::Vector3d(sigma * sigma, sigma * sigma, heading_sigma * heading_sigma).asDiagonal()};
}

}  // namespace datmo::map_samples
