// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/fusion/wire/mapem.h"

namespace datmo {

/// DF NodeListXY of a lane.
void walkNodes(Uper& uper, MapLane& lane);

/// DF SpeedLimitList.
void skipSpeedLimits(Uper& uper);

}  // namespace datmo
