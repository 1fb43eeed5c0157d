// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// How often the class of a track is that of the object it is matched to.
struct ClassShare {
  std::size_t frames = 0;  ///< of matched tracks, whose object's true class is known
  std::size_t right = 0;   ///< of them, those in which the track's class is that
  std::size_t silent = 0;  ///< of them, those in which the track's class is unknown

  /// Share of all its frames, 0 to 1; none: no frame.
  std::optional<double> share() const;
};

struct ClassScores {
  ClassShare all;
  std::map<ObjectClass, ClassShare> by_class;  ///< by true class, those that were matched
};

/// Of the tracks that are matched to required truths. `matching` is of these frames.
ClassScores scoreClasses(const Frames& frames, const Matching& matching);

}  // namespace datmo::evaluation
