// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/search_region.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/common/uniform.h"

namespace datmo {

namespace {

/// Mean and covariance of the poses within a map's window.
PoseWithCovariance anywhereIn(const GridWindow& window) {
  const Point2 extent = window.cell_size * Point2(static_cast<double>(window.columns),
                                                  static_cast<double>(window.rows));
  const Point2 center = window.origin() + 0.5 * extent;
  PoseWithCovariance all{Pose2(center.x(), center.y(), 0.0), {}};
  all.covariance =
      kUniformVariance *
      Eigen::Vector3d(extent.x() * extent.x(), extent.y() * extent.y(), square(kTurn)).asDiagonal();
  return all;
}

}  // namespace

PoseWithCovariance priorOf(const SearchRegion& region, const GridWindow& window) {
  return region.anywhere ? anywhereIn(window) : region.prior;
}

}  // namespace datmo
