// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cells_in_view.h"
#include "stereo_evidence.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

/// Evidence of one cloud on each cell in view: the method `columns` of StereoGridModel.
class StereoColumns {
 public:
  /// The arguments must outlive this object.
  StereoColumns(const StereoGridOptions& options, const StereoCamera& camera,
                const StereoView& view, const ViewSector& field, const StereoEvidence& evidence);

  /// `grid`: with all cells unknown.
  void fill(SensorGrid& grid) const;

 private:
  /// m^2 in the layer of obstacles in a cell there, and around it within the depth uncertainty.
  double surfaceAt(const PointInView& position) const;

  /// Whether the surface there is no more than what depth noise moves there from another point on
  /// the line of sight.
  bool isSmear(const PointInView& position) const;

  /// Whether an object has too little total surface.
  bool isNoise(const std::vector<CellIndex>& object, const GridWindow& window) const;

  /// Whether enough lines of sight cross a point near the ground.
  bool isSeenThrough(const PointInView& position) const;

  /// Marks cells by their own evidence only; returns the occupied ones.
  std::vector<CellIndex> markCells(SensorGrid& grid) const;

  /// Sets occupied cells that are noise to unknown; returns the others.
  std::vector<CellIndex> withoutNoise(const std::vector<CellIndex>& occupied,
                                      SensorGrid& grid) const;

  /// Sets free cells to unknown that may be the true position of an occupied one: along the line of
  /// sight by the depth noise, and all neighbors.
  void clearMargin(CellIndex occupied, SensorGrid& grid) const;

  /// The nearest and the farthest depth (m) within a number of standard deviations of a depth.
  struct Depths {
    double near, far;
  };
  Depths around(double depth, double sigmas) const;

  const StereoGridOptions& options_;
  const StereoView& view_;
  const ViewSector& field_;
  const StereoEvidence& evidence_;
  double half_cell_;  ///< m
  DepthNoise noise_;
};

}  // namespace datmo
