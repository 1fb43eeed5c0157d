// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// Moving tracks where there is no object.
struct FalseMovers {
  std::size_t frames = 0;  ///< that were scored
  std::size_t tracks = 0;  ///< false ones, summed over the frames

  /// Mean number of them in a frame; none: no frame.
  std::optional<double> perFrame() const;
};

/// A track is a false mover if it is faster than `min_speed` (m/s) and not within the gate of any
/// true object, matched or not. `matching` is of these frames.
FalseMovers countFalseMovers(const Frames& frames, const Matching& matching, double min_speed);

}  // namespace datmo::evaluation
