// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/box_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/turned.h"

namespace datmo {

namespace {

/// Share of a move that a search for its contact advances by at least, so that a body of
/// absurd size or spin costs a bounded time.
constexpr double kMinAdvance = 2.5e-4;

}  // namespace

double reachAlong(const Point2& axis, const BodyPose& pose, const BodySize& size) {
  return size.half_length * std::abs(axis.dot(pose.direction)) +
         size.half_width * std::abs(axis.dot(perpendicular(pose.direction)));
}

BodyPose bodyPose(const Point2& center, double heading) {
  return {center, heading, {std::cos(heading), std::sin(heading)}};
}

double BodySize::radius() const {
  return std::sqrt(half_length * half_length + half_width * half_width);
}

BodySize bodySize(const Box2& box) { return {0.5 * box.length, 0.5 * box.width}; }

Separation separation(const BodyPose& a, const BodySize& size_a, const BodyPose& b,
                      const BodySize& size_b) {
  const Point2 apart = b.center - a.center;
  const std::array<Point2, 4> axes{a.direction, perpendicular(a.direction), b.direction,
                                   perpendicular(b.direction)};
  Separation best;
  bool first = true;
  for (const Point2& axis : axes) {
    const double along = axis.dot(apart);
    const double gap = std::abs(along) - reachAlong(axis, a, size_a) - reachAlong(axis, b, size_b);
    if (first || gap > best.gap) {
      best.gap = gap;
      best.axis = along < 0.0 ? Point2(-axis) : axis;
      first = false;
    }
  }
  return best;
}

BodyPose BodyMove::at(double share) const {
  const Point2 center = from.center + share * (to.center - from.center);
  const double turn = share * (to.heading - from.heading);
  return {center, from.heading + turn, turned(from.direction, turn)};
}

std::optional<double> firstContact(const BodyMove& a, const BodyMove& b) {
  const double radius_a = a.size.radius();
  const double radius_b = b.size.radius();
  if (!circlesMeet({a.from.center, a.to.center, radius_a},
                   {b.from.center, b.to.center, radius_b})) {
    return std::nullopt;
  }
  const Point2 drift = (b.to.center - b.from.center) - (a.to.center - a.from.center);
  const double turning = std::abs(a.to.heading - a.from.heading) * radius_a +
                         std::abs(b.to.heading - b.from.heading) * radius_b;
  double share = 0.0;
  while (share <= 1.0) {
    const Separation apart = separation(a.at(share), a.size, b.at(share), b.size);
    if (apart.gap <= kTouching) {
      return share;
    }
    // Over the rest of the move, the gap along this axis closes no faster than this.
    const double closing = turning - apart.axis.dot(drift);
    if (closing <= 0.0) {
      return std::nullopt;
    }
    share += std::max(kMinAdvance, (apart.gap - 0.5 * kTouching) / closing);
  }
  return std::nullopt;
}

const char* nameOf(StruckSide side) {
  switch (side) {
    case StruckSide::kNone:
      break;
    case StruckSide::kFront:
      return "front";
    case StruckSide::kRear:
      return "rear";
    case StruckSide::kLeft:
      return "left";
    case StruckSide::kRight:
      return "right";
  }
  return "none";
}

StruckSide struckSide(const BodyPose& a, const BodySize& size_a, const BodyPose& b,
                      const BodySize& size_b) {
  const Point2 apart = b.center - a.center;
  const double ahead = a.direction.dot(apart);
  const double aside = perpendicular(a.direction).dot(apart);
  const double gap_ahead =
      std::abs(ahead) - size_a.half_length - reachAlong(a.direction, b, size_b);
  const double gap_aside =
      std::abs(aside) - size_a.half_width - reachAlong(perpendicular(a.direction), b, size_b);
  if (gap_ahead >= gap_aside) {
    return ahead >= 0.0 ? StruckSide::kFront : StruckSide::kRear;
  }
  return aside >= 0.0 ? StruckSide::kLeft : StruckSide::kRight;
}

}  // namespace datmo
