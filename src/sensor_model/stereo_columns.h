// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cells_in_view.h"
#include "stereo_evidence.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

/// Evidence of one cloud on each cell in view: the method `columns` of
/// StereoGridModel.
class StereoColumns {
 public:
  /// What is passed must outlive this.
  StereoColumns(const StereoGridOptions& options, const StereoCamera& camera,
                const StereoView& view, const FieldOfView& field, const StereoEvidence& evidence);

  /// `grid`: with all cells unknown.
  void fill(SensorGrid& grid) const;

 private:
  /// m^2 in the layer of obstacles in a cell there; around it as far as the depth is uncertain.
  double surfaceAt(const PointInView& position) const;

  /// Whether the surface there is no more than what the noise of the depth brings there from
  /// another point on the line of sight.
  bool isSmear(const PointInView& position) const;

  /// Whether an object has too little surface in all.
  bool isNoise(const std::vector<CellIndex>& object, const GridWindow& window) const;

  /// Whether enough lines of sight cross a point near the ground.
  bool isSeenThrough(const PointInView& position) const;

  /// By what is seen there alone; returns the occupied ones.
  std::vector<CellIndex> markCells(SensorGrid& grid) const;

  /// Occupied cells that are noise become unknown; returns the others.
  std::vector<CellIndex> withoutNoise(const std::vector<CellIndex>& occupied,
                                      SensorGrid& grid) const;

  /// Free cells that may be where an occupied one seems to be become unknown: along the line of
  /// sight by the noise of the depth, and all neighbors.
  void clearMargin(CellIndex occupied, SensorGrid& grid) const;

  /// From the nearest to the farthest depth (m) that is within so many standard deviations of a
  /// depth.
  struct Depths {
    double near, far;
  };
  Depths around(double depth, double sigmas) const;

  const StereoGridOptions& options_;
  const StereoView& view_;
  const FieldOfView& field_;
  const StereoEvidence& evidence_;
  double half_cell_;  ///< m
  DepthNoise noise_;
};

}  // namespace datmo
