// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// Distribution of the hits around a point: the local surface at finer than cell resolution.
struct HitDistribution {
  double hits = 0.0;
  Point2 mean = Point2::Zero();                          ///< m, map frame
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2
  double maturity = 0.0;  ///< 0 to 1; 1: hit for as long as a static object
  double age = 0.0;       ///< s, mean age of the hits at the map's last update
};

/// The hits in one cell, as sums relative to the cell's center, for which floats suffice.
struct CellHits {
  float count = 0.0F;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();      ///< m
  Eigen::Vector3f squares = Eigen::Vector3f::Zero();  ///< m^2: xx, xy, yy

  /// Adds a hit, `offset` (m) from the center. Older hits are faded so that there are at most `max`
  /// and the surface follows recent measurements.
  void add(const Eigen::Vector2f& offset, float max);

  /// Adds the hits of a cell whose frame is turned by `rotation` and whose center is `shift` (m)
  /// from this one's; of all of them at most `max` count.
  void add(const CellHits& hits, const Eigen::Matrix2f& rotation, const Eigen::Vector2f& shift,
           float max);

  /// Returns the mean relative to the center, m; there must be hits.
  Point2 mean() const { return (sum / count).cast<double>(); }
};

/// The combined hits of several cells.
class HitSums {
 public:
  /// `shift`: of the cell's center from the common reference, m. `maturity`: of the cell, 0 to 1.
  /// `age`: mean of its hits, s.
  void add(const CellHits& cell, const Point2& shift, double maturity, double age);

  bool empty() const { return hits_ <= 0.0; }

  /// Returns the distribution; `reference`: in the map, m. There must be hits.
  HitDistribution about(const Point2& reference) const;

 private:
  double hits_ = 0.0;
  double maturity_ = 0.0;
  double age_ = 0.0;  ///< s, sum over the hits
  Point2 sum_ = Point2::Zero();
  Eigen::Vector3d squares_ = Eigen::Vector3d::Zero();  ///< xx, xy, yy
};

}  // namespace datmo
