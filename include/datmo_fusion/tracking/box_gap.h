#pragma once

#include "datmo_fusion/common/box2.h"

namespace datmo_fusion {

/// Width of the widest empty strip between two rectangles, parallel to a side of one of them (m); 0
/// where they touch or overlap (separating axes: Gottschalk, Lin, Manocha, OBBTree, 1996).
double gapBetween(const Box2& a, const Box2& b);

}  // namespace datmo_fusion
