// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/sensor_model/stereo_alignment.h"

namespace datmo {

/// Without what the terms' errors have in common, and without what was refused.
StereoAlignmentMessagePtr toMessage(const StereoAlignment& alignment, const std::string& frame);

/// Throws InputError (`bad_alignment`) for numbers that are not finite and variances below 0.
StereoAlignment fromMessage(const StereoAlignmentMessage& message);

}  // namespace datmo
