// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drive_summary.h"
#include "graph_runner.h"
#include <nlohmann/json.hpp>

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/loop_closing_stage.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// A report on a run and its worst moments, for the program that summarizes many runs. Times are
/// those of the recording, s since its first message.
class RunReport {
 public:
  /// To be called when a message of this topic, recorded at `now`, has been processed.
  void book(const std::string& topic, Stamp now, const GraphRunner& graph);

  /// To be called when a message of the ground truth has been copied.
  void noteTruth() { has_truth_ = true; }

  /// Adds what a stage has published.
  void add(const Publication& publication);

  /// As JSON. `end`: record time of the last message.
  std::string json(const DriveSummary& drive, const RunTime& time, Stamp end,
                   const GraphRunner& graph) const;

 private:
  /// A stage with a problem, and the reason.
  struct Condition {
    std::string stage;
    HealthLevel level = HealthLevel::kOk;
    std::string why;
    Stamp from;
    std::optional<Stamp> to;  ///< none: to the end
  };

  struct Pose {
    Stamp stamp;
    double sigma = 0.0;  ///< m, of the position, in its worst direction
  };

  /// Times of the events of one kind.
  using Times = std::vector<Stamp>;
  using StageAndReason = std::pair<std::string, std::string>;

  void bookDrops(const StageMonitor& monitor, Stamp now);
  void bookCondition(const StageMonitor& monitor, Stamp now);

  double since(Stamp stamp) const { return secondsBetween(start_.value_or(stamp), stamp); }
  nlohmann::json silences(Stamp end) const;
  nlohmann::json dropped() const;
  nlohmann::json conditions(Stamp end) const;
  nlohmann::json pose(Stamp end) const;
  nlohmann::json loops(const LoopClosingStage& closing) const;

  bool has_truth_ = false;
  std::optional<Stamp> start_;
  std::map<std::string, Times> arrivals_;           ///< by topic
  std::map<std::string, std::uint64_t> all_drops_;  ///< by stage, so far
  std::map<StageAndReason, Times> drops_;
  std::map<std::string, std::size_t> open_conditions_;  ///< by stage: index in conditions_
  std::vector<Condition> conditions_;
  std::vector<Pose> poses_;
};

}  // namespace datmo
