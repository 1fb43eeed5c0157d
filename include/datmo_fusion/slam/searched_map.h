// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/grid/distance_field.h"
#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

/// Distances from the cells of a map to what is not free. Unknown cells between free ones are free:
/// beams far away are further apart than cells. Nothing outside of what the map knows is free.
DistanceField freeSpaceOf(const OccupancyMap& map);

/// A map as searches see it (MapSearch), made once for all of them while it does not change. The
/// map is not kept.
class SearchedMap {
 public:
  explicit SearchedMap(const OccupancyMap& map);

  const GridWindow& window() const { return window_; }

  /// OccupancyMap::staticSurfaces().
  const std::vector<Point2>& surfaces() const { return surfaces_; }

  /// Of a point, in cells, and no more than 2^16 / kSteps.
  struct Distances {
    float depth;       ///< to what is not free; 0 outside of the window
    float to_surface;  ///< to what is static; outside of the window no more than that
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

  /// Whether a point (as above) is in the window.
  bool contains(const Eigen::Vector2f& point) const {
    return point.x() >= 0.0F && point.y() >= 0.0F && point.x() < columns_ && point.y() < rows_;
  }

 private:
  /// Distances are kept in so many parts of a cell.
  static constexpr float kSteps = 64.0F;

  /// In such steps.
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
