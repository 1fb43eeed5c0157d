// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_health.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace datmo {

namespace {

std::string inSeconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", value);
  return text;
}

}  // namespace

std::string nameAndTopics(const WatchedInput& input) {
  std::string text;
  for (const InputTopic& topic : input.topics) {
    text += (text.empty() ? input.name + " on " : " or ") + topic.topic;
  }
  return text;
}

bool isPublished(const WatchedInput& input, const PublishedType& published_type) {
  return std::any_of(input.topics.begin(), input.topics.end(), [&](const InputTopic& topic) {
    return published_type(topic.topic) == topic.data_type;
  });
}

std::string whyNotReceived(const WatchedInput& input, const PublishedType& published_type) {
  if (isPublished(input, published_type)) {
    return "it is published, but no message has been received";
  }
  for (const InputTopic& topic : input.topics) {
    const std::optional<std::string> type = published_type(topic.topic);
    if (!type) {
      return "the master has not answered";
    }
    if (!type->empty()) {
      return "it is published as " + *type + ", expected " + topic.data_type;
    }
  }
  return "it has no publisher";
}

StageHealth::StageHealth(std::vector<WatchedInput> inputs, double silence_after)
    : inputs_(std::move(inputs)), silence_after_(silence_after) {}

StageState StageHealth::judge(const StageMonitor& monitor, Stamp now,
                              const PublishedType& published_type) {
  StageState state;
  state.stage = monitor.stage();
  if (monitor.droppedCount() > std::exchange(drops_, monitor.droppedCount())) {
    state.faults.push_back(monitor.lastDrop());
  }
  const std::vector<std::string> missing = inputFaults(monitor, now, published_type);
  state.faults.insert(state.faults.end(), missing.begin(), missing.end());
  if (monitor.warningCount() > std::exchange(warnings_, monitor.warningCount())) {
    state.faults.push_back(monitor.lastWarning());
  }
  if (!state.faults.empty()) {
    state.level = makesResults(monitor, now) ? HealthLevel::kDegraded : HealthLevel::kNoOutput;
  }
  if (monitor.health() != HealthLevel::kOk) {
    state.faults.insert(state.faults.begin(), monitor.healthReason());
    state.level = std::max(state.level, monitor.health());
  }
  return state;
}

bool StageHealth::makesResults(const StageMonitor& monitor, Stamp now) const {
  return monitor.lastResult() && secondsBetween(*monitor.lastResult(), now) <= silence_after_;
}

std::vector<std::string> StageHealth::inputFaults(const StageMonitor& monitor, Stamp now,
                                                  const PublishedType& published_type) const {
  std::vector<std::string> faults;
  for (const WatchedInput& watched : inputs_) {
    const InputStatus input = monitor.input(watched.name, now);
    if (!input.silence) {
      faults.push_back("no " + watched.name + " yet: " + whyNotReceived(watched, published_type) +
                       " (" + nameAndTopics(watched) + ")");
    } else if (*input.silence > silence_after_) {
      faults.push_back("no " + watched.name + " for " + inSeconds(*input.silence));
    }
  }
  return faults;
}

}  // namespace datmo
