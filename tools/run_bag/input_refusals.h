// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Counts which messages of which topic the stages rejected, and why.
class InputRefusals {
 public:
  /// One reason for which messages of a topic were rejected.
  struct Reason {
    std::uint64_t messages = 0;
    std::string last;  ///< message for the last one
  };

  struct Topic {
    std::uint64_t received = 0;
    std::uint64_t refused = 0;
    std::map<std::string, Reason> reasons;
  };

  /// `monitors`: of the stages that receive messages first; they must outlive this.
  explicit InputRefusals(std::vector<const StageMonitor*> monitors)
      : monitors_(std::move(monitors)) {}

  /// To be called after a message of this topic has been processed: what its stages have dropped
  /// since the last call was this message.
  void book(const std::string& topic);

  const std::map<std::string, Topic>& topics() const { return topics_; }

  /// Throws NoUsableInput if all messages of a topic were rejected.
  void check() const;

 private:
  std::vector<const StageMonitor*> monitors_;
  std::map<const StageMonitor*, std::map<std::string, std::uint64_t>> seen_;  ///< drops by reason
  std::map<std::string, Topic> topics_;
};

}  // namespace datmo
