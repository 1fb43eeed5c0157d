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
  std::uint64_t drive = 0;     ///< to which they belong
};

/// What became of them.
struct LoopResult {
  Pose2 map_in_global;
  LoopCounts counts;
  std::size_t keyframes = 0;
  std::size_t scans = 0;
  double memory = 0.0;                      ///< bytes
  double residual = 0.0;                    ///< in standard deviations
  double seconds = 0.0;                     ///< that it took
  std::vector<StampedPose> trajectory;      ///< empty if it was not wanted
  std::vector<ClosedLoop> loops;            ///< the same
  std::shared_ptr<const OccupancyMap> map;  ///< null if it was not wanted, or cannot be drawn
  std::uint64_t drive = 0;
  std::string error;  ///< what went wrong; empty: nothing
};

/// Throws nothing. After an error in the middle of the steps the closer is empty: what is left of
/// the drive begins anew.
LoopResult closeLoops(LoopCloser& closer, const LoopJob& job);

}  // namespace datmo
