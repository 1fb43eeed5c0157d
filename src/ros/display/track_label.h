// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// Returns "#id class speed": the class only if known, the speed only if moving.
std::string labelText(const TrackMessage& track);

}  // namespace datmo
