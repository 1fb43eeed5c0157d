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

/// One input of a stage, as its receiver sees it.
struct InputStatus {
  std::uint64_t received = 0;
  double rate = 0.0;              ///< Hz, over the last messages
  std::optional<double> silence;  ///< s since the last message; none before the first
};

/// One message that has led to a result.
struct Processed {
  Stamp stamp;           ///< of the measurement
  double seconds = 0.0;  ///< it took
};

/// How well a stage, or the stack, does.
enum class HealthLevel {
  kOk,
  kDegraded,  ///< something is missing or wrong, but results come
  kNoOutput,  ///< and no usable result comes
};

/// Processing times over the last messages, s; 0 before the first.
struct TimingStatus {
  double median = 0.0;
  double percentile_99 = 0.0;
  double max = 0.0;
};

/// Counts what a stage receives, drops and needs in time; reports on the console what is
/// wrong, once for each cause. Not thread safe.
class StageMonitor {
 public:
  /// `stage`: the nodelet's name; a slash at its front is left out.
  explicit StageMonitor(const std::string& stage);

  const std::string& stage() const { return stage_; }

  /// What is said from here on happens at this ROS time.
  void setTime(Stamp now) { now_ = now; }

  /// None where no host has said it.
  const std::optional<Stamp>& now() const { return now_; }

  /// A message has come. `now`: ROS time, which is set by it.
  void received(const std::string& input, Stamp now);

  /// A message of this stamp serves the stage.
  void noteInput(Stamp stamp) { newest_input_ = std::max(stamp, newest_input_.value_or(stamp)); }

  /// The newest one since the inputs have begun; none before the first.
  const std::optional<Stamp>& newestInput() const { return newest_input_; }

  /// A message has led to a result.
  void processed(const Processed& message);

  /// So many messages were dropped for one cause.
  void dropped(const InputError& error, std::uint64_t count = 1);

  /// Something is wrong with a message or missing, but the stage goes on with it.
  void warned(const InputError& error);

  /// What the stage made cannot be used: it starts over with the next message (StageRunner).
  void requestReset() { reset_requested_ = true; }

  /// Whether it was requested since the last call.
  bool takeResetRequest() { return std::exchange(reset_requested_, false); }

  /// The clock of the inputs has jumped: they begin anew.
  void forgetInputs() { newest_input_.reset(); }

  /// The stage has started over.
  void noteReset() { ++resets_; }
  std::uint64_t resetCount() const { return resets_; }

  /// A figure of merit of the last result, with its unit:
  /// "weakest direction [m]".
  void figure(const std::string& name, double value) { figures_[name] = value; }

  /// How well the stage does its work from now on, and why, for people; a change is said on the
  /// console.
  void condition(HealthLevel health, const std::string& why);

  /// What the messages of an input look like, for people: "360 beams to 8.0 m in laser". Asked for
  /// once alone.
  void describe(const std::string& input, const std::function<std::string()>& description);

  /// Something that happens for the first time is worth a line: the first track. Once for each
  /// `event`.
  void announce(const std::string& event, const std::string& text);

  bool hasReceived(const std::string& input) const { return inputs_.count(input) != 0; }

  /// Empty if there is none.
  std::string description(const std::string& input) const;

  /// What was announced since the last call.
  std::vector<std::string> takeAnnouncements();

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

  /// Why it is as it is; empty at the start.
  const std::string& healthReason() const { return health_reason_; }

  /// The newest of either kind, and of both; empty before the first.
  const std::string& lastDrop() const { return last_drop_; }
  const std::string& lastWarning() const { return last_warning_; }
  const std::string& lastError() const { return last_error_; }

  /// ROS time of the last result; none before the first, and where nobody has said the time.
  const std::optional<Stamp>& lastResult() const { return last_result_; }

 private:
  struct Input {
    std::uint64_t count = 0;
    std::deque<Stamp> arrivals;  ///< the last ones
  };

  void say(const InputError& error, std::uint64_t count = 1);

  std::string stage_;
  std::map<std::string, Input> inputs_;
  std::map<std::string, std::uint64_t> drops_;
  std::map<std::string, std::uint64_t> warnings_;
  std::map<std::string, double> figures_;
  HealthLevel health_ = HealthLevel::kOk;
  std::string health_reason_;
  std::deque<double> times_;  ///< s, the last ones
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
