// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// How far the chain of stages goes; each of them feeds the next. stereo_tracker goes with tracker.
enum class LastStage {
  kGridFusion,
  kGridSlam,
  kLoopClosing,
  kRoadBorder,
  kMovingObjects,
  kObjectFusion,
  kTracker,
  kTrackFusion,
  kRisk,
  kEnd  ///< all that there are
};

}  // namespace datmo
