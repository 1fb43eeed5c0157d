// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/box_extent.h"

#include <cmath>

namespace datmo {

double extentAlong(const Box2& box, const Point2& direction) {
  const Point2 local = box.center.rotation().transpose() * direction;
  return box.length * std::abs(local.x()) + box.width * std::abs(local.y());
}

}  // namespace datmo
