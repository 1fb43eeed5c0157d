// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include <ros/time.h>

#include "datmo_fusion/ros/convert/descriptions.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// Common message handling of all stages: bad messages are dropped and counted, the stamps of each
/// input must rise, a clock that jumps back (a looped bag) or ahead resets the stage, and results
/// are timed. Not thread safe.
class StageRunner {
 public:
  /// `effect`: the effect of a reset, for people: "forgets the road"; `reset` performs it, and may
  /// be empty. `monitor`, and what `reset` refers to, must outlive the runner.
  StageRunner(StageMonitor& monitor, const StreamOptions& input, std::string effect,
              std::function<void()> reset = {});
  StageRunner(const StageRunner&) = delete;
  StageRunner& operator=(const StageRunner&) = delete;

  /// Runs `handle` on one message and returns its result. If it throws InputError the message is
  /// dropped and reported to the monitor, and the result is default constructed: null, none. If the
  /// last output was rejected (OutputCheck), the stage is reset first.
  template <typename Handle>
  auto serve(const Handle& handle) -> decltype(handle()) {
    watch_ = Stopwatch();
    if (monitor_.handleResetRequest()) {
      reset("bad_output", "its output could not be used");
    }
    try {
      return handle();
    } catch (const InputError& error) {
      monitor_.dropped(error);
    }
    return decltype(handle())();
  }

  /// The same for an input whose first message is described to the user.
  template <typename Message, typename Handle>
  auto serve(const std::string& input, const Message& message, const Handle& handle)
      -> decltype(handle()) {
    monitor_.describe(input, [&] { return descriptionOf(message); });
    return serve(handle);
  }

  /// Checks a message's stamp against the last one of its input. If the clock has jumped, as
  /// confirmed by ROS time (StageMonitor::now) or a second message and not contradicted by another
  /// input, all inputs start over and the stage is reset before this returns. Call it after all
  /// other checks of the message. Throws InputError (`zero_stamp`, `repeated_stamp`, `old_stamp`,
  /// `stray_stamp`).
  void check(const std::string& input, const ros::Time& stamp);

  /// Resets the stage with a warning. `reason`: as in InputError; `why`: "the map is another".
  void reset(const std::string& reason, const std::string& why);

  /// Reports that the current message yielded a result with this stamp.
  void processed(Stamp stamp) { monitor_.processed({stamp, watch_.seconds()}); }

  StageMonitor& monitor() { return monitor_; }

 private:
  struct Stream {
    StampCheck stamps;
    Stamp last;  ///< last stamp that passed the other checks, including stray ones
    std::optional<Stamp> arrived;  ///< ROS time of its arrival
  };

  Arrival arrivalOf(const std::string& input, const ros::Time& stamp);

  /// Stamp of the message that arrived last on any other input; none if none arrived lately.
  std::optional<Stamp> lastOfOthers(const std::string& input) const;

  StageMonitor& monitor_;
  double restart_after_;
  std::string effect_;
  std::function<void()> reset_;
  std::map<std::string, Stream> streams_;  ///< by input
  Stopwatch watch_;                        ///< since the current message was received
};

}  // namespace datmo
