// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "datmo_fusion/grid/row_major.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

/// How densely a camera's image is filled with points, and up to where: a cloud may be thinned, and
/// matchers find nothing at the image's border.
class ImageDensity {
 public:
  /// Clears all counts.
  void reset(const StereoCamera& camera);

  /// Values of points that are processed together.
  using Tangents = std::array<float, ViewedPoints::kMax>;
  using Flags = std::array<int, ViewedPoints::kMax>;

  /// Counts those of `count` points that are seen (flag 1), at these tangents: to the right,
  /// and above the horizon.
  void add(const Tangents& right, const Tangents& up, const Flags& is_seen, std::size_t count);

  /// Returns the number of image pixels per point where there are no holes; at least 1.
  double pixelsPerPoint() const;

  /// Returns the tangent above the horizon up to which there are points.
  double maxTangent() const;

  /// Returns whether there is a point between two tangents to the right.
  bool hasPoints(double from, double to) const;

 private:
  static constexpr int kTileBits = 4;
  static constexpr int kTileSize = 1 << kTileBits;  ///< cells
  static constexpr float kMaxTangent = 1.0F;        ///< above and below the horizon

  /// Neighboring points are mostly in one row and tile. Counted in one number each would wait for
  /// the previous one, so there are several.
  static constexpr std::size_t kLanes = 4;

  /// Where points that are processed together are in the image; 0 for those outside.
  struct Cells {
    Flags is_inside;
    Flags column;
    Flags row;
    Flags tile;
  };
  void locate(const Tangents& right, const Tangents& up, const Flags& is_seen, std::size_t count,
              Cells& cells) const;

  /// Returns the sums over the lanes of each count.
  static std::vector<int> summed(const std::vector<int>& lanes);

  // Cells are pixels, except in extremely large images.
  float left_ = 0.0F;         ///< tangent of the image's left border
  float per_tangent_ = 0.0F;  ///< cells
  double cell_pixels_ = 1.0;  ///< px, side of a cell
  float columns_ = 0.0F;
  float rows_ = 0.0F;
  int tile_columns_ = 0;
  std::vector<int> in_column_;
  std::vector<int> in_row_;  ///< lanes of each row
  std::vector<int> tiles_;   ///< row by row, lanes of each tile
};

}  // namespace datmo
