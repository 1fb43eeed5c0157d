// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/box2.h"

#include <algorithm>
#include <cmath>

namespace datmo {

std::array<Point2, 4> Box2::corners() const {
  const double x = 0.5 * length;
  const double y = 0.5 * width;
  return {center * Point2(x, y), center * Point2(-x, y), center * Point2(-x, -y),
          center * Point2(x, -y)};
}

bool Box2::contains(const Point2& point) const { return distanceTo(point) == 0.0; }

double Box2::distanceTo(const Point2& point) const {
  const Point2 local = Pose2(Point2::Zero(), -center.heading()).rotate(point - center.position());
  const double dx = std::max(0.0, std::abs(local.x()) - 0.5 * length);
  const double dy = std::max(0.0, std::abs(local.y()) - 0.5 * width);
  return std::hypot(dx, dy);
}

}  // namespace datmo
