// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// Throws InputError (`stamp_out_of_range`) for a stamp after the year 2100: it was not set, or its
/// bytes are broken. ros::Time ends in 2106, and throws std::runtime_error where a sum goes beyond.
void checkStampRange(const ros::Time& time);

/// The same of a stamp that was not a ros::Time before; also for one before 1970.
void checkStampRange(Stamp stamp);

}  // namespace datmo
