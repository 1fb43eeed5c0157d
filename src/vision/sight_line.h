// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ground_view.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/vision/mono_grid.h"

namespace datmo {

/// A cell of a line of sight over the road.
struct SightStep {
  CellIndex cell;
  double distance = 0.0;  ///< m, horizontal, from the camera
  cv::Rect patch;         ///< px, of the cell in the image; of an echo, up to an obstacle's height
  bool is_hit = false;    ///< an echo of the scanner
};

/// From the camera on; cells outside of the image are left out.
using SightLine = std::vector<SightStep>;

/// Returns the line from the camera of a view toward `direction` (unit vector, base frame) within a
/// scan's grid, up to `range` (m); echo cells are examined up to `obstacle_height` (m). Beyond its
/// first echo it has only cells that the scanner, from its own place, sees: camera and scanner are
/// apart, and an echo is anywhere in its beam's width, so that the line may pass beside it.
SightLine sightLine(const GroundView& view, const Point2& direction, const SensorGrid& scanned,
                    double range, double obstacle_height);

/// What an image says about the cells of its lines of sight (MonoGridModel, method lines).
class SightLines {
 public:
  /// All must outlive this.
  SightLines(const MonoGridOptions& options, const GroundView& view, const SensorGrid& scanned,
             const RoadPixels& pixels)
      : options_(options), view_(view), scanned_(scanned), pixels_(pixels) {}

  /// Fills the grid; if several lines cross a cell, the highest value is used.
  void fill(SensorGrid& grid) const;

 private:
  void write(const SightLine& line, SensorGrid& grid) const;
  /// Makes the end of a line undecided that has other colors from step `foot` on, and the road
  /// before it, as far as the camera's pitch may shift it, unless an echo tells where they begin.
  void writeEnd(const SightLine& line, std::size_t foot, SensorGrid& grid) const;
  /// Whether other colors between two distances (m) may be an obstacle, given the road that is
  /// visible behind them.
  bool mayHide(double from, double to) const;
  bool isRoad(const SightStep& step) const;
  /// m, apparent displacement at a distance because of the camera's pitch.
  double rangeSigma(double distance) const;

  const MonoGridOptions& options_;
  const GroundView& view_;
  const SensorGrid& scanned_;
  const RoadPixels& pixels_;
};

}  // namespace datmo
