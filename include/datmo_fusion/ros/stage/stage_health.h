// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Where an input may come from: a topic (resolved) and the type of its messages.
struct InputTopic {
  std::string topic;
  std::string data_type;
};

/// An input of a stage whose silence is a fault, on one of its topics.
struct WatchedInput {
  std::string name;
  std::vector<InputTopic> topics;
};

/// Type with which somebody publishes a topic; empty: nobody does.
using PublishedType = std::function<std::string(const std::string& topic)>;

/// "scan on /scan or /echoes".
std::string nameAndTopics(const WatchedInput& input);

/// Whether somebody publishes an input with the right type.
bool isPublished(const WatchedInput& input, const PublishedType& published_type);

/// Why no message of an input can come: "nobody publishes it", "it is published as A, expected B",
/// or "it is published, but no message has come".
std::string whyNothingComes(const WatchedInput& input, const PublishedType& published_type);

/// Topics of a stage, resolved.
struct StageTopics {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
};

/// One stage, as a person or the next program asks for it.
struct StageState {
  std::string stage;
  HealthLevel level = HealthLevel::kOk;
  std::vector<std::string> faults;  ///< what keeps it from working comes first
  StageTopics topics;
};

/// Judges a stage by its monitor, once in a while.
class StageHealth {
 public:
  /// `silence_after`: s without message or result that are a fault.
  StageHealth(std::vector<WatchedInput> inputs, double silence_after);

  /// Level and faults since the last call. `now`: ROS time.
  StageState judge(const StageMonitor& monitor, Stamp now, const PublishedType& published_type);

 private:
  std::vector<std::string> inputFaults(const StageMonitor& monitor, Stamp now,
                                       const PublishedType& published_type) const;
  bool makesResults(const StageMonitor& monitor, Stamp now) const;

  std::vector<WatchedInput> inputs_;
  double silence_after_;
  std::uint64_t drops_ = 0;     ///< judged so far
  std::uint64_t warnings_ = 0;  ///< the same
};

}  // namespace datmo
