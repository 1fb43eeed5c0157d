// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// A clothoid: a curve whose curvature changes linearly with arc length, as roads are built
/// (Dickmanns and Mysliwetz 1992; Kirchner and Heinrich 1998).
struct BorderCurve {
  Pose2 anchor;                 ///< a point of the curve and its direction there, map frame
  double curvature = 0.0;       ///< 1/m at the anchor, positive: left turn
  double curvature_rate = 0.0;  ///< 1/m^2, along the curve

  /// Returns the same curve with the anchor moved along it by `distance` (m, negative: backward).
  BorderCurve movedAlong(double distance) const;
};

/// Position of a point relative to a curve.
struct CurvePoint {
  double along = 0.0;  ///< m, from the anchor
  double aside = 0.0;  ///< m, to the left of the curve
};

/// Poses of a curve at equal steps, for locating many points efficiently.
class CurveTable {
 public:
  /// Samples a curve from `first` to `last` (m along from its anchor, first < last).
  CurveTable(const BorderCurve& curve, double first, double last);

  double first() const { return first_; }
  double last() const;

  /// Returns the pose at `along` (m from the anchor), within first() and last().
  Pose2 at(double along) const;

  /// Returns the foot of the perpendicular on the curve; beyond its ends on its straight extension.
  CurvePoint locate(const Point2& point) const;

 private:
  struct Station {
    Point2 position;
    Point2 direction;  ///< of length 1
  };
  std::size_t nearest(double along) const;

  double first_;
  Pose2 anchor_;
  std::vector<Station> stations_;
};

}  // namespace datmo
