// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stamp_check.h"

#include <string>

#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_range.h"

namespace datmo {

Stamp toStamp(const ros::Time& time) { return {static_cast<std::int64_t>(time.toNSec())}; }

ros::Time toTime(Stamp stamp) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(stamp.nanoseconds));
  return time;
}

void checkHasBegun(Stamp now) {
  if (now <= Stamp()) {
    throw InputError("no_ros_time", "measured at ROS time " + std::to_string(now.seconds()) +
                                        " s: expected more than 0 (with use_sim_time, from "
                                        "/clock); drops what is measured until then");
  }
}

void StreamOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"restart_after", "s",
       "a stamp older than the newest by this or more is a jump of the clock back (a looped bag) "
       "once ROS time or a second message confirms it; one newer by as much is a jump ahead if a "
       "second message confirms it and ROS time does not; both clear all state. One that is less "
       "old is late and is dropped"},
      restart_after, {0.1, 60.0});
  visitor.number({"silence_after", "s", "an input that is silent for longer than this is reported"},
                 silence_after, {0.1, 60.0});
}

void StampCheck::checkValue(const ros::Time& time) {
  if (time.isZero()) {
    throw InputError("zero_stamp", "stamp 0: expected the time of the measurement");
  }
  checkStampRange(time);
}

Arrival StampCheck::check(const ros::Time& time, const std::optional<Stamp>& now,
                          const std::optional<Stamp>& others) {
  checkValue(time);
  const auto newest = gate_.newest();
  switch (gate_.judge(toStamp(time), now, others)) {
    case StampVerdict::kRepeated:
      throw InputError("repeated_stamp", "stamp " + std::to_string(time.toSec()) +
                                             " s twice: expected each message once");
    case StampVerdict::kOld:
      throw InputError("old_stamp", "stamp " + std::to_string(time.toSec()) +
                                        " s: expected one later than the newest, " +
                                        std::to_string(newest->seconds()) + " s");
    case StampVerdict::kStray:
      throw InputError(
          "stray_stamp",
          "stamp " + std::to_string(time.toSec()) + " s, the newest is " +
              std::to_string(newest->seconds()) +
              " s: expected the next one of its stream; drops it, and accepts the jump of the "
              "clock when a second message confirms it and no other input contradicts it");
    case StampVerdict::kRestart:
      return Arrival::kRestart;
    case StampVerdict::kAhead:
      return Arrival::kAhead;
    case StampVerdict::kAccept:
      break;
  }
  return Arrival::kNext;
}

}  // namespace datmo
