// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// Returns whether a stamp is from 1970 to 2099.
bool isInStampRange(Stamp stamp);

/// Throws InputError (`stamp_out_of_range`) for a stamp of 2100 or later, which is unset or
/// corrupt. ros::Time ends in 2106 and throws std::runtime_error if a sum exceeds that.
void checkStampRange(const ros::Time& time);

/// The same for a stamp that did not originate as ros::Time; also rejects times before 1970.
void checkStampRange(Stamp stamp);

}  // namespace datmo
