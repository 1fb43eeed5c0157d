// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_offset.h"

#include <cmath>

#include "datmo_fusion/common/cross.h"

namespace datmo {

namespace {

/// Offset of a point from one segment; none before its start or behind its end.
std::optional<BorderOffset> offsetFromLeg(const BorderPoint& from, const BorderPoint& to,
                                          RoadSide side, const Point2& point) {
  const Point2 leg = to.position - from.position;
  const Point2 to_point = point - from.position;
  const double along = to_point.dot(leg) / leg.squaredNorm();
  // Written so that a segment of length 0, whose `along` is NaN, is skipped.
  if (!(along >= 0.0 && along <= 1.0)) {
    return std::nullopt;
  }
  const Point2 direction = leg.normalized();
  const double to_left = cross(direction, to_point);
  return BorderOffset{outwardOf(side, to_left), from.sigma + along * (to.sigma - from.sigma),
                      direction};
}

}  // namespace

std::optional<BorderOffset> offsetFrom(const RoadBorder& border, const Point2& point) {
  std::optional<BorderOffset> nearest;
  for (std::size_t i = 0; i + 1 < border.points.size(); ++i) {
    const auto offset = offsetFromLeg(border.points[i], border.points[i + 1], border.side, point);
    if (offset && (!nearest || std::abs(offset->outward) < std::abs(nearest->outward))) {
      nearest = offset;
    }
  }
  return nearest;
}

}  // namespace datmo
