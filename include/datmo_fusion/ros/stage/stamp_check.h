// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <ros/time.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp_gate.h"

namespace datmo {

Stamp toStamp(const ros::Time& time);
ros::Time toTime(Stamp stamp);

/// Throws InputError (`no_ros_time`) for a time at which ROS time had not begun: with use_sim_time,
/// it stands at 0 until the first message on /clock, and nothing can be stamped.
void checkHasBegun(Stamp now);

/// How a stage checks the stamps of its inputs.
struct StreamOptions {
  double restart_after = 1.0;  ///< s
  double silence_after = 1.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Whether a message continues the stream, or begins a new run of a clock that has jumped back (a
/// looped bag) or ahead.
enum class Arrival { kNext, kRestart, kAhead };

/// Input check of a stream of stamped messages; afterwards stamps only rise.
class StampCheck {
 public:
  explicit StampCheck(double restart_after) : gate_(restart_after) {}

  /// Throws InputError for an invalid stamp (`zero_stamp`, `stamp_out_of_range`).
  static void checkValue(const ros::Time& time);

  /// `now`: ROS time of the message's arrival; `others`: as in StampGate. Throws InputError for a
  /// stamp of zero (`zero_stamp`), one out of range (`stamp_out_of_range`), a repeated one
  /// (`repeated_stamp`), one that is too old (`old_stamp`), and one that is far off without
  /// confirmation that the clock has jumped (`stray_stamp`).
  Arrival check(const ros::Time& time, const std::optional<Stamp>& now = std::nullopt,
                const std::optional<Stamp>& others = std::nullopt);

 private:
  StampGate gate_;
};

}  // namespace datmo
