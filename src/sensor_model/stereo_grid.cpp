// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/stereo_grid.h"

#include <algorithm>

#include "cells_in_view.h"
#include "stereo_columns.h"
#include "stereo_cones.h"
#include "stereo_evidence.h"

#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

namespace {

ViewSector fieldOf(const StereoGridOptions& options, const StereoCamera& camera) {
  return {camera.left_tangent, camera.right_tangent, options.min_depth, options.effective_range};
}

EvidenceLimits limitsOf(const StereoGridOptions& options, const StereoCloud& cloud) {
  EvidenceLimits limits;
  limits.cell_size = options.window.cell_size;
  limits.min_depth = options.min_depth;
  limits.max_depth = options.maxDepth(cloud.camera);
  limits.layer_bottom = std::max(options.min_layer_height, cloud.scanner_height);
  limits.layer_top = limits.layer_bottom + options.layer_thickness;
  limits.road_sigmas = options.columns.road_sigmas;
  limits.obstacle_sigmas = options.columns.obstacle_sigmas;
  return limits;
}

}  // namespace

void StereoConesOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"threshold", "1",
                   "a cell with more points than this in it and its eight neighbors is occupied "
                   "(V_thr of thesis eq. 3.2.3)"},
                  threshold, {0, 1000000});
}

void StereoColumnsOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"min_points", "1",
                   "minimum number of points in an occupied cell, besides their surface: far away, "
                   "a single point covers much surface"},
                  min_points, {1, 10000});
}

void StereoGridOptions::visit(OptionVisitor& visitor) {
  visitor.group("window", [&] { window.visit(visitor); });
  visitor.choice(
      {"method", "",
       "columns: surface and lines of sight in columns of the image, on an estimated road; "
       "cones: counts of points and cones of objects on a flat road (thesis 3.2.2)"},
      method, {{"columns", StereoGridMethod::kColumns}, {"cones", StereoGridMethod::kCones}});
  visitor.number({"occupied_probability", "1", "occupancy of an occupied cell (thesis figure 3.4)"},
                 occupied_probability, {0.51, 1.0});
  visitor.number({"free_probability", "1", "occupancy of a free cell (thesis figure 3.4)"},
                 free_probability, {0.0, 0.49});
  visitor.number({"min_layer_height", "m",
                  "the layer of obstacles begins at the planar scanner's height, but no lower "
                  "above the road than this (columns only)"},
                 min_layer_height, {0.05, 2.0});
  visitor.number({"layer_thickness", "m", "height of the layer of obstacles (thesis eq. 3.2.2)"},
                 layer_thickness, {0.1, 5.0});
  visitor.number({"min_depth", "m", "nearer points are mismatches (columns only)", Tier::kPublic},
                 min_depth, {0.05, 10.0});
  visitor.group("columns", [&] { columns.visit(visitor); });
  visitor.group("cones", [&] { cones.visit(visitor); });
  RoadSceneOptions::visit(visitor);
}

StereoGridModel::StereoGridModel(const Checked<StereoGridOptions>& options)
    : options_(*options),
      window_(options->window.window()),
      road_(options->road),
      evidence_(std::make_unique<StereoEvidence>()) {}

StereoGridModel::~StereoGridModel() = default;

StereoGridResult StereoGridModel::grid(const StereoCloud& cloud) {
  StereoGridResult result;
  result.grid = SensorGrid(cloud.stamp, window_);
  const ViewSector field = fieldOf(options_, cloud.camera);
  if (options_.method == StereoGridMethod::kCones) {
    const StereoView view(cloud, result.road);
    const StereoCounts counts = fillByCones(options_, cloud, view, field, result.grid);
    result.points = counts.points;
    result.in_layer = counts.in_layer;
    return result;
  }
  result.road_seen = road_.update(cloud).has_value();
  result.road = road_.last();
  const StereoView view(cloud, result.road);
  evidence_->add(cloud, view, limitsOf(options_, cloud));
  StereoColumns(options_, cloud.camera, view, field, *evidence_).fill(result.grid);
  result.points = evidence_->points();
  result.in_layer = evidence_->inLayer();
  return result;
}

}  // namespace datmo
