// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/wide.h"
#include "datmo_fusion/grid/row_major.h"
#include "datmo_fusion/sensor_model/point_density.h"

namespace datmo {

namespace {

/// How much finer columns and bins are than the cells that they fill, at the farthest one.
constexpr double kColumnsPerCell = 2.0;
constexpr double kBinsPerCell = 4.0;

/// Memory limits, independent of the options: as fine as any image.
constexpr double kMaxColumns = 4096.0;
constexpr double kMaxBins = 2048.0;

/// m; some cameras mark unknown depths by very large ones.
constexpr float kMaxDepth = 1000.0F;

/// The density of points is estimated in square tiles of the image: about this wide, px, and up to
/// this tangent above and below the horizon.
constexpr double kTileSize = 16.0;
constexpr double kMaxTangent = 1.0;

/// In clouds with more points, the line of sight of every second one is counted, or of fewer.
constexpr std::size_t kEnoughLines = 100000;

/// After this many points, the counted lines are shifted by one point: no image is so wide that
/// they would all be in the same columns.
constexpr std::size_t kRun = 1021;

int roundedUp(double value) {
  const int whole = static_cast<int>(value);
  return value > whole ? whole + 1 : whole;
}

}  // namespace

void StereoEvidence::add(const StereoCloud& cloud, const StereoView& view,
                         const EvidenceLimits& limits) {
  prepare(cloud.camera, limits);
  addPoints(cloud, view, limits);
  pixels_per_line_ = pixelsPerLine();
  pixels_per_point_ = std::max(1.0, pixels_per_line_ / static_cast<double>(line_step_));
  obstacles_.sumUp();
  lines_.sumUp();
}

void StereoEvidence::prepare(const StereoCamera& camera, const EvidenceLimits& limits) {
  points_ = 0;
  in_layer_ = 0;
  focal_length_ = camera.focal_length;
  left_ = camera.left_tangent;
  layer_bottom_ = limits.layer_bottom;
  bins_ = DepthBins(camera, limits.max_depth,
                    std::max(limits.cell_size / kBinsPerCell, limits.max_depth / kMaxBins));
  const double width = camera.right_tangent - camera.left_tangent;
  const double finest = std::max({limits.cell_size / limits.max_depth / kColumnsPerCell,
                                  1.0 / focal_length_, width / kMaxColumns});
  columns_ = static_cast<int>(std::ceil(width / finest));
  columns_per_tangent_ = columns_ / width;
  obstacles_.reset(bins_.size() + 1, columns_);
  lines_.reset(bins_.size() + 1, columns_);

  const double column_size = focal_length_ / columns_per_tangent_;
  tile_shift_ = std::max(0, static_cast<int>(std::lround(std::log2(kTileSize / column_size))));
  const double tiles_per_tangent = columns_per_tangent_ / (1 << tile_shift_);
  tile_rows_ = static_cast<int>(std::ceil(2.0 * kMaxTangent * tiles_per_tangent));
  tile_columns_ = (columns_ >> tile_shift_) + 1;
  tiles_.assign(rowMajorSize(tile_columns_, tile_rows_), 0);
}

StereoEvidence::Scales StereoEvidence::scalesOf(const StereoCloud& cloud, const StereoView& view,
                                                const EvidenceLimits& limits) const {
  Scales scales;
  scales.nearest = static_cast<float>(limits.min_depth);
  scales.layer_bottom = static_cast<float>(limits.layer_bottom);
  scales.layer_top = static_cast<float>(limits.layer_top);
  // Lines from above the layer's bottom to above its top carry no information.
  scales.highest = view.cameraHeight() > scales.layer_bottom
                       ? scales.layer_top
                       : std::numeric_limits<float>::infinity();
  scales.left = static_cast<float>(left_);
  scales.columns_per_tangent = static_cast<float>(columns_per_tangent_);
  scales.columns = static_cast<float>(columns_);
  scales.tiles_per_tangent = static_cast<float>(columns_per_tangent_ / (1 << tile_shift_));
  scales.tile_rows = static_cast<float>(tile_rows_);
  scales.farthest = bins_.farthest();
  scales.camera_height = view.cameraHeight();
  scales.above_layer = view.cameraHeight() - static_cast<float>(limits.layer_bottom);
  scales.road_margin = InverseDepthMargin(cloud.camera.noise, limits.road_sigmas);
  scales.obstacle_margin = InverseDepthMargin(cloud.camera.noise, limits.obstacle_sigmas);
  return scales;
}

void StereoEvidence::addPoints(const StereoCloud& cloud, const StereoView& view,
                               const EvidenceLimits& limits) {
  line_step_ = cloud.points.count / kEnoughLines + 1;
  const Scales scales = scalesOf(cloud, view, limits);
  ColumnPoints points;
  for (std::size_t begin = 0; begin < cloud.points.count; begin += kRun) {
    const std::size_t end = std::min(begin + kRun, cloud.points.count);
    std::size_t next_line = begin + begin / kRun % line_step_;
    for (std::size_t first = begin; first < end; first += ViewedPoints::kMax) {
      const std::size_t count = std::min(ViewedPoints::kMax, end - first);
      view.view(cloud.points, first, count, points.viewed);
      points_ += static_cast<std::size_t>(locate(scales, count, points));
      addObstacles(points, count);
      while (next_line < first + count) {
        const bool is_used = points.is_used[next_line - first] != 0;
        if (is_used) {
          addLine(points, next_line - first, scales);
        }
        next_line += is_used ? line_step_ : 1;
      }
    }
  }
}

DATMO_FUSION_WIDE
int StereoEvidence::locate(const Scales& scales, std::size_t count, ColumnPoints& points) {
  const ViewedPoints& viewed = points.viewed;
  int valid = 0;
  // Without branches, because holes are unpredictable.
  for (std::size_t i = 0; i < count; ++i) {
    const float forward = viewed.forward[i];
    const float height = viewed.height[i];
    const float inverse = viewed.inverse[i];
    const int is_valid = (forward > scales.nearest) & (forward < kMaxDepth);
    const float column = (viewed.right[i] * inverse - scales.left) * scales.columns_per_tangent;
    const int is_used =
        is_valid & (height <= scales.highest) & (column >= 0.0F) & (column < scales.columns);
    // On the line of sight to the point, the road is at the inverse depth
    // inverse * (1 - height / camera_height).
    const int on_road =
        height * inverse <= scales.road_margin.at(inverse) * scales.camera_height ? 1 : 0;
    valid += is_valid;
    points.column[i] = static_cast<int>(is_used != 0 ? column : 0.0F);
    points.is_used[i] = is_used;
    points.on_road[i] = on_road;
    points.is_obstacle[i] = is_used & (on_road ^ 1) & (height >= scales.layer_bottom) &
                            (height <= scales.layer_top) & (forward >= 0.0F) &
                            (forward < scales.farthest);
  }
  return valid;
}

void StereoEvidence::addObstacles(const ColumnPoints& points, std::size_t count) {
  std::array<std::size_t, ViewedPoints::kMax> obstacles;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    obstacles[found] = i;
    found += static_cast<std::size_t>(points.is_obstacle[i]);
  }
  for (std::size_t i = 0; i < found; ++i) {
    const std::size_t index = obstacles[i];
    obstacles_.add(bins_.at(points.viewed.forward[index]), points.column[index], 1);
  }
  in_layer_ += found;
}

