// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_runner.h"

#include <cmath>
#include <utility>

namespace datmo {

StageRunner::StageRunner(StageMonitor& monitor, const StreamOptions& input, std::string effect,
                         std::function<void()> reset)
    : monitor_(monitor),
      restart_after_(input.restart_after),
      effect_(std::move(effect)),
      reset_(std::move(reset)) {}

void StageRunner::check(const std::string& input, const ros::Time& stamp) {
  const Arrival arrival = arrivalOf(input, stamp);
  if (arrival == Arrival::kNext) {
    return;
  }
  streams_.clear();
  monitor_.forgetInputs();
  arrivalOf(input, stamp);
  reset("clock_restart",
        std::string("the clock jumped ") + (arrival == Arrival::kRestart ? "back" : "ahead"));
}

Arrival StageRunner::arrivalOf(const std::string& input, const ros::Time& stamp) {
  const std::optional<Stamp>& now = monitor_.now();
  Stream& stream =
      streams_.try_emplace(input, Stream{StampCheck(restart_after_), {}, {}}).first->second;
  StampCheck::checkValue(stamp);
  stream.last = toStamp(stamp);
  stream.arrived = now;
  const Arrival arrival = stream.stamps.check(stamp, now, lastOfOthers(input));
  monitor_.noteInput(toStamp(stamp));
  return arrival;
}

std::optional<Stamp> StageRunner::lastOfOthers(const std::string& input) const {
  const Stream* newest = nullptr;
  for (const auto& [name, stream] : streams_) {
    const bool is_present =
        name != input && stream.arrived &&
        std::abs(secondsBetween(*stream.arrived, *monitor_.now())) < restart_after_;
    if (is_present && (newest == nullptr || *newest->arrived < *stream.arrived)) {
      newest = &stream;
    }
  }
  return newest == nullptr ? std::nullopt : std::optional<Stamp>(newest->last);
}

void StageRunner::reset(const std::string& reason, const std::string& why) {
  monitor_.warned(InputError(reason, why + ": " + effect_));
  monitor_.noteReset();
  if (reset_) {
    reset_();
  }
}

}  // namespace datmo
