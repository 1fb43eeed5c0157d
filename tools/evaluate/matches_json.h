// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/run_score.h"
#include <nlohmann/json.hpp>

namespace datmo::evaluation {

/// Version of the layout.
inline constexpr int kMatchesFormat = 1;

/// Which track is matched to which true object, frame by frame, for programs that score more than
/// this one does: `frames`, by rising stamp, each with
///   stamp_ns  of the frame
///   matches   truth_id, track_id, distance_m as the gate measures it, and whether the object is
///             `required`
///   missed    ids of the required objects without a track
///   false     ids of the tracks of no object
///   neutral   ids of the tracks that are left out of every metric, on an object that is not
///   required switches  truth_id of each object that is matched to another track (`to`) than last
///   (`from`)
nlohmann::json matchesJson(const RunScore& score, const MatchOptions& options);

}  // namespace datmo::evaluation
