// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/border_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "datmo_fusion/road/border_offset.h"

namespace datmo {

namespace {

std::vector<Point2> inMap(const Pose2& base_in_map, const Object& object) {
  std::vector<Point2> positions;
  positions.reserve(object.points.size());
  for (const Point2& point : object.points) {
    positions.push_back(base_in_map * point);
  }
  return positions;
}

/// The corner farthest beyond a border; none if no corner lies beside it.
std::optional<BorderOffset> outermostCorner(const Object& object, const Pose2& base_in_map,
                                            const RoadBorder& border) {
  std::optional<BorderOffset> outermost;
  for (const Point2& corner : object.box.corners()) {
    const auto offset = offsetFrom(border, base_in_map * corner);
    if (offset && (!outermost || offset->outward > outermost->outward)) {
      outermost = offset;
    }
  }
  return outermost;
}

/// The point farthest toward the road; none if some point lies beside no part of the border.
std::optional<BorderOffset> innermostPoint(const std::vector<Point2>& positions,
                                           const RoadBorder& border) {
  std::optional<BorderOffset> innermost;
  for (const Point2& position : positions) {
    const auto offset = offsetFrom(border, position);
    if (!offset) {
      return std::nullopt;
    }
    if (!innermost || offset->outward < innermost->outward) {
      innermost = offset;
    }
  }
  return innermost;
}

DropReason reasonOf(double beyond, double margin) {
  return beyond > margin ? DropReason::kBeyondBorder : DropReason::kOnBorder;
}

}  // namespace

void BorderFilterOptions::visit(OptionVisitor& visitor) {
  visitor.choice(
      {"method", "",
       "evidence: objects on or beyond a border are less likely to move; thesis: they are false "
       "alarms and dropped, however they move (thesis 3.5.1)"},
      method,
      {{"evidence", BorderFilterMethod::kEvidence}, {"thesis", BorderFilterMethod::kThesis}});
  visitor.number({"margin", "m", "objects closer to a border than this lie on it (thesis 3.5.1)"},
                 margin, {0.0, 5.0});
  visitor.number({"sigmas", "1", "standard deviations of the border that are added to the margin"},
                 sigmas, {0.0, 10.0});
  visitor.number({"max_sigma", "m", "a less certain border is ignored"}, max_sigma, {0.01, 10.0});
  visitor.number(
      {"reach", "m", "objects farther beyond a border are left alone: another road may be there"},
      reach, {0.0, 1000.0});
  visitor.number({"motion_log_odds", "1",
                  "log odds that an object there moves, relative to those on the road"},
                 motion_log_odds, {-20.0, 0.0});
  visitor.group("extension", [&] { extension.visit(visitor); });
}

BorderFilter::BorderFilter(const Checked<BorderFilterOptions>& options)
    : options_(*options), extension_(options->extension) {}

std::vector<DroppedObject> BorderFilter::filter(const Pose2& base_in_map, const RoadModel& road,
                                                ObjectList& objects) {
  extension_.update(road, base_in_map);
  std::vector<DroppedObject> dropped;
  std::vector<Object> kept;
  for (Object& object : objects.objects) {
    auto lies_outside = outside(object, base_in_map, road);
    if (lies_outside && options_.method == BorderFilterMethod::kThesis) {
      lies_outside->object = std::move(object);
      dropped.push_back(std::move(*lies_outside));
      continue;
    }
    if (lies_outside) {
      object.dynamic_state = DynamicState::kUnknown;
      object.motion_log_odds = options_.motion_log_odds;
    }
    kept.push_back(std::move(object));
  }
  objects.objects = std::move(kept);
  return dropped;
}

std::optional<DroppedObject> BorderFilter::outside(const Object& object, const Pose2& base_in_map,
                                                   const RoadModel& road) const {
  const bool as_thesis = options_.method == BorderFilterMethod::kThesis;
  if (object.points.empty() || object.dynamic_state == DynamicState::kStatic ||
      (as_thesis && object.dynamic_state != DynamicState::kMoving)) {
    return std::nullopt;
  }
  const std::vector<Point2> positions = inMap(base_in_map, object);
  const auto known = outsideKnown(object, positions, base_in_map, road);
  return known || as_thesis ? known : outsideExtension(positions, road);
}

std::optional<DroppedObject> BorderFilter::outsideKnown(const Object& object,
                                                        const std::vector<Point2>& positions,
                                                        const Pose2& base_in_map,
                                                        const RoadModel& road) const {
  std::optional<DroppedObject> nearest;
  for (const RoadBorder& border : road.borders) {
    const auto offset = options_.method == BorderFilterMethod::kThesis
                            ? outermostCorner(object, base_in_map, border)
                            : innermostPoint(positions, border);
    // Written so that NaN counts as too large.
    if (!offset || !(offset->sigma <= options_.max_sigma)) {
      continue;
    }
    const double margin = options_.margin + options_.sigmas * offset->sigma;
    const double reach = border.side_street ? margin : options_.reach;
    const double before = nearest ? nearest->beyond : reach;
    if (offset->outward < -margin || offset->outward > before) {
      continue;
    }
    nearest = DroppedObject{{}, reasonOf(offset->outward, margin), border.side, offset->outward};
  }
  return nearest;
}

std::optional<BorderOffset> BorderFilter::offsetOn(RoadSide side, const Point2& position,
                                                   const RoadModel& road) const {
  if (auto extended = extension_.offset(side, position)) {
    return extended;
  }
  std::optional<BorderOffset> nearest;
  for (const RoadBorder& border : road.borders) {
    const auto known =
        border.side == side && !border.side_street ? offsetFrom(border, position) : std::nullopt;
    if (known && known->sigma <= options_.max_sigma &&
        (!nearest || std::abs(known->outward) < std::abs(nearest->outward))) {
      nearest = known;
    }
  }
  return nearest;
}

std::optional<DroppedObject> BorderFilter::outsideExtension(const std::vector<Point2>& positions,
                                                            const RoadModel& road) const {
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    std::optional<BorderOffset> innermost;
    for (const Point2& position : positions) {
      const auto offset = offsetOn(side, position, road);
      if (offset && (!innermost || offset->outward < innermost->outward)) {
        innermost = offset;
      }
    }
    if (innermost && innermost->outward >= -options_.margin &&
        innermost->outward <= options_.reach) {
      return DroppedObject{
          {}, reasonOf(innermost->outward, options_.margin), side, innermost->outward};
    }
  }
  return std::nullopt;
}

}  // namespace datmo
