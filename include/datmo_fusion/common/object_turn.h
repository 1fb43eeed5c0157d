// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Makes the left side of the box its front (a quarter turn); the object does not move.
void turnByQuarter(Object& object);

}  // namespace datmo
