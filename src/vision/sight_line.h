// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ground_view.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/vision/mono_grid.h"

namespace datmo {

/// The cells along one line of sight over the road, from the camera on, as far as they are seen.
struct SightLine {
  struct Step {
    CellIndex cell;
    double distance = 0.0;  ///< m, from the camera over ground
    cv::Rect patch;         ///< px, of the cell in the image
  };

  std::vector<Step> open;  ///< up to where the scanner sees something
  std::vector<Step> hits;  ///< the cells that it has there, each up to an obstacle's height
};

/// The line from the camera of a view toward `direction` (unit vector, base frame) within a scan's
/// grid, up to `range` (m); what is hit is looked at up to `obstacle_height` (m).
SightLine sightLine(const GroundView& view, const Point2& direction, const SensorGrid& scanned,
                    double range, double obstacle_height);

/// What an image says of the cells of its lines of sight (MonoGridModel, method lines).
class SightLines {
 public:
  /// All must outlive this.
  SightLines(const MonoGridOptions& options, const GroundView& view, const SensorGrid& scanned,
             const RoadPixels& pixels)
      : options_(options), view_(view), scanned_(scanned), pixels_(pixels) {}

  /// Of several lines that cross a cell the one that sees more in it counts.
  void fill(SensorGrid& grid) const;

 private:
  void write(const SightLine& line, SensorGrid& grid) const;
  /// Whether what is of other colors between two distances (m) may be an obstacle, by the road that
  /// is seen behind it.
  bool mayHide(double from, double to) const;
  bool isRoad(const SightLine::Step& step) const;
  /// m, by which the camera's pitch may move what is seen at a distance.
  double rangeSigma(double distance) const;

  const MonoGridOptions& options_;
  const GroundView& view_;
  const SensorGrid& scanned_;
  const RoadPixels& pixels_;
};

}  // namespace datmo
