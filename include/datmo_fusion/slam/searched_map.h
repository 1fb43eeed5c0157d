// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/grid/distance_field.h"
#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

/// Returns the distances from the cells of a map to what is not free. Unknown cells between free
/// ones count as free, because distant beams are further apart than cells. Nothing beyond the known
/// part of the map is free.
DistanceField freeSpaceOf(const OccupancyMap& map);

/// A map prepared for searches (MapSearch), made once for all of them while it does not change. The
/// map itself is not kept.
class SearchedMap {
 public:
  explicit SearchedMap(const OccupancyMap& map);

  const GridWindow& window() const { return window_; }

  /// OccupancyMap::staticSurfaces().
  const std::vector<Point2>& surfaces() const { return surfaces_; }

  /// Distances of a point, in cells, at most 2^16 / kSteps.
  struct Distances {
    float depth;       ///< to what is not free; 0 outside the window
    float to_surface;  ///< to what is static; outside the window a lower bound
  };

  /// `point`: in cells from the window's lower left corner.
  Distances at(const Eigen::Vector2f& point) const {
    if (!contains(point)) {
      return {0.0F, toWindow(point)};
    }
    const Cell& cell = cells_[rowMajorIndex(static_cast<int>(point.x()),
                                            static_cast<int>(point.y()), window_.columns)];
    return {static_cast<float>(cell.depth) / kSteps, static_cast<float>(cell.to_surface) / kSteps};
  }

  /// Returns whether a point (as above) is in the window.
  bool contains(const Eigen::Vector2f& point) const {
    return point.x() >= 0.0F && point.y() >= 0.0F && point.x() < columns_ && point.y() < rows_;
  }

 private:
  /// Distances are stored in fractions of a cell: 1 / kSteps.
  static constexpr float kSteps = 64.0F;

  /// In units of 1 / kSteps.
  struct Cell {
    std::uint16_t depth;
    std::uint16_t to_surface;
  };

  static std::uint16_t inSteps(double cells);
  float toWindow(const Eigen::Vector2f& point) const;

  GridWindow window_;
  float columns_;
  float rows_;
  std::vector<Cell> cells_;  ///< row by row
  std::vector<Point2> surfaces_;
};

}  // namespace datmo
