// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evaluate/recorded_data.h"

namespace datmo::evaluation {

/// Score of the detection of intersections (thesis table 3.5).
struct IntersectionScore {
  std::size_t intersections = 0;     ///< true ones that the vehicle was at
  std::optional<std::size_t> found;  ///< reported at some time of it; none: the run reports nothing
  std::optional<std::size_t> wrong;  ///< reported, but not true at any time of the report
};

/// An intersection lasts from the first to the last stamp at which the vehicle is at it; intervals
/// with at most `merge_gap` (s) between them are merged. `reported` none: the run does not look for
/// intersections.
IntersectionScore scoreIntersections(
    const std::vector<RecordedIntersection>& truth,
    const std::optional<std::vector<RecordedIntersection>>& reported, double merge_gap);

}  // namespace datmo::evaluation
