// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "datmo_fusion/ros/stage/stage_health.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Progress report at the start of a stage for people: which inputs have been received and what
/// they look like, which are missing, and on which topics. Not thread safe.
class InputProgress {
 public:
  /// A line for the console.
  struct Line {
    bool is_warning = false;
    std::string text;
  };

  explicit InputProgress(std::vector<WatchedInput> inputs);

  /// Returns what is new since the last call. `seconds`: since the start, wall clock.
  std::vector<Line> news(const StageMonitor& monitor, double seconds,
                         const PublishedType& published_type);

 private:
  std::string firstMessages(const StageMonitor& monitor);
  std::string waitingFor(const StageMonitor& monitor) const;
  std::vector<Line> missing(const StageMonitor& monitor, const PublishedType& published_type) const;

  std::vector<WatchedInput> inputs_;  ///< by name
  std::set<std::string> reported_;
  bool missing_reported_ = false;
};

}  // namespace datmo
