// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_runner.h"

#include <utility>

namespace datmo {

StageRunner::StageRunner(StageMonitor& monitor, const StreamOptions& input, std::string effect,
                         std::function<void()> reset)
    : monitor_(monitor),
      restart_after_(input.restart_after),
      effect_(std::move(effect)),
      reset_(std::move(reset)) {}

void StageRunner::check(const std::string& input, const ros::Time& stamp) {
  const std::optional<Stamp>& now = monitor_.now();
  if (streams_.try_emplace(input, restart_after_).first->second.check(stamp, now) ==
      Arrival::kNext) {
    return;
  }
  streams_.clear();
  streams_.try_emplace(input, restart_after_).first->second.check(stamp, now);
  reset("clock_restart", "the clock jumped back");
}

void StageRunner::reset(const std::string& reason, const std::string& why) {
  monitor_.warned(InputError(reason, why + ": " + effect_));
  monitor_.noteReset();
  if (reset_) {
    reset_();
  }
}

}  // namespace datmo
