// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "summed_counts.h"

#include "datmo_fusion/sensor_model/depth_bins.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

/// How the points of one cloud are counted.
struct EvidenceLimits {
  double cell_size = 0.0;        ///< m, of the requested grid
  double min_depth = 0.0;        ///< m, nearer points are mismatches
  double max_depth = 0.0;        ///< m, obstacles beyond are not of interest
  double layer_bottom = 0.0;     ///< m above the road
  double layer_top = 0.0;        ///< m above the road
  double road_sigmas = 0.0;      ///< of the depth: points this close to the road are on it
  double obstacle_sigmas = 0.0;  ///< of the depth: margin before the end of a line of sight
};

/// The points of one cloud, counted in columns of the camera's level image over depth: how many are
/// in the layer of obstacles, and how many lines of sight cross each point near the ground.
class StereoEvidence {
 public:
  /// Replaces the contents by the cloud's points. `view`: of this cloud.
  void add(const StereoCloud& cloud, const StereoView& view, const EvidenceLimits& limits);

  /// Returns the surface (m^2) in the layer of obstacles that is seen between two depths (m),
  /// within `half_width` (m) to either side of a point in view.
  double surface(const PointInView& position, double half_width, double near, double far) const;

  /// Returns the surface (m^2) that one point at a depth (m) represents, if it faces the camera.
  double surfaceOfPoint(double depth) const {
    const double pixel = depth / focal_length_;
    return pixel * pixel * pixels_per_point_;
  }

  /// Lines of sight that cross a point in view between the road and the layer's bottom, within
  /// `half_width` (m) to either side of it.
  struct Lines {
    int seen = 0;
    double expected = 0.0;  ///< in an image without holes
  };
  Lines linesAcross(const PointInView& position, double half_width) const;

  std::size_t points() const { return points_; }
  std::size_t inLayer() const { return in_layer_; }

 private:
  struct Columns {
    int first, end;
  };

  /// What a point is compared with, in single precision like the points.
  struct Scales {
    float nearest, layer_bottom, layer_top;    ///< m
    float highest;                             ///< m above the road, of informative points
    float left, columns_per_tangent, columns;  ///< of the columns
    float tiles_per_tangent, tile_rows;        ///< of the tiles
    float farthest;                            ///< m, of obstacles
    float camera_height;                       ///< m above the road
    float above_layer;                         ///< m, of the camera above the layer's bottom
    InverseDepthMargin road_margin;            ///< times the camera's height: of height / depth
    InverseDepthMargin obstacle_margin;        ///< of the inverse depth
  };
  Scales scalesOf(const StereoCloud& cloud, const StereoView& view,
                  const EvidenceLimits& limits) const;

  /// Several points with the columns that they are in.
  struct ColumnPoints {
    using Flags = std::array<int, ViewedPoints::kMax>;

    ViewedPoints viewed;
    Flags column;       ///< 0 for a point that is in none
    Flags is_used;      ///< 1: valid, in a column, and informative
    Flags on_road;      ///< 1: on the road
    Flags is_obstacle;  ///< 1: used, and an obstacle in the layer
  };

  /// Finds the columns of `count` viewed points. Returns how many points are valid.
  static int locate(const Scales& scales, std::size_t count, ColumnPoints& points);
  void addObstacles(const ColumnPoints& points, std::size_t count);
  void addLine(const ColumnPoints& points, std::size_t index, const Scales& scales);
  void prepare(const StereoCamera& camera, const EvidenceLimits& limits);
  void addPoints(const StereoCloud& cloud, const StereoView& view, const EvidenceLimits& limits);
  /// Image pixels per point whose line is counted.
  double pixelsPerLine() const;

  /// At least one column.
  Columns columnsAt(const PointInView& position, double half_width) const;

  DepthBins bins_;
  int columns_ = 0;
  double left_ = 0.0;  ///< tangent of the first column's left border
  double columns_per_tangent_ = 0.0;
  double focal_length_ = 0.0;  ///< px
  double layer_bottom_ = 0.0;  ///< m above the road
  int tile_shift_ = 0;         ///< a tile of the image is 2^this columns wide
  int tile_rows_ = 0;
  int tile_columns_ = 0;

  SummedCounts obstacles_;  ///< points, by bin and column
  SummedCounts lines_;      ///< lines of sight that begin minus those that end, by bin and column
  std::vector<int> tiles_;  ///< lines in each tile of the image, row by row
  std::size_t line_step_ = 1;  ///< lines are counted for one in this many points
  double pixels_per_line_ = 1.0;
  double pixels_per_point_ = 1.0;  ///< 1: the cloud is dense
  std::size_t points_ = 0;
  std::size_t in_layer_ = 0;
};

}  // namespace datmo
