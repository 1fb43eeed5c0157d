// SPDX-License-Identifier: BSD-3-Clause
#include "last_stage.h"

namespace datmo {

namespace {

constexpr LastStages kLastStages{{
    {"grid_fusion", LastStage::kGridFusion, &StackSwitches::low_level_fusion,
     LastStage::kGridFusion},
    {"grid_slam", LastStage::kGridSlam, nullptr, LastStage::kGridSlam},
    {"loop_closing", LastStage::kLoopClosing, &StackSwitches::loop_closing,
     LastStage::kLoopClosing},
    {"road_border", LastStage::kRoadBorder, &StackSwitches::road_border, LastStage::kRoadBorder},
    {"moving_objects", LastStage::kMovingObjects, nullptr, LastStage::kMovingObjects},
    {"object_fusion", LastStage::kObjectFusion, &StackSwitches::object_fusion,
     LastStage::kObjectFusion},
    {"tracker", LastStage::kTracker, nullptr, LastStage::kTracker},
    // Its switch starts the second tracker as well.
    {"track_fusion", LastStage::kTrackFusion, &StackSwitches::track_fusion, LastStage::kTracker},
    {"risk", LastStage::kRisk, &StackSwitches::risk, LastStage::kRisk},
}};

constexpr bool hasEachInOrder(const LastStages& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (stages[i].stage != static_cast<LastStage>(i)) {
      return false;
    }
  }
  return true;
}
static_assert(hasEachInOrder(kLastStages), "a stage without a row");

}  // namespace

const LastStages& lastStages() { return kLastStages; }

std::string stageType(LastStage stage) {
  return stage == LastStage::kEnd ? "" : kLastStages.at(static_cast<std::size_t>(stage)).name;
}

}  // namespace datmo
