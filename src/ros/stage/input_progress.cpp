// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/input_progress.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// s after which a missing input is named: drivers have started by then.
constexpr double kPatience = 5.0;

}  // namespace

InputProgress::InputProgress(Topics topics) : topics_(std::move(topics)) {}

void InputProgress::addTopic(const std::string& input, const std::string& topic) {
  topics_[input].push_back(topic);
}

std::vector<InputProgress::Line> InputProgress::news(const StageMonitor& monitor, double seconds,
                                                     const IsPublished& is_published) {
  std::vector<Line> lines;
  const std::string first = firstMessages(monitor);
  if (!first.empty()) {
    lines.push_back({false, first + waitingFor(monitor)});
  }
  if (seconds > kPatience && !missing_said_) {
    missing_said_ = true;
    const std::vector<Line> absent = missing(monitor, is_published);
    lines.insert(lines.end(), absent.begin(), absent.end());
  }
  return lines;
}

std::string InputProgress::firstMessages(const StageMonitor& monitor) {
  std::string text;
  for (const auto& [input, topics] : topics_) {
    if (monitor.hasReceived(input) && said_.insert(input).second) {
      const std::string description = monitor.description(input);
      text += (text.empty() ? "first " : ", first ") + on(input) +
              (description.empty() ? "" : ": " + description);
    }
  }
  return text;
}

std::string InputProgress::waitingFor(const StageMonitor& monitor) const {
  std::string text;
  for (const auto& [input, topics] : topics_) {
    if (!monitor.hasReceived(input)) {
      text += (text.empty() ? "; waiting for " : ", ") + on(input);
    }
  }
  return text;
}

std::vector<InputProgress::Line> InputProgress::missing(const StageMonitor& monitor,
                                                        const IsPublished& is_published) const {
  std::vector<Line> lines;
  for (const auto& [input, topics] : topics_) {
    if (!monitor.hasReceived(input)) {
      const bool published = std::any_of(topics.begin(), topics.end(), is_published);
      lines.push_back({!published, "waits for " + on(input) +
                                       (published ? ": it is published, but no message has come"
                                                  : ": nobody publishes it")});
    }
  }
  return lines;
}

std::string InputProgress::on(const std::string& input) const {
  std::string text;
  for (const std::string& topic : topics_.at(input)) {
    text += (text.empty() ? input + " on " : " or ") + topic;
  }
  return text;
}

}  // namespace datmo
