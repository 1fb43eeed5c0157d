// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// What a person reads of the start of a stage: which inputs have come and what they look like,
/// what is waited for, and on which topics. Not thread safe.
class InputProgress {
 public:
  /// A line for the console.
  struct Line {
    bool is_warning = false;
    std::string text;
  };

  /// Whether somebody publishes a topic.
  using IsPublished = std::function<bool(const std::string&)>;

  /// Of each input, resolved: a scan may come on one of two.
  using Topics = std::map<std::string, std::vector<std::string>>;

  explicit InputProgress(Topics topics);

  /// Another topic on which an input may come.
  void addTopic(const std::string& input, const std::string& topic);

  /// What is new since the last call. `seconds`: since the start, on the computer's clock.
  std::vector<Line> news(const StageMonitor& monitor, double seconds,
                         const IsPublished& is_published);

 private:
  std::string firstMessages(const StageMonitor& monitor);
  std::string waitingFor(const StageMonitor& monitor) const;
  std::vector<Line> missing(const StageMonitor& monitor, const IsPublished& is_published) const;
  std::string on(const std::string& input) const;

  Topics topics_;
  std::set<std::string> said_;
  bool missing_said_ = false;
};

}  // namespace datmo
