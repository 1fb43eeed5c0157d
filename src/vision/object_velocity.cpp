// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/object_velocity.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Standard deviation of a body's center, along an axis of its box whose end was not seen, m: half
/// of the extra length of a car that extends 0 m to 4.5 m farther.
constexpr double kHiddenMiddle = 1.3;

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Index of the object that a ground position belongs to: the one with the nearest box; within
/// several boxes, the one with the nearest center.
std::size_t ownerOf(const Point2& position, double margin, const std::vector<Object>& objects) {
  std::size_t owner = kNone;
  auto nearest = std::make_pair(std::numeric_limits<double>::infinity(), 0.0);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Object& object = objects[i];
    const double reach = margin + std::sqrt(object.position_covariance.diagonal().maxCoeff());
    const auto distance = std::make_pair(object.box.distanceTo(position),
                                         (position - object.box.center.position()).norm());
    if (distance.first <= reach && distance < nearest) {
      nearest = distance;
      owner = i;
    }
  }
  return owner;
}

bool isHidden(const Object& object, BoxSide side) {
  return !std::isfinite(object.side_variance[static_cast<std::size_t>(side)]);
}

BodyCenter centerOf(const Object& object) {
  const Point2 ahead = object.box.center.rotate(Point2(1.0, 0.0));
  const Point2 aside = object.box.center.rotate(Point2(0.0, 1.0));
  BodyCenter center{object.box.center.position(), object.position_covariance};
  if (isHidden(object, BoxSide::kFront) || isHidden(object, BoxSide::kRear)) {
    center.covariance += square(kHiddenMiddle) * ahead * ahead.transpose();
  }
  if (isHidden(object, BoxSide::kLeft) || isHidden(object, BoxSide::kRight)) {
    center.covariance += square(kHiddenMiddle) * aside * aside.transpose();
  }
  return center;
}

}  // namespace

void ObjectVelocityOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"margin", "m", "points up to this far outside of an object's box may belong to it"}, margin,
      {0.0, 5.0});
  visitor.number({"min_height", "m", "lower points belong to the road, or to a shadow on it"},
                 min_height, {0.0, 2.0});
  visitor.number({"max_height", "m", "higher points do not belong to road users"}, max_height,
                 {0.5, 20.0});
  shared.visit(visitor);
}

void measureVelocities(const std::vector<PointVelocity>& points,
                       const Checked<ObjectVelocityOptions>& options,
                       std::vector<Object>& objects) {
  std::vector<std::vector<PointVelocity>> on_object(objects.size());
  for (const PointVelocity& point : points) {
    const double height = point.position.z();
    if (height < options->min_height || height > options->max_height) {
      continue;
    }
    const std::size_t owner = ownerOf(point.position.head<2>(), options->margin, objects);
    if (owner != kNone) {
      on_object[owner].push_back(point);
    }
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::optional<SharedVelocity> shared =
        sharedVelocity(on_object[i], centerOf(objects[i]), options->shared);
    objects[i].velocity =
        shared ? std::make_optional(MeasuredVelocity{shared->velocity, shared->covariance,
                                                     shared->wrong_probability})
               : std::nullopt;
  }
}

}  // namespace datmo
