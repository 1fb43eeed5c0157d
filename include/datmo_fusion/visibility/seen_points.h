// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/visibility/scan_history.h"

namespace datmo {

/// Points where beams ended on a target in one scan, in the fixed frame.
struct SeenPoints {
  double time = 0.0;       ///< s, on the target's clock, when they were seen
  double scan_time = 0.0;  ///< s, the same of their scan's stamp
  std::vector<ReflectionPoint> points;

  /// Nothing is known of how far the surface reaches beside a single echo.
  bool isEcho() const { return points.size() == 1; }
};

/// Where a target was seen of late: the points of a few scans, spread over the last time as evenly
/// as they came. Cheap to copy: what was seen is shared.
class SeenPointHistory {
 public:
  /// Adds the points of an object (fixed frame) of a scan at `scan_time` (s, rising), of long ones
  /// some, and forgets those older than `memory` (s). An object without points adds nothing.
  void add(const Object& object, double scan_time, double memory);
  void clear() { seen_.clear(); }

  /// Oldest first.
  const std::vector<std::shared_ptr<const SeenPoints>>& scans() const { return seen_; }

 private:
  void thinOut();

  std::vector<std::shared_ptr<const SeenPoints>> seen_;
};

}  // namespace datmo
