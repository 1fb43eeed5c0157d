// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/grid/row_major.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// How densely a camera's image is filled with points, and up to where: a cloud may be thinned, and
/// matchers find nothing at the image's border.
class ImageDensity {
 public:
  /// Forgets what it knew.
  void reset(const StereoCamera& camera);

  /// A point at these tangents: to the right, and above the horizon.
  void add(float right, float up) {
    const float column = (right - left_) * per_tangent_;
    const float row = (kMaxTangent - up) * per_tangent_;
    if (column >= 0.0F && column < columns_ && row >= 0.0F && row < rows_) {
      const int x = static_cast<int>(column);
      const int y = static_cast<int>(row);
      ++in_column_[static_cast<std::size_t>(x)];
      ++in_row_[static_cast<std::size_t>(y)];
      ++tiles_[rowMajorIndex(x / kTileSize, y / kTileSize, tile_columns_)];
    }
  }

  /// Pixels of the image for each point where it has no holes; at least 1.
  double pixelsPerPoint() const;

  /// Above the horizon: up to where there are points.
  double maxTangent() const;

  /// Whether there is a point between two tangents to the right.
  bool hasPoints(double from, double to) const;

 private:
  static constexpr int kTileSize = 16;        ///< cells
  static constexpr float kMaxTangent = 1.0F;  ///< above and below the horizon

  // Cells are pixels, but in images larger than any.
  float left_ = 0.0F;         ///< tangent of the image's left border
  float per_tangent_ = 0.0F;  ///< cells
  double cell_pixels_ = 1.0;  ///< px, side of a cell
  float columns_ = 0.0F;
  float rows_ = 0.0F;
  int tile_columns_ = 0;
  std::vector<int> in_column_;
  std::vector<int> in_row_;
  std::vector<int> tiles_;  ///< row by row
};

}  // namespace datmo
