// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Takes another side for the front, a quarter turn to the left: nothing moves.
void turnByQuarter(Object& object);

}  // namespace datmo
