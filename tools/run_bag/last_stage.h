// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "datmo_fusion/ros/stage/stage_graph.h"

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

/// A stage that --until accepts.
struct NamedLastStage {
  const char* name;  ///< type of the stage
  LastStage stage;
  bool StackSwitches::*enabled_by;  ///< null: it always runs
  LastStage earliest_end;           ///< earliest --until that its switch accepts
};

/// In the order of LastStage.
using LastStages = std::array<NamedLastStage, static_cast<std::size_t>(LastStage::kEnd)>;

const LastStages& lastStages();

/// The type of the stage; empty for kEnd.
std::string stageType(LastStage stage);

}  // namespace datmo
