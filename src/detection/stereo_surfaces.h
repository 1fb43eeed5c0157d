// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "image_density.h"

#include "datmo_fusion/detection/stereo_object_detector.h"
#include "datmo_fusion/sensor_model/depth_bins.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

/// An upright surface at one depth in one column of the camera's level image.
struct ColumnSurface {
  int column = 0;
  float depth = 0.0F;   ///< m ahead of the camera: of the mean inverse depth of its points
  float points = 0.0F;  ///< near that depth, in the layer of road users
  float bottom = 0.0F;  ///< m above the road, of the visible part
  float top = 0.0F;     ///< m above the road
};

/// The columns of the camera's level image, and the surfaces in them.
struct SurfaceColumns {
  int count = 0;
  double left = 0.0;         ///< tangent of the first column's left border
  double per_tangent = 0.0;  ///< columns
  /// Start index of each column's surfaces in the list; one more entry than columns.
  std::vector<std::size_t> begin;
  std::vector<ColumnSurface> surfaces;  ///< by column, nearest first

  /// Returns the tangent of a column's middle, to the right.
  double tangentOf(int column) const { return left + (column + 0.5) / per_tangent; }
  /// Returns the width of a column at a depth (m), m.
  double widthAt(double depth) const { return depth / per_tangent; }
};

/// Finds the upright surfaces in the columns of a cloud: in each column the points above the road
/// are counted over depth, in bins in which the noise of the camera is uniform; each mode of these
/// counts is a surface, so there may be several behind each other (u-disparity; Labayrade, Aubert,
/// Tarel, Real time obstacle detection in stereovision on non flat road geometry through
/// v-disparity representation, 2002; surfaces in columns: Badino, Franke, Pfeiffer, The stixel
/// world, 2009).
///
/// A cloud may be dense or thinned, organized or not: the column width follows the point spacing.
class StereoSurfaces {
 public:
  /// Replaces the contents. `view`: of this cloud. `farthest`: m.
  void find(const StereoCloud& cloud, const StereoView& view, const StereoSurfaceOptions& options,
            double farthest);

  const SurfaceColumns& columns() const { return columns_; }
  const ImageDensity& density() const { return density_; }

  /// Returns the number of points that are finite and in front of the camera.
  std::size_t points() const { return points_; }

 private:
  /// A point above the road, in the image.
  struct Upright {
    float right;         ///< tangent
    float depth;         ///< m
    float height;        ///< m above the road
    std::uint32_t slot;  ///< of its column and bin
  };

  /// What a point is compared with, in single precision like the points.
  struct Bounds {
    float nearest, farthest;         ///< m, depth
    float lowest, highest;           ///< m above the road
    float left, right;               ///< tangents of the image's borders
    float camera_height;             ///< m above the road
    InverseDepthMargin road_margin;  ///< times the camera's height: of height / depth
  };
  static Bounds boundsOf(const StereoCamera& camera, const StereoView& view,
                         const StereoSurfaceOptions& options, double farthest);

  /// Several points in the image.
  struct ImagePoints {
    ViewedPoints viewed;
    ImageDensity::Tangents right;  ///< to the right
    ImageDensity::Tangents up;     ///< above the horizon
    ImageDensity::Flags is_seen;   ///< 1: valid
    ImageDensity::Flags stands;    ///< 1: seen in the image, above the road
  };

  /// Locates `count` viewed points in the image. Returns how many are seen.
  static int locate(const Bounds& bounds, std::size_t count, ImagePoints& points);

  /// A mode of the counts in a column.
  struct Mode {
    int column, first_bin, peak, end_bin;
  };

  void addPoints(const StereoCloud& cloud, const StereoView& view,
                 const StereoSurfaceOptions& options, double farthest);
  void countLayer(const StereoCamera& camera, const StereoSurfaceOptions& options, double farthest);
  void findModes(const StereoSurfaceOptions& options);
  void smoothColumn(int column);
  void addModes(int column, const StereoSurfaceOptions& options);
  void addMode(const Mode& mode, const StereoSurfaceOptions& options);
  void measure(const StereoSurfaceOptions& options);
  void setHeights(ColumnSurface& surface, const std::uint16_t* slices,
                  const StereoSurfaceOptions& options) const;

  int columnOf(float right) const {
    const auto column = static_cast<int>((right - left_) * per_tangent_);
    return column < columns_.count ? column : columns_.count - 1;
  }
  std::size_t slot(int column, int bin) const {
    return static_cast<std::size_t>(column) * bins_ + static_cast<std::size_t>(bin);
  }
  /// Number of height slices in which points are counted.
  static std::size_t slicesUpTo(double height);
  /// Number of points above each other in a column, per m of height, at a depth (m).
  double pointsPerMeter(double depth) const { return columns_.per_tangent / depth; }

  DepthBins depth_bins_;
  ImageDensity density_;
  SurfaceColumns columns_;
  std::size_t bins_ = 0;
  float left_ = 0.0F;
  float per_tangent_ = 0.0F;
  std::size_t points_ = 0;

  std::vector<Upright> upright_;
  std::vector<std::uint16_t> counts_;     ///< points of the layer, by column and bin
  std::vector<int> smooth_;               ///< of one column: over neighboring columns and bins
  std::vector<int> raw_;                  ///< of one column: over neighboring columns
  std::vector<std::int32_t> surface_at_;  ///< by column and bin: index of a surface, or -1
  std::vector<double> inverse_sums_;      ///< 1/m, by surface
  std::vector<std::uint16_t> slices_;     ///< points by surface and height
};

}  // namespace datmo
