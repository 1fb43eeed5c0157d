// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/visibility/scan_history.h"

namespace datmo {

/// Beam ends on a target in one scan, in the fixed frame.
struct SeenPoints {
  double time = 0.0;       ///< s, on the target's clock, when they were measured
  double scan_time = 0.0;  ///< s, the same for their scan's stamp
  bool is_echo = false;    ///< a single point: the extent of the surface is unknown
  std::vector<ReflectionPoint> points;
};

/// Recent observations of a target: the points of a few scans, spread over the last seconds as
/// evenly as possible. Cheap to copy: the points are shared.
class SeenPointHistory {
 public:
  /// Adds the points of an object (fixed frame) of a scan at `scan_time` (s, ascending), a subset
  /// if there are many, and drops those older than `memory` (s). Objects without points are
  /// ignored.
  void add(const Object& object, double scan_time, double memory);
  void clear() { seen_.clear(); }

  /// Returns the scans, oldest first.
  const std::vector<std::shared_ptr<const SeenPoints>>& scans() const { return seen_; }

 private:
  void thinOut();

  std::vector<std::shared_ptr<const SeenPoints>> seen_;
};

}  // namespace datmo
