// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/repeat_filter.h"

namespace datmo {

/// One input of a stage, as seen by its receiver.
struct InputStatus {
  std::uint64_t received = 0;
  double rate = 0.0;              ///< Hz, over the last messages
  std::optional<double> silence;  ///< s since the last message; none before the first
};

/// One message that was processed to a result.
struct Processed {
  Stamp stamp;           ///< of the measurement
  double seconds = 0.0;  ///< processing time
};

/// Health of a stage, or of the stack.
enum class HealthLevel {
  kOk,
  kDegraded,  ///< something is missing or wrong, but there are results
  kNoOutput,  ///< there are no usable results
};

/// Processing times over the last messages, s; 0 before the first.
struct TimingStatus {
  double median = 0.0;
  double percentile_99 = 0.0;
  double max = 0.0;
};

/// Counts a stage's received and dropped messages and its processing times; reports faults on the
/// console, once per cause. Not thread safe.
class StageMonitor {
 public:
  /// `stage`: the nodelet's name; a leading slash is stripped.
  explicit StageMonitor(const std::string& stage);

  const std::string& stage() const { return stage_; }

  /// Sets the ROS time of all further reports.
  void setTime(Stamp now) { now_ = now; }

  /// None if no host has set it.
  const std::optional<Stamp>& now() const { return now_; }

  /// Reports the arrival of a message. `now`: ROS time, which is set by this call.
  void received(const std::string& input, Stamp now);

  /// Reports that a message with this stamp is used by the stage.
  void noteInput(Stamp stamp) { newest_input_ = std::max(stamp, newest_input_.value_or(stamp)); }

  /// Newest stamp since the inputs were last reset; none before the first message.
  const std::optional<Stamp>& newestInput() const { return newest_input_; }

  /// Reports that a message was processed to a result.
  void processed(const Processed& message);

  /// Reports that `count` messages were dropped for one cause.
  void dropped(const InputError& error, std::uint64_t count = 1);

  /// Reports that something is wrong or missing, but the stage continues.
  void warned(const InputError& error);

  /// Reports unusable output: the stage is reset at the next message (StageRunner).
  void requestReset() { reset_requested_ = true; }

  /// Returns whether a reset was requested since the last call.
  bool handleResetRequest() { return std::exchange(reset_requested_, false); }

  /// Reports that the clock of the inputs has jumped: they start over.
  void forgetInputs() { newest_input_.reset(); }

  /// Reports that the stage was reset.
  void noteReset() { ++resets_; }
  std::uint64_t resetCount() const { return resets_; }

  /// Sets a figure of merit of the last result, with its unit in the name: "weakest direction [m]".
  void figure(const std::string& name, double value) { figures_[name] = value; }

  /// Sets the stage's health from now on, and the reason, for people; a change is printed on the
  /// console.
  void condition(HealthLevel health, const std::string& why);

  /// Describes the messages of an input, for people: "360 beams to 8.0 m in laser". `description`
  /// is called only once.
  void describe(const std::string& input, const std::function<std::string()>& description);

  /// Announces an event on its first occurrence (the first track), once per `event`.
  void announce(const std::string& event, const std::string& text);

  bool hasReceived(const std::string& input) const { return inputs_.count(input) != 0; }

  /// Empty if there is none.
  std::string description(const std::string& input) const;

  /// Returns the announcements since the last call.
  std::vector<std::string> handleAnnouncements();

  InputStatus input(const std::string& name, Stamp now) const;
  TimingStatus timing() const;
  std::uint64_t processedCount() const { return processed_; }
  const Processed& lastProcessed() const { return last_processed_; }
  std::uint64_t droppedCount() const;
  std::uint64_t warningCount() const;

  /// By reason.
  const std::map<std::string, std::uint64_t>& drops() const { return drops_; }
  const std::map<std::string, std::uint64_t>& warnings() const { return warnings_; }

  const std::map<std::string, double>& figures() const { return figures_; }

  HealthLevel health() const { return health_; }

  /// Reason for the health level; empty at the start.
  const std::string& healthReason() const { return health_reason_; }

  /// The newest drop, the newest warning, and the newest of both; empty before the first.
  const std::string& lastDrop() const { return last_drop_; }
  const std::string& lastWarning() const { return last_warning_; }
  const std::string& lastError() const { return last_error_; }

  /// ROS time of the last result; none before the first, and if no time was set.
  const std::optional<Stamp>& lastResult() const { return last_result_; }

 private:
  struct Input {
    std::uint64_t count = 0;
    std::deque<Stamp> arrivals;  ///< the most recent ones
  };

  void say(const InputError& error, std::uint64_t count = 1);

  std::string stage_;
  std::map<std::string, Input> inputs_;
  std::map<std::string, std::uint64_t> drops_;
  std::map<std::string, std::uint64_t> warnings_;
  std::map<std::string, double> figures_;
  HealthLevel health_ = HealthLevel::kOk;
  std::string health_reason_;
  std::deque<double> times_;  ///< s, the most recent ones
  std::uint64_t processed_ = 0;
  Processed last_processed_;
  std::string last_drop_;
  std::string last_warning_;
  std::string last_error_;
  std::optional<Stamp> last_result_;
  std::optional<Stamp> now_;
  std::optional<Stamp> newest_input_;
  bool reset_requested_ = false;
  std::uint64_t resets_ = 0;
  RepeatFilter repeats_;
  std::map<std::string, std::string> descriptions_;  ///< by input
  std::set<std::string> events_;                     ///< announced
  std::vector<std::string> announcements_;           ///< not taken yet
};

/// Seconds since construction, for Processed::seconds.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace datmo
