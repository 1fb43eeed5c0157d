// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/sensor_model/stereo_alignment.h"

namespace datmo {

/// Omits the covariances between the terms, and what was rejected.
StereoAlignmentMessagePtr toMessage(const StereoAlignment& alignment, const std::string& frame);

/// Throws InputError (`bad_alignment`) for non-finite numbers and negative variances.
StereoAlignment fromMessage(const StereoAlignmentMessage& message);

}  // namespace datmo
