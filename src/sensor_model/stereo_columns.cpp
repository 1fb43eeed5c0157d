// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_columns.h"

#include <algorithm>
#include <cmath>

#include "cell_objects.h"

#include "datmo_fusion/grid/neighborhood.h"
#include "datmo_fusion/grid/ray_walk.h"

namespace datmo {

namespace {

/// A cell with at least this share of the surface that makes it occupied is not marked as free.
constexpr double kDoubtfulShare = 0.5;

/// An occupied cell becomes unknown if its surface is less than this many times what depth noise
/// alone can move there from another point on the line of sight; 0: never.
constexpr double kNoiseFactor = 1.0;

/// Minimum number of lines of sight through a free cell.
constexpr int kMinLines = 3;

/// A cell is free if at least this share of the lines of sight that would cross it below the layer
/// of obstacles, in an image without holes, does: anything that reaches up to the layer would have
/// blocked them.
constexpr double kMinSeenShare = 0.3;

/// m^2; neighboring cells with less total surface than this are noise.
constexpr double kMinObjectSurface = 0.05;

/// Maximum distance, in standard deviations of the depth, from which noise moves surface to a cell,
/// and the step in which it is searched.
constexpr double kSmearReach = 2.0;
constexpr double kSmearStep = 0.5;

}  // namespace

StereoColumns::StereoColumns(const StereoGridOptions& options, const StereoCamera& camera,
                             const StereoView& view, const ViewSector& field,
                             const StereoEvidence& evidence)
    : options_(options),
      view_(view),
      field_(field),
      evidence_(evidence),
      half_cell_(0.5 * options.window.cell_size),
      noise_(camera.noise) {}

void StereoColumns::fill(SensorGrid& grid) const {
  for (const CellIndex cell : withoutNoise(markCells(grid), grid)) {
    clearMargin(cell, grid);
  }
}

StereoColumns::Depths StereoColumns::around(double depth, double sigmas) const {
  // In inverse depth, where the noise of a stereo camera is uniform; an infinite far end is clipped
  // to the range of interest.
  const double inverse = 1.0 / depth;
  const double inverse_sigma = noise_.inverseSigma(inverse);
  const double min_inverse = 1.0 / (2.0 * field_.effective_range);
  return {1.0 / (inverse + sigmas * inverse_sigma),
          1.0 / std::max(min_inverse, inverse - sigmas * inverse_sigma)};
}

double StereoColumns::surfaceAt(const PointInView& position) const {
  const Depths depths = around(position.forward, 1.0);
  return evidence_.surface(position, half_cell_,
                           std::min(depths.near, position.forward - half_cell_),
                           std::max(depths.far, position.forward + half_cell_));
}

bool StereoColumns::isSmear(const PointInView& position) const {
  const double inverse_sigma = noise_.inverseSigma(1.0 / position.forward);
  const double sigma = inverse_sigma * position.forward * position.forward;
  if (2.0 * sigma <= half_cell_) {
    return false;
  }
  const double surface = surfaceAt(position);
  // The window in which surface is counted adds to the noise.
  const double half_window = std::max(half_cell_, sigma);
  const double variance = sigma * sigma + half_window * half_window / 3.0;
  for (double sigmas = -kSmearReach; sigmas <= kSmearReach; sigmas += kSmearStep) {
    const double depth = 1.0 / (1.0 / position.forward + sigmas * inverse_sigma);
    const double offset = depth - position.forward;
    if (depth > 0.0 && depth < 2.0 * field_.effective_range && std::abs(offset) > half_cell_) {
      const double share = std::exp(-0.5 * offset * offset / variance);
      if (surface < kNoiseFactor * share * surfaceAt({depth, position.tangent() * depth})) {
        return true;
      }
    }
  }
  return false;
}

bool StereoColumns::isSeenThrough(const PointInView& position) const {
  const StereoEvidence::Lines lines = evidence_.linesAcross(position, half_cell_);
  return lines.seen >= kMinLines && lines.seen >= kMinSeenShare * lines.expected;
}

std::vector<CellIndex> StereoColumns::markCells(SensorGrid& grid) const {
  const Percent occupied = toPercent(options_.occupied_probability);
  const Percent free = toPercent(options_.free_probability);
  const StereoColumnsOptions& limits = options_.columns;
  std::vector<CellIndex> occupied_cells;
  forEachCellInView(grid.window(), view_, field_, [&](CellIndex cell, const PointInView& position) {
    const double surface = surfaceAt(position);
    const double min = std::max(limits.min_surface,
                                limits.min_points * evidence_.surfaceOfPoint(position.forward));
    if (surface >= min) {
      grid.at(cell) = occupied;
      occupied_cells.push_back(cell);
    } else if (surface < kDoubtfulShare * min && isSeenThrough(position)) {
      grid.at(cell) = free;
    }
  });
  return occupied_cells;
}

bool StereoColumns::isNoise(const std::vector<CellIndex>& object, const GridWindow& window) const {
  double surface = 0.0;
  for (const CellIndex cell : object) {
    const PointInView position = view_.viewedPoint(window.centerOf(cell));
    const Depths depths = around(position.forward, 1.0);
    // Surface that neighboring cells count as well is shared with them.
    const double share = std::min(1.0, 2.0 * half_cell_ / (depths.far - depths.near));
    surface += share * surfaceAt(position);
  }
  return surface < kMinObjectSurface;
}

std::vector<CellIndex> StereoColumns::withoutNoise(const std::vector<CellIndex>& occupied,
                                                   SensorGrid& grid) const {
  std::vector<CellIndex> left;
  for (const auto& object : objectsOf(occupied, grid.window())) {
    const bool is_noise = isNoise(object, grid.window());
    for (const CellIndex cell : object) {
      if (is_noise || isSmear(view_.viewedPoint(grid.window().centerOf(cell)))) {
        grid.at(cell) = kUnknownPercent;
      } else {
        left.push_back(cell);
      }
    }
  }
  return left;
}

void StereoColumns::clearMargin(CellIndex occupied, SensorGrid& grid) const {
  const PointInView position = view_.viewedPoint(grid.window().centerOf(occupied));
  const Depths depths = around(position.forward, options_.columns.obstacle_sigmas);
  const auto clear = [&grid](CellIndex center) {
    forEachNeighbor(center, [&grid](CellIndex cell) {
      if (isFree(grid.atOrUnknown(cell))) {
        grid.at(cell) = kUnknownPercent;
      }
    });
  };
  walkRay(grid.window(), view_.positionOf({depths.near, position.tangent() * depths.near}),
          view_.positionOf({depths.far, position.tangent() * depths.far}), clear);
}

}  // namespace datmo
