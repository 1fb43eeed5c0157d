#pragma once

#include "cells_in_view.h"
#include "stereo_evidence.h"

#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

/// What the evidence of one cloud says of each cell in view: the method `columns` of
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
  double surfaceAt(const ViewedPlace& place) const;

  /// Whether no other place on the line of sight has clearly more surface of what may be the same
  /// obstacle.
  bool isNoise(const ViewedPlace& place, double surface) const;

  bool isSeenThrough(const ViewedPlace& place) const;

  void markCells(SensorGrid& grid) const;

  /// Objects with too little surface in all become unknown.
  void removeNoise(SensorGrid& grid) const;

  /// Free cells that the noise of its depth may have kept an obstacle out of become unknown.
  void addMargins(SensorGrid& grid) const;

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
  double half_cell_;      ///< m
  double inverse_sigma_;  ///< 1/m: standard deviation of an inverse depth
};

}  // namespace datmo
