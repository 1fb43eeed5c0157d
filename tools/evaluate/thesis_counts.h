// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// What the thesis counts, by unique ids.
struct ThesisCounts {
  std::size_t moving_objects = 0;  ///< that are required in some frame (table 3.1)
  std::size_t missed_objects = 0;  ///< of them, never matched (table 3.2)
  std::size_t tracks = 0;          ///< that are not neutral in some frame (table 3.3)
  /// Of them, those that match no true object, required or optional, in more than half of their
  /// frames.
  std::size_t false_tracks = 0;
  /// Of the tracks, those that two or more sensors saw at the same time in some frame (table 3.3).
  std::size_t confirmed_tracks = 0;
  std::size_t confirmed_true_tracks = 0;  ///< of the confirmed ones, those that are not false
};

/// `matching` is of these frames.
ThesisCounts countAsThesis(const Frames& frames, const Matching& matching);

}  // namespace datmo::evaluation
