// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "stereo_surfaces.h"
#include "surface_groups.h"

namespace datmo {

/// The end of a group of surfaces on one side.
struct GroupEnd {
  bool seen = false;    ///< false: it may continue where it is hidden
  double beyond = 0.0;  ///< m, from the middle of its last column
  double sigma = 0.0;   ///< m
};

/// A group of surfaces as seen by the camera.
struct GroupOutline {
  std::vector<ColumnSurface> columns;  ///< the nearest surface in each column, left to right
  GroupEnd left, right;
  double depth = 0.0;    ///< m, median
  double top = 0.0;      ///< m above the road
  double surface = 0.0;  ///< m^2
  double across = 0.0;   ///< m, across the line of sight
  double along = 0.0;    ///< m, in depth, including noise
  double length = 0.0;   ///< m, from end to end
};

/// Finds the outlines of groups of surfaces.
class OutlineFinder {
 public:
  /// The arguments must outlive this object.
  OutlineFinder(const StereoObjectDetectorOptions& options, const StereoCamera& camera,
                const StereoSurfaces& surfaces);

  /// `group`: at least one surface.
  GroupOutline outlineOf(const SurfaceGroup& group) const;

 private:
  /// Direction over the columns.
  enum class Step { kLeft = -1, kRight = 1 };

  GroupEnd endAt(const ColumnSurface& last, Step step) const;
  bool isAtBorder(const ColumnSurface& last, Step step) const;
  bool isBesideNearer(const ColumnSurface& last, Step step) const;

  const StereoObjectDetectorOptions& options_;
  const StereoCamera& camera_;
  const StereoSurfaces& surfaces_;
  const SurfaceColumns& columns_;
};

}  // namespace datmo
