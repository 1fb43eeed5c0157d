// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "datmo_fusion/slam/keyframe_selector.h"
#include "datmo_fusion/slam/loop_closer.h"

namespace datmo {

/// Scans for LoopCloser, in order.
struct LoopJob {
  struct Step {
    KeyframeSelector::Use use = KeyframeSelector::Use::kNothing;
    Keyframe scan;  ///< with beams if it is a keyframe
  };

  std::vector<Step> steps;
  bool wants_results = false;  ///< trajectory, loops and map
  std::uint64_t drive = 0;     ///< trajectory that they belong to
};

/// Result of a job.
struct LoopResult {
  Pose2 map_in_global;
  LoopCounts counts;
  std::size_t keyframes = 0;
  std::size_t scans = 0;
  double memory = 0.0;                      ///< bytes
  double residual = 0.0;                    ///< in standard deviations
  double seconds = 0.0;                     ///< processing time
  std::vector<StampedPose> trajectory;      ///< empty if not requested
  std::vector<ClosedLoop> loops;            ///< empty if not requested
  std::shared_ptr<const OccupancyMap> map;  ///< null if not requested, or if it cannot be drawn
  std::uint64_t drive = 0;
  std::string error;  ///< error message; empty: none
};

/// Never throws. After an error in the middle of the steps the closer is empty: the rest of the
/// drive starts a new trajectory.
LoopResult closeLoops(LoopCloser& closer, const LoopJob& job);

}  // namespace datmo
