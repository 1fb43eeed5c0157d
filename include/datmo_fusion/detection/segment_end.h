// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/scan.h"

namespace datmo {

/// How far a surface extends beyond the last point seen on it.
struct SurfaceEnd {
  double beyond = 0.0;    ///< m, expected, at least 0
  double variance = 0.0;  ///< m^2
};

/// Estimates where a surface that beams hit ends: between the last hit and the point where the next
/// beam would have hit it, if that beam passed and reached farther.
class SegmentEnds {
 public:
  /// `scan` must outlive this. `range_sigma` (m): standard deviation of a range. Surfaces with
  /// points farther apart than `max_gap` (m) are not followed.
  SegmentEnds(const LabeledScan& scan, double range_sigma, double max_gap)
      : scan_(scan), range_sigma_(range_sigma), max_gap_(max_gap) {}

  /// Returns the end of the surface that continues from a point of the scan along a unit vector,
  /// away from the object; its direction is known to `heading_std` (rad, at least 0). None if the
  /// end was not seen: something nearer hides it, the surface continues (as far as the scan shows),
  /// the field of view ends, the next beam's measurement is not valid, or no next beam on this side
  /// hits the surface.
  std::optional<SurfaceEnd> beyond(const ScanPoint& last, const Point2& along,
                                   double heading_std) const;

 private:
  std::optional<std::uint32_t> nextBeam(std::uint32_t beam, int step) const;
  bool seesFartherThan(std::uint32_t beam, double range) const;

  const LabeledScan& scan_;
  double range_sigma_;
  double max_gap_;
};

}  // namespace datmo
