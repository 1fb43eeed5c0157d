// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <ros/time.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp_gate.h"

namespace datmo {

Stamp toStamp(const ros::Time& time);
ros::Time toTime(Stamp stamp);

/// How a stage judges the time of its inputs.
struct StreamOptions {
  double restart_after = 1.0;  ///< s
  double silence_after = 1.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Whether a message goes on with the stream, or begins a new run of a clock that has jumped back
/// (a looped bag) or ahead.
enum class Arrival { kNext, kRestart, kAhead };

/// Input check of a stream of stamped messages: time behind it only goes forward.
class StampCheck {
 public:
  explicit StampCheck(double restart_after) : gate_(restart_after) {}

  /// Throws InputError for a stamp that is none (`zero_stamp`, `stamp_out_of_range`).
  static void checkValue(const ros::Time& time);

  /// `now`: ROS time at which the message came; `others`: as StampGate has them. Throws InputError
  /// for a stamp of zero (`zero_stamp`), one beyond reason (`stamp_out_of_range`), one that was
  /// there before
  /// (`repeated_stamp`), one that comes too late (`old_stamp`), and one that is far off while
  /// nothing confirms that the clock has jumped (`stray_stamp`).
  Arrival check(const ros::Time& time, const std::optional<Stamp>& now = std::nullopt,
                const std::optional<Stamp>& others = std::nullopt);

 private:
  StampGate gate_;
};

}  // namespace datmo
