// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "evaluate/scored_run.h"

namespace datmo::evaluation {

/// The identity metrics (Ristani et al., Performance measures and a data set for multi-target,
/// multi-camera tracking, ECCV workshops, 2016).
struct IdentityScores {
  std::optional<double> idf1;  ///< 0 to 1; none: neither objects nor tracks
  std::optional<double> idp;   ///< precision, 0 to 1; none: no tracks
  std::optional<double> idr;   ///< recall, 0 to 1; none: no objects
};

/// Each object is assigned at most one track for the whole run, and each track at most one object,
/// such that the number of frames that agree is largest: both exist, within the gate of each other.
IdentityScores scoreIdentity(const ScoredRun& run);

}  // namespace datmo::evaluation
