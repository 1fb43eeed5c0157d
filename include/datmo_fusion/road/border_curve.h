// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// A clothoid: a line whose curvature changes at an even rate along it, as roads are built
/// (Dickmanns and Mysliwetz 1992; Kirchner and Heinrich 1998).
struct BorderCurve {
  Pose2 anchor;                 ///< a point of the line and its direction there, map frame
  double curvature = 0.0;       ///< 1/m at the anchor, positive: it turns to the left
  double curvature_rate = 0.0;  ///< 1/m^2 along the line

  /// The same line, from an anchor so far along it (m, negative: back).
  BorderCurve movedAlong(double distance) const;
};

/// Where a point lies beside a line.
struct CurvePoint {
  double along = 0.0;  ///< m, from the anchor
  double aside = 0.0;  ///< m, to the left of the line
};

/// Poses of a curve at equal steps, so that many points can be brought to it.
class CurveTable {
 public:
  /// Of a curve from `first` to `last` (m along from its anchor, first < last).
  CurveTable(const BorderCurve& curve, double first, double last);

  double first() const { return first_; }
  double last() const;

  /// On the line, `along` (m from the anchor) within first() and last().
  Pose2 at(double along) const;

  /// The foot of the perpendicular on the line; beyond its ends on the line straight on.
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
