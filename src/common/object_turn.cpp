// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/object_turn.h"

#include "datmo_fusion/common/angle.h"

namespace datmo {

void turnByQuarter(Object& object) {
  const auto [front, rear, left, right] = object.side_variance;
  object.side_variance = {left, right, rear, front};
  const Pose2& center = object.box.center;
  object.box = {Pose2(center.position(), center.heading() + kQuarterTurn), object.box.width,
                object.box.length};
}

}  // namespace datmo
