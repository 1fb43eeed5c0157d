// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_extension.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// Turn of the vehicle since its last border after which it is on another road, rad.
constexpr double kMaxTurn = 0.8;

/// Distance driven for which a side without any border is assumed to keep its last one, m.
constexpr double kMemoryDistance = 50.0;

std::size_t indexOf(RoadSide side) { return side == RoadSide::kLeft ? 0 : 1; }

/// Pose at one point, heading away from another one.
Pose2 away(const Point2& point, const Point2& from) {
  const Point2 direction = point - from;
  return {point, std::atan2(direction.y(), direction.x())};
}

}  // namespace

void RoadExtensionOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"length", "m", "how far a border is assumed to continue beyond its end; 0: it does not"},
      length, {0.0, 200.0});
}

RoadExtension::RoadExtension(const Checked<RoadExtensionOptions>& options) : options_(*options) {}

void RoadExtension::addEnds(const RoadBorder& border, Side& side) {
  const std::vector<BorderPoint>& points = border.points;
  side.ends.push_back(away(points[0].position, points[1].position));
  side.ends.push_back(away(points[points.size() - 1].position, points[points.size() - 2].position));
}

void RoadExtension::remember(const RoadBorder& border, const Pose2& base_in_map, Side& side) const {
  const Pose2 map_in_base = base_in_map.inverse();
  for (std::size_t i = 0; i + 1 < border.points.size(); ++i) {
    const Point2& from = border.points[i].position;
    const Point2& to = border.points[i + 1].position;
    if ((map_in_base * from).x() <= 0.0 && (map_in_base * to).x() >= 0.0) {
      side.last = away(to, from);
      side.seen_from = base_in_map.position();
    }
  }
}

void RoadExtension::update(const RoadModel& road, const Pose2& base_in_map) {
  for (Side& side : sides_) {
    side.ends.clear();
  }
  for (const RoadBorder& border : road.borders) {
    if (!border.side_street && border.points.size() > 1) {
      Side& side = sides_[indexOf(border.side)];
      addEnds(border, side);
      remember(border, base_in_map, side);
    }
  }
  for (Side& side : sides_) {
    const bool is_over =
        side.last &&
        ((side.seen_from - base_in_map.position()).norm() > kMemoryDistance ||
         std::abs(angleBetween(side.last->heading(), base_in_map.heading())) > kMaxTurn);
    if (is_over) {
      side.last.reset();
    }
  }
}

std::optional<BorderOffset> RoadExtension::offset(RoadSide which, const Point2& position) const {
  const Side& side = sides_[indexOf(which)];
  const double outward_is_left = outwardOf(which, 1.0);
  std::optional<BorderOffset> result;
  double min = options_.length;
  // Each border has two ends: the first points back, the second ahead.
  for (std::size_t i = 0; i < side.ends.size(); ++i) {
    const Point2 seen = side.ends[i].inverse() * position;
    const double ahead = i % 2 == 1 ? 1.0 : -1.0;
    if (seen.x() > 0.0 && seen.x() < min) {
      min = seen.x();
      result = BorderOffset{outward_is_left * ahead * seen.y(), 0.0,
                            side.ends[i].rotate(Point2::UnitX())};
    }
  }
  if (side.ends.empty() && side.last) {
    result = BorderOffset{outward_is_left * (side.last->inverse() * position).y(), 0.0,
                          side.last->rotate(Point2::UnitX())};
  }
  return result;
}

void RoadExtension::reset() { sides_ = {}; }

}  // namespace datmo
