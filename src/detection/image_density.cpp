// SPDX-License-Identifier: BSD-3-Clause
#include "image_density.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/wide.h"
#include "datmo_fusion/sensor_model/point_density.h"

namespace datmo {

namespace {

/// Rows with less than this share of the fullest row's points are outside the image: the camera is
/// not quite level.
constexpr double kMinRowShare = 0.05;

/// Limit along each side of the image, for any camera.
constexpr double kMaxCells = 8192.0;

}  // namespace

void ImageDensity::reset(const StereoCamera& camera) {
  left_ = static_cast<float>(camera.left_tangent);
  const double width = camera.right_tangent - camera.left_tangent;
  const double per_tangent = std::min({camera.focal_length, kMaxCells / width,
                                       kMaxCells / (2.0 * static_cast<double>(kMaxTangent))});
  per_tangent_ = static_cast<float>(per_tangent);
  cell_pixels_ = camera.focal_length / per_tangent;
  columns_ = static_cast<float>(std::ceil(width * per_tangent));
  rows_ = std::ceil(2.0F * kMaxTangent * per_tangent_);
  tile_columns_ = static_cast<int>(columns_) / kTileSize + 1;
  in_column_.assign(static_cast<std::size_t>(columns_), 0);
  in_row_.assign(static_cast<std::size_t>(rows_) * kLanes, 0);
  tiles_.assign(rowMajorSize(tile_columns_, static_cast<int>(rows_) / kTileSize + 1) * kLanes, 0);
}

void ImageDensity::add(const Tangents& right, const Tangents& up, const Flags& is_seen,
                       std::size_t count) {
  Cells cells;
  locate(right, up, is_seen, count, cells);
  // Without branches, because holes are unpredictable: a hole adds 0.
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t lane = i % kLanes;
    in_column_[static_cast<std::size_t>(cells.column[i])] += cells.is_inside[i];
    in_row_[static_cast<std::size_t>(cells.row[i]) * kLanes + lane] += cells.is_inside[i];
    tiles_[static_cast<std::size_t>(cells.tile[i]) * kLanes + lane] += cells.is_inside[i];
  }
}

DATMO_FUSION_WIDE
void ImageDensity::locate(const Tangents& right, const Tangents& up, const Flags& is_seen,
                          std::size_t count, Cells& cells) const {
  const float left = left_;
  const float per_tangent = per_tangent_;
  const float end_column = columns_;
  const float end_row = rows_;
  const int tile_columns = tile_columns_;
  for (std::size_t i = 0; i < count; ++i) {
    const float column = (right[i] - left) * per_tangent;
    const float row = (kMaxTangent - up[i]) * per_tangent;
    const int inside =
        (column >= 0.0F) & (column < end_column) & (row >= 0.0F) & (row < end_row) & is_seen[i];
    cells.is_inside[i] = inside;
    cells.column[i] = static_cast<int>(inside != 0 ? column : 0.0F);
    cells.row[i] = static_cast<int>(inside != 0 ? row : 0.0F);
    cells.tile[i] = (cells.row[i] >> kTileBits) * tile_columns + (cells.column[i] >> kTileBits);
  }
}

std::vector<int> ImageDensity::summed(const std::vector<int>& lanes) {
  std::vector<int> sums(lanes.size() / kLanes, 0);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    sums[i / kLanes] += lanes[i];
  }
  return sums;
}

double ImageDensity::pixelsPerPoint() const {
  const double tile = static_cast<double>(kTileSize) * cell_pixels_;
  return std::max(1.0, datmo::pixelsPerPoint(summed(tiles_), tile * tile));
}

double ImageDensity::maxTangent() const {
  const std::vector<int> in_row = summed(in_row_);
  const auto fullest = std::max_element(in_row.begin(), in_row.end());
  const auto first = std::find_if(in_row.begin(), in_row.end(), [&](int count) {
    return count > 0 && count >= kMinRowShare * *fullest;
  });
  const auto row = static_cast<float>(first - in_row.begin());
  return static_cast<double>(kMaxTangent - row / per_tangent_);
}

bool ImageDensity::hasPoints(double from, double to) const {
  const auto column = [&](double tangent) {
    const double position =
        std::floor((tangent - static_cast<double>(left_)) * static_cast<double>(per_tangent_));
    return static_cast<std::ptrdiff_t>(std::clamp(position, 0.0, static_cast<double>(columns_)));
  };
  const auto end = std::min(column(to) + 1, static_cast<std::ptrdiff_t>(in_column_.size()));
  return std::any_of(in_column_.begin() + std::min(column(from), end), in_column_.begin() + end,
                     [](int count) { return count > 0; });
}

}  // namespace datmo
