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

/// What each stage does with its messages besides converting them: a bad one is dropped and
/// counted, the stamps of each input go forward, a clock that jumps back (a looped bag) or ahead
/// resets the stage, and results are timed. Not thread safe.
class StageRunner {
 public:
  /// `effect`: what a reset does, for people: "forgets the road"; `reset` does it, and may be
  /// empty. `monitor`, and what `reset` refers to, must outlive the runner.
  StageRunner(StageMonitor& monitor, const StreamOptions& input, std::string effect,
              std::function<void()> reset = {});
  StageRunner(const StageRunner&) = delete;
  StageRunner& operator=(const StageRunner&) = delete;

  /// Runs `handle` on one message and returns its result. When it throws InputError the message is
  /// dropped through the monitor, and the result is a default one: null, none. Before that the
  /// stage is reset if its last output was refused (OutputCheck).
  template <typename Handle>
  auto serve(const Handle& handle) -> decltype(handle()) {
    watch_ = Stopwatch();
    if (monitor_.takeResetRequest()) {
      reset("bad_output", "what it made could not be used");
    }
    try {
      return handle();
    } catch (const InputError& error) {
      monitor_.dropped(error);
    }
    return decltype(handle())();
  }

  /// The same for a message of an input that a person reads about when its first one comes.
  template <typename Message, typename Handle>
  auto serve(const std::string& input, const Message& message, const Handle& handle)
      -> decltype(handle()) {
    monitor_.describe(input, [&] { return descriptionOf(message); });
    return serve(handle);
  }

  /// How a message's stamp follows the last one of its input. When the clock has jumped, which
  /// ROS time (StageMonitor::now) has confirmed or a second message, while no other input
  /// contradicts it, all inputs start over and the stage is reset before this returns. To be called
  /// when nothing else is wrong with the message.
  /// Throws InputError (`zero_stamp`, `repeated_stamp`, `old_stamp`, `stray_stamp`).
  void check(const std::string& input, const ros::Time& stamp);

  /// Resets the stage and warns of it. `reason`: as of an InputError; `why`: "the map is another".
  void reset(const std::string& reason, const std::string& why);

  /// The message that is served has led to a result of this stamp.
  void processed(Stamp stamp) { monitor_.processed({stamp, watch_.seconds()}); }

  StageMonitor& monitor() { return monitor_; }

 private:
  struct Stream {
    StampCheck stamps;
    Stamp last;                 ///< that passed the other checks, stray ones too
    std::optional<Stamp> came;  ///< ROS time then
  };

  Arrival arrivalOf(const std::string& input, const ros::Time& stamp);

  /// The last stamp that came on another input lately; none if there is none.
  std::optional<Stamp> lastOfOthers(const std::string& input) const;

  StageMonitor& monitor_;
  double restart_after_;
  std::string effect_;
  std::function<void()> reset_;
  std::map<std::string, Stream> streams_;  ///< by input
  Stopwatch watch_;                        ///< since the message was taken
};

}  // namespace datmo
