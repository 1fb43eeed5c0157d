// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stamp_range.h"

#include <string>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// The first second of the year 2100.
constexpr std::uint32_t kEnd = 4102444800U;

}  // namespace

void checkStampRange(const ros::Time& time) {
  if (time.sec >= kEnd) {
    throw InputError("stamp_out_of_range", "stamp " + std::to_string(time.sec) +
                                               " s: expected seconds since 1970, before the year "
                                               "2100; check the clock of who sends it");
  }
}

}  // namespace datmo