void StereoEvidence::addLine(const ColumnPoints& points, std::size_t index, const Scales& scales) {
  const float forward = points.viewed.forward[index];
  const float inverse = points.viewed.inverse[index];
  const int column = points.column[index];
  // Drop of the line over the distance to the point, m.
  const float fall = scales.camera_height - points.viewed.height[index];
  const float row = 0.5F * scales.tile_rows + fall * inverse * scales.tiles_per_tangent;
  if (row >= 0.0F && row < scales.tile_rows) {
    ++tiles_[rowMajorIndex(column >> tile_shift_, static_cast<int>(row), tile_columns_)];
  }
  // The interval in which the line is below the layer and unobstructed.
  const float per_fall = forward / fall;
  const float at_bottom = per_fall * scales.above_layer;
  const float stop = points.on_road[index] != 0
                         ? per_fall * scales.camera_height
                         : 1.0F / (inverse + scales.obstacle_margin.at(inverse));
  const bool falls = fall >= 0.0F;  // a horizontal one falls infinitely far away
  const float begin = falls ? std::max(0.0F, at_bottom) : 0.0F;
  const float end = falls ? stop : std::min(stop, at_bottom);
  if (begin < end) {
    lines_.add(bins_.before(begin), column, 1);
    lines_.add(bins_.before(end), column, -1);
  }
}

double StereoEvidence::pixelsPerLine() const {
  const double tile_size = (1 << tile_shift_) * focal_length_ / columns_per_tangent_;
  return pixelsPerPoint(tiles_, tile_size * tile_size);
}

StereoEvidence::Columns StereoEvidence::columnsAt(const PointInView& position,
                                                  double half_width) const {
  // In columns; those whose middles are in between.
  const double middle = (position.tangent() - left_) * columns_per_tangent_;
  const double half = half_width / position.forward * columns_per_tangent_;
  const int first = std::max(0, roundedUp(middle - half - 0.5));
  const int end = std::min(columns_, roundedUp(middle + half - 0.5));
  if (first < end) {
    return {first, end};
  }
  const int nearest = std::clamp(static_cast<int>(middle), 0, columns_ - 1);
  return {nearest, nearest + 1};
}

double StereoEvidence::surface(const PointInView& position, double half_width, double near,
                               double far) const {
  const Columns columns = columnsAt(position, half_width);
  const int first =
      std::min(bins_.before(static_cast<float>(std::max(0.0, near))), bins_.size() - 1);
  const int end = std::max(first + 1, bins_.before(static_cast<float>(far)));
  return obstacles_.sum(first, end, columns.first, columns.end) * surfaceOfPoint(position.forward);
}

StereoEvidence::Lines StereoEvidence::linesAcross(const PointInView& position,
                                                  double half_width) const {
  const Columns columns = columnsAt(position, half_width);
  const int bin = bins_.at(static_cast<float>(position.forward));
  const double across = (columns.end - columns.first) * focal_length_ / columns_per_tangent_;
  const double high = layer_bottom_ / position.forward * focal_length_;
  return {lines_.sum(0, bin + 1, columns.first, columns.end), across * high / pixels_per_line_};
}

}  // namespace datmo
