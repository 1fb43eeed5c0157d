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
  /// Forgets what it knew.
  void reset(const StereoCamera& camera);

  /// Of points that are looked at together.
  using Tangents = std::array<float, ViewedPoints::kMax>;
  using Flags = std::array<int, ViewedPoints::kMax>;

  /// Those of `count` points that are seen (not 0), at these tangents: to the right, and above the
  /// horizon.
  void add(const Tangents& right, const Tangents& up, const Flags& is_seen, std::size_t count);

  /// Pixels of the image for each point where it has no holes; at least 1.
  double pixelsPerPoint() const;

  /// Above the horizon: up to where there are points.
  double maxTangent() const;

  /// Whether there is a point between two tangents to the right.
  bool hasPoints(double from, double to) const;

 private:
  static constexpr int kTileBits = 4;
  static constexpr int kTileSize = 1 << kTileBits;  ///< cells
  static constexpr float kMaxTangent = 1.0F;        ///< above and below the horizon

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
