// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/ros/stage/stage_health.h"

namespace datmo {

/// How the stack does, in one sentence.
struct StackHealth {
  HealthLevel level = HealthLevel::kOk;
  std::string sentence;
};

/// Answers "why is nothing there?": when the stage that publishes `result` (a topic, resolved)
/// makes nothing, the cause is the first fault of the stage that is farthest up the chain and makes
/// nothing either: "no tracks: grid_slam: no transform base_link -> laser". Else the first fault of
/// any stage, in the order given: "less than all: stereo_grid: no points2 for 3.0 s".
///
/// Two stages are connected where one's outputs have a topic of the other's inputs.
StackHealth stackHealth(const std::vector<StageState>& stages, const std::string& result);

/// The stages that report: the newest state of each, until it has not reported for so long that it
/// has ended.
class ReportingStages {
 public:
  /// `seconds`: on a clock that no message sets.
  void take(const StageState& state, double seconds);

  /// By name. Forgets those that ended.
  std::vector<StageState> at(double seconds);

 private:
  struct Report {
    StageState state;
    double seconds = 0.0;
  };

  std::map<std::string, Report> reports_;
};

}  // namespace datmo
