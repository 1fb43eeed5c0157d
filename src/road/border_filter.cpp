// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_filter.h"

#include <algorithm>
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

/// The corner that lies farthest beyond a border; none if no corner lies beside it.
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

/// The point that lies farthest on the road; none if a point lies beside no part of the border.
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

}  // namespace

void BorderFilterOptions::visit(OptionVisitor& visitor) {
  visitor.text({"method", "",
                "consistent: what lies on a border or beyond is a false alarm unless it came there "
                "over points that were seen free; thesis: however it moves (thesis 3.5.1)"},
               method, {kConsistent, kThesis});
  visitor.number({"margin", "m", "what is nearer to a border than this lies on it (thesis 3.5.1)"},
                 margin, {0.0, 5.0});
  visitor.number({"sigmas", "1", "standard deviations of the border that are added to the margin"},
                 sigmas, {0.0, 10.0});
  visitor.number({"max_sigma", "m", "a border that is known less well drops nothing"}, max_sigma,
                 {0.01, 10.0});
  visitor.number(
      {"reach", "m", "what lies farther beyond a border is left alone: another road may be there"},
      reach, {0.0, 1000.0});
  visitor.number({"required_on_border", "1",
                  "logarithm of the odds of having come for an object on a border to move"},
                 required_on_border, {-100.0, 100.0});
  visitor.number({"required_beyond", "1",
                  "the same beyond a border, where less reflects: a footpath, a driveway"},
                 required_beyond, {-100.0, 100.0});
  visitor.group("history", [&] { history.visit(visitor); });
  visitor.group("free_space_entry", [&] { free_space_entry.visit(visitor); });
  visitor.group("extension", [&] { extension.visit(visitor); });
}

BorderFilter::BorderFilter(const BorderFilterOptions& options)
    : options_(options),
      history_(options.history),
      entry_test_(options.free_space_entry),
      extension_(options.extension) {
  checkOptions(options);
}

void BorderFilter::reset() {
  history_.clear();
  extension_.reset();
}

std::vector<DroppedObject> BorderFilter::filter(const LabeledScan& scan, const RoadModel& road,
                                                ObjectList& objects) {
  history_.add(scan);
  extension_.update(road, scan.base_in_map.pose);
  std::vector<DroppedObject> dropped;
  std::vector<Object> kept;
  for (Object& object : objects.objects) {
    if (auto alarm = falseAlarm(object, scan.base_in_map.pose, road)) {
      alarm->object = std::move(object);
      dropped.push_back(std::move(*alarm));
    } else {
      kept.push_back(std::move(object));
    }
  }
  objects.objects = std::move(kept);
  return dropped;
}

std::optional<DroppedObject> BorderFilter::falseAlarm(const Object& object,
                                                      const Pose2& base_in_map,
                                                      const RoadModel& road) const {
  if (object.dynamic_state != DynamicState::kMoving || object.points.empty()) {
    return std::nullopt;
  }
  const bool as_thesis = options_.method == BorderFilterOptions::kThesis;
  const std::vector<Point2> positions = inMap(base_in_map, object);
  std::optional<Outside> outside = outsideKnown(object, positions, base_in_map, road);
  if (!outside && !as_thesis) {
    outside = outsideExtension(positions);
  }
  if (!outside) {
    return std::nullopt;
  }
  std::vector<ReflectionPoint> reflection_points;
  reflection_points.reserve(positions.size());
  for (const Point2& position : positions) {
    reflection_points.push_back({position, outside->offset.direction});
  }
  outside->reason.motion_evidence = entry_test_.evidence(history_, reflection_points);
  const bool is_false = as_thesis || outside->reason.motion_evidence < outside->required;
  return is_false ? std::make_optional(outside->reason) : std::nullopt;
}

std::optional<BorderFilter::Outside> BorderFilter::outsideKnown(
    const Object& object, const std::vector<Point2>& positions, const Pose2& base_in_map,
    const RoadModel& road) const {
  std::optional<Outside> nearest;
  for (const RoadBorder& border : road.borders) {
    const auto offset = options_.method == BorderFilterOptions::kThesis
                            ? outermostCorner(object, base_in_map, border)
                            : innermostPoint(positions, border);
    // In this form a standard deviation that is not a number is too high.
    if (!offset || !(offset->sigma <= options_.max_sigma)) {
      continue;
    }
    const double margin = options_.margin + options_.sigmas * offset->sigma;
    const double reach = border.side_street ? margin : options_.reach;
    const double before = nearest ? nearest->offset.outward : reach;
    if (offset->outward < -margin || offset->outward > before) {
      continue;
    }
    const bool is_beyond = offset->outward > margin;
    nearest =
        Outside{{}, *offset, is_beyond ? options_.required_beyond : options_.required_on_border};
    nearest->reason.reason = is_beyond ? DropReason::kBeyondBorder : DropReason::kOnBorder;
    nearest->reason.side = border.side;
    nearest->reason.beyond = offset->outward;
  }
  return nearest;
}

std::optional<BorderFilter::Outside> BorderFilter::outsideExtension(
    const std::vector<Point2>& positions) const {
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    std::optional<BorderOffset> innermost;
    for (const Point2& position : positions) {
      const auto offset = extension_.offset(side, position);
      if (offset && (!innermost || offset->outward < innermost->outward)) {
        innermost = offset;
      }
    }
    if (innermost && innermost->outward >= -options_.margin &&
        innermost->outward <= options_.reach) {
      Outside outside{{}, *innermost, options_.required_beyond};
      outside.reason.reason =
          innermost->outward > options_.margin ? DropReason::kBeyondBorder : DropReason::kOnBorder;
      outside.reason.side = side;
      outside.reason.beyond = innermost->outward;
      return outside;
    }
  }
  return std::nullopt;
}

}  // namespace datmo
