// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/slam_measurement.h"

#include <utility>

namespace datmo {

namespace {

GridMaskedScan unmasked(const Scan& scan) {
  GridMaskedScan view;
  view.scan = scan;
  view.any_measured = true;
  return view;
}

Scan measuredScan(const GridMaskedScan& view) {
  Scan scan = view.scan;
  if (view.any_measured) {
    for (std::size_t i = 0; i < scan.rays.size(); ++i) {
      scan.rays[i].hit = scan.rays[i].hit && view.isMeasured(i);
    }
  }
  return scan;
}

}  // namespace

PreparedScan prepareScan(const SlamMeasurement& measurement, Scan compensated, GridEnds ends) {
  GridMaskedScan view = measurement.grid != nullptr
                            ? maskScanWithGrid(*measurement.grid, compensated, ends)
                            : unmasked(compensated);
  Scan own = measuredScan(view);
  return {std::move(compensated), std::move(view), std::move(own)};
}

GridUpdate gridUpdateOf(const GridMaskedScan& view, const std::vector<PointState>& states,
                        const SensorGrid& grid, const OccupancyMap& map, const Pose2& base_in_map) {
  GridUpdate grid_update;
  std::vector<Point2> others = view.cells;
  for (std::size_t i = 0; i < view.scan.rays.size(); ++i) {
    const Ray& ray = view.scan.rays[i];
    if (!ray.hit) {
      continue;
    }
    if (view.any_measured && !view.isMeasured(i)) {
      others.push_back(ray.end);
    } else {
      (states[i] == PointState::kMoving ? grid_update.movers : grid_update.surfaces)
          .push_back(ray.end);
    }
  }
  std::vector<Point2>& target = view.any_measured ? grid_update.cells : grid_update.surfaces;
  for (const Point2& position : excludeConnectedTo(grid_update.movers, grid, others)) {
    if (map.judge(base_in_map * position) != PointState::kMoving) {
      target.push_back(position);
    }
  }
  grid_update.refuted = view.refuted;
  grid_update.viewpoint = view.scan.scanner_in_base.position();
  return grid_update;
}

void removeConflictingBeams(const Scan& measured, const GridMaskedScan& view, Scan& scan,
                            std::vector<PointState>& states) {
  if (!view.any_measured) {
    return;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    if (!measured.rays[i].hit || view.isMeasured(i)) {
      scan.rays[kept] = scan.rays[i];
      states[kept] = states[i];
      ++kept;
    }
  }
  scan.rays.resize(kept);
  states.resize(kept);
}

}  // namespace datmo
