// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/ros/stage/stage_health.h"

namespace datmo {

/// Health of the stack in one sentence.
struct StackHealth {
  HealthLevel level = HealthLevel::kOk;
  std::string sentence;
};

/// Answers "why is there no output?": if the stage that publishes `result` (a resolved topic)
/// produces nothing, the cause is the first fault of the most upstream stage that produces nothing
/// either: "no tracks: grid_slam: no transform base_link -> laser". Otherwise the first fault of
/// any stage, in the order given: "degraded: stereo_grid: no points2 for 3.0 s".
///
/// Two stages are connected if an output of one has the topic of an input of the other.
StackHealth stackHealth(const std::vector<StageState>& stages, const std::string& result);

/// Adds to the health, for the first `kRestartReported` seconds, that the stack runs in a new
/// process because the previous one has ended: WARN at least.
StackHealth withRestart(const StackHealth& health, int restarts, double seconds_since_start);
inline constexpr double kRestartReported = 30.0;  ///< s; long enough for whoever reads diagnostics

/// The latest state of each reporting stage, until it has been silent long enough to be considered
/// terminated.
class ReportingStages {
 public:
  /// `seconds`: on a clock independent of messages.
  void update(const StageState& state, double seconds);

  /// By name. Forgets terminated stages.
  std::vector<StageState> at(double seconds);

 private:
  struct Report {
    StageState state;
    double seconds = 0.0;
  };

  std::map<std::string, Report> reports_;
};

}  // namespace datmo
