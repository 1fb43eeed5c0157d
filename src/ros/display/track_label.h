// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// "#id class speed": the class only where it is known, the speed only of what moves.
std::string labelText(const TrackMessage& track);

}  // namespace datmo
