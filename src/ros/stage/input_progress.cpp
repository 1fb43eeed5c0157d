// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/input_progress.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// s after which a missing input is reported: drivers have started by then.
constexpr double kPatience = 5.0;

}  // namespace

InputProgress::InputProgress(std::vector<WatchedInput> inputs) : inputs_(std::move(inputs)) {
  std::sort(inputs_.begin(), inputs_.end(), [](const WatchedInput& one, const WatchedInput& other) {
    return one.name < other.name;
  });
}

std::vector<InputProgress::Line> InputProgress::news(const StageMonitor& monitor, double seconds,
                                                     const PublishedType& published_type) {
  std::vector<Line> lines;
  const std::string first = firstMessages(monitor);
  if (!first.empty()) {
    lines.push_back({false, first + waitingFor(monitor)});
  }
  if (seconds > kPatience && !missing_reported_) {
    missing_reported_ = true;
    const std::vector<Line> absent = missing(monitor, published_type);
    lines.insert(lines.end(), absent.begin(), absent.end());
  }
  return lines;
}

std::string InputProgress::firstMessages(const StageMonitor& monitor) {
  std::string text;
  for (const WatchedInput& input : inputs_) {
    if (monitor.hasReceived(input.name) && reported_.insert(input.name).second) {
      const std::string description = monitor.description(input.name);
      text += (text.empty() ? "first " : ", first ") + nameAndTopics(input) +
              (description.empty() ? "" : ": " + description);
    }
  }
  return text;
}

std::string InputProgress::waitingFor(const StageMonitor& monitor) const {
  std::string text;
  for (const WatchedInput& input : inputs_) {
    if (!monitor.hasReceived(input.name)) {
      text += (text.empty() ? "; waiting for " : ", ") + nameAndTopics(input);
    }
  }
  return text;
}

std::vector<InputProgress::Line> InputProgress::missing(const StageMonitor& monitor,
                                                        const PublishedType& published_type) const {
  std::vector<Line> lines;
  for (const WatchedInput& input : inputs_) {
    if (!monitor.hasReceived(input.name)) {
      lines.push_back(
          {!isPublished(input, published_type),
           "waits for " + nameAndTopics(input) + ": " + whyNotReceived(input, published_type)});
    }
  }
  return lines;
}

}  // namespace datmo
