// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// A possible source of an input: a topic (resolved) and its message type.
struct InputTopic {
  std::string topic;
  std::string data_type;
};

/// An input of a stage whose silence is a fault, with its possible topics.
struct WatchedInput {
  std::string name;
  std::vector<InputTopic> topics;
};

/// Returns the type with which a topic is published; empty: it has no publisher; none: the master
/// has not answered.
using PublishedType = std::function<std::optional<std::string>(const std::string& topic)>;

/// "scan on /scan or /echoes".
std::string nameAndTopics(const WatchedInput& input);

/// Whether an input is published with the right type.
bool isPublished(const WatchedInput& input, const PublishedType& published_type);

/// Returns why no message of an input can be received: "it has no publisher", "it is published as
/// A, expected B", "it is published, but no message has been received", or "the master has not
/// answered".
std::string whyNotReceived(const WatchedInput& input, const PublishedType& published_type);

/// Topics of a stage, resolved.
struct StageTopics {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
};

/// State of one stage, for people and other programs.
struct StageState {
  std::string stage;
  HealthLevel level = HealthLevel::kOk;
  std::vector<std::string> faults;  ///< those that prevent output come first
  StageTopics topics;
};

/// Judges a stage by its monitor, periodically.
class StageHealth {
 public:
  /// `silence_after`: s without message or result that count as a fault.
  StageHealth(std::vector<WatchedInput> inputs, double silence_after);

  /// Returns level and faults since the last call. `now`: ROS time.
  StageState judge(const StageMonitor& monitor, Stamp now, const PublishedType& published_type);

 private:
  std::vector<std::string> inputFaults(const StageMonitor& monitor, Stamp now,
                                       const PublishedType& published_type) const;
  bool makesResults(const StageMonitor& monitor, Stamp now) const;

  std::vector<WatchedInput> inputs_;
  double silence_after_;
  std::uint64_t drops_ = 0;     ///< judged so far
  std::uint64_t warnings_ = 0;  ///< judged so far
};

}  // namespace datmo
