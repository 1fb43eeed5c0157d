// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo::kitti {

/// The state of one true trajectory in one of the frames in which it is labeled.
struct TruthRecord {
  int track = kUnassigned;  ///< trajectory that it is matched to
  bool required = true;
};

/// How one true trajectory was tracked.
struct TruthSummary {
  enum class Coverage { kNotRequired, kMostly, kPartly, kMostlyLost };

  std::size_t id_switches = 0;
  std::size_t fragmentations = 0;
  Coverage coverage = Coverage::kNotRequired;
};

/// Summarizes the labeled frames of a trajectory in their order (they may have gaps), as counted by
/// KITTI's tracking benchmark and Weng et al. 2020:
/// - an id switch is a match to another track than the last one, if the frame before is matched
///   too: another track after a gap is only a fragmentation;
/// - a fragmentation is a match that differs from the frame before (another track, or none) once a
///   trajectory was tracked, if the next frame is matched too; in the last frame always;
/// - a frame in which it need not be found resets the history: the next match is a new beginning;
/// - mostly tracked: matched in more than 80 % of the frames in which it must be found;
/// - mostly lost: in less than 20 %. A match in the first frame counts even if it need
///   not be found there.
TruthSummary summarize(const std::vector<TruthRecord>& records);

}  // namespace datmo::kitti
