// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stack_health.h"

#include <algorithm>
#include <set>

#include "datmo_fusion/ros/frame_ids.h"

namespace datmo {

namespace {

using Stages = std::vector<StageState>;

/// s; a stage reports every second, on a heavily loaded machine every few seconds.
constexpr double kEndedAfter = 10.0;

bool contains(const std::vector<std::string>& topics, const std::string& topic) {
  return std::find(topics.begin(), topics.end(), topic) != topics.end();
}

const StageState* producerOf(const Stages& stages, const std::string& topic) {
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const StageState& stage) {
    return contains(stage.topics.outputs, topic);
  });
  return found == stages.end() ? nullptr : &*found;
}

/// The most upstream stage from this one that has no output.
const StageState& rootCause(const Stages& stages, const StageState& stage,
                            std::set<std::string>& visited) {
  visited.insert(stage.stage);
  for (const std::string& topic : stage.topics.inputs) {
    const StageState* const producer = producerOf(stages, topic);
    if (producer != nullptr && producer->level == HealthLevel::kNoOutput &&
        visited.count(producer->stage) == 0) {
      return rootCause(stages, *producer, visited);
    }
  }
  return stage;
}

std::string firstFault(const StageState& stage) {
  return stage.stage + ": " + (stage.faults.empty() ? "no reason reported" : stage.faults.front());
}

}  // namespace

StackHealth stackHealth(const Stages& stages, const std::string& result) {
  const StageState* const last = producerOf(stages, result);
  if (last == nullptr) {
    return {HealthLevel::kNoOutput,
            "no " + withoutSlash(result) + ": no stage that publishes them has reported"};
  }
  if (last->level == HealthLevel::kNoOutput) {
    std::set<std::string> visited;
    return {HealthLevel::kNoOutput,
            "no " + withoutSlash(result) + ": " + firstFault(rootCause(stages, *last, visited))};
  }
  const auto worse = std::find_if(stages.begin(), stages.end(), [](const StageState& stage) {
    return stage.level != HealthLevel::kOk;
  });
  if (worse != stages.end()) {
    return {HealthLevel::kDegraded, "degraded: " + firstFault(*worse)};
  }
  return {HealthLevel::kOk, withoutSlash(result) + " are published"};
}

StackHealth withRestart(const StackHealth& health, int restarts, double seconds_since_start) {
  if (restarts == 0 || seconds_since_start > kRestartReported) {
    return health;
  }
  return {std::max(health.level, HealthLevel::kDegraded),
          health.sentence +
              " (restarted, because its process had ended: ids of tracks start over, and, without "
              "a checkpoint, the map)"};
}

void ReportingStages::update(const StageState& state, double seconds) {
  reports_[state.stage] = {state, seconds};
}

std::vector<StageState> ReportingStages::at(double seconds) {
  std::vector<StageState> states;
  for (auto report = reports_.begin(); report != reports_.end();) {
    if (seconds - report->second.seconds > kEndedAfter) {
      report = reports_.erase(report);
    } else {
      states.push_back(report->second.state);
      ++report;
    }
  }
  return states;
}

}  // namespace datmo
