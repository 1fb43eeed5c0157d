// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/lidar_grid.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/grid/beam_walk.h"

namespace datmo {

namespace {

/// Distance from a point to the farthest point of the window, m.
double reachFrom(const Point2& point, const GridWindow& window) {
  const Point2 low = window.origin();
  const Point2 high = low + window.cell_size * Point2(window.columns, window.rows);
  return (point - low).cwiseAbs().cwiseMax((point - high).cwiseAbs()).norm();
}

/// Writes the evidence of beams into a grid.
class BeamWriter {
 public:
  BeamWriter(SensorGrid& grid, double beam_width, const LidarGridOptions& options)
      : grid_(grid),
        beam_width_(beam_width),
        cut_per_turn_(1.0 / std::tan(options.min_incidence)),
        beam_end_(options.beam_end) {}

  /// A surface hit at a grazing angle comes closer to the scanner on one side of the beam: away
  /// from its axis the beam is only free up to such a surface. Within the range uncertainty before
  /// that, it may already be the surface.
  void pass(const Ray& ray, Percent free) {
    const Beam beam = beamOf(ray);
    const Point2 axis = beam.along.normalized();
    const double margin = beam_end_.margin(ray);
    forEachLine(grid_.window(), beam, [&](const Point2& to) {
      const Point2 line = to - beam.from;
      const double turn = std::acos(std::min(1.0, axis.dot(line.normalized())));
      const double share = ray.hit ? std::max(0.0, 1.0 - turn * cut_per_turn_) : 1.0;
      // A part of the margin may lie beyond the window.
      const double shown_margin = std::max(0.0, margin - share * (ray.range - beam.range));
      const double free_share = share - shown_margin / beam.range;
      if (free_share >= 0.0) {
        write(beam.from, beam.from + free_share * line, free);
      }
    });
  }

  /// The arc at the measured range, in steps of a cell.
  void end(const Ray& ray, Percent occupied) {
    const Beam beam = beamOf(ray);
    if (beam.range < ray.range) {
      return;  // it ends outside the window
    }
    Point2 previous = ray.end;
    forEachLine(grid_.window(), beam, [&](const Point2& to) {
      write(previous, to, occupied);
      previous = to;
    });
  }

 private:
  /// Clipped to the window, because a distant end would take long to reach.
  Beam beamOf(const Ray& ray) const {
    const Point2 along = ray.end - ray.origin;
    const double shown = std::min(1.0, reachFrom(ray.origin, grid_.window()) / ray.range);
    return {ray.origin, shown * along, shown * ray.range, beam_width_};
  }

  void write(const Point2& from, const Point2& to, Percent percent) {
    walkRay(grid_.window(), from, to, [&](CellIndex cell) {
      if (grid_.window().contains(cell)) {
        grid_.at(cell) = percent;
      }
    });
  }

  SensorGrid& grid_;
  double beam_width_;
  double cut_per_turn_;  ///< 1/rad, relative shortening of a line by the angle from the beam's axis
  BeamEndOptions beam_end_;
};

}  // namespace

void LidarGridOptions::visit(OptionVisitor& visitor) {
  visitor.group("window", [&] { window.visit(visitor); });
  visitor.number(
      {"occupied_probability", "1", "occupancy of the cells in which a beam ends (thesis 3.2.1)"},
      occupied_probability, {0.51, 0.99});
  visitor.number(
      {"free_probability", "1", "occupancy of the cells that a beam passes (thesis 3.2.1)"},
      free_probability, {0.01, 0.49});
  visitor.number({"beam_width", "rad",
                  "opening angle of a beam; 0: it reaches halfway to its neighbors (thesis "
                  "3.2.1: each cell uses the nearest beam)",
                  Tier::kPublic},
                 beam_width, {0.0, 0.2});
  visitor.number({"min_incidence", "rad",
                  "smallest angle at which a beam meets a surface: the smaller, the shorter the "
                  "borders of the beam are free; pi/2: as far as its axis (thesis)"},
                 min_incidence, {0.01, kQuarterTurn});
  beam_end.visit(visitor);
}

LidarGridModel::LidarGridModel(const Checked<LidarGridOptions>& options)
    : options_(*options), window_(options->window.window()) {}

SensorGrid LidarGridModel::grid(const Scan& scan) const {
  SensorGrid grid(scan.stamp, window_);
  const double beam_width =
      options_.beam_width > 0.0 ? options_.beam_width : std::abs(scan.field.beam_spacing);
  BeamWriter writer(grid, beam_width, options_);
  for (const Ray& ray : scan.rays) {
    writer.pass(ray, toPercent(options_.free_probability));
  }
  // After all free space: an end takes precedence over a neighboring beam that passes it.
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      writer.end(ray, toPercent(options_.occupied_probability));
    }
  }
  return grid;
}

}  // namespace datmo
