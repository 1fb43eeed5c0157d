// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stamp_range.h"

#include <cmath>
#include <string>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// The first second of the year 2100.
constexpr double kEnd = 4102444800.0;

}  // namespace

bool isInStampRange(Stamp stamp) { return stamp.nanoseconds >= 0 && stamp.seconds() < kEnd; }

void checkStampRange(const ros::Time& time) {
  checkStampRange(Stamp::fromSeconds(static_cast<double>(time.sec)));
}

void checkStampRange(Stamp stamp) {
  if (!isInStampRange(stamp)) {
    throw InputError(
        "stamp_out_of_range",
        "stamp " + std::to_string(std::llround(stamp.seconds())) +
            " s: expected seconds since 1970, before the year 2100; check the sender's clock");
  }
}

}  // namespace datmo
