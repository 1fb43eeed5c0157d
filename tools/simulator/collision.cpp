// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/collision.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace datmo::simulator {

namespace {

/// s; in this time an object at 15 m/s moves by less than its own length.
constexpr double kStep = 0.05;

struct Body {
  Solid solid;
  Circle bound;
  std::string label;
};

Body bodyOf(const Solid& solid, const std::string& label) {
  return {solid, boundingCircle(solid.outline), label};
}

std::vector<Body> standingBodies(const World& world) {
  std::vector<Body> bodies;
  const std::vector<ObjectState> objects = world.at(0.0).objects;
  for (const Solid& solid : world.fixedSolids()) {
    if (solid.surface == Surface::kBody) {
      const bool known = solid.object != kNoObject;
      bodies.push_back(bodyOf(solid, known ? objects[solid.object - 1].kind.label : "Front"));
    }
  }
  return bodies;
}

Body bodyAt(const Mover& mover, const std::string& label, double time) {
  ObjectState object;
  object.kind = mover.kind;
  object.center = mover.center(time);
  return bodyOf(object.solid(), label);
}

std::vector<Body> movingBodies(const World& world, double time) {
  std::vector<Body> bodies{bodyAt(world.ego(), "ego vehicle", time)};
  for (const Mover& mover : world.movers()) {
    bodies.push_back(bodyAt(mover, mover.kind.label, time));
  }
  return bodies;
}

bool meet(const Body& a, const Body& b) {
  return (a.bound.center - b.bound.center).norm() <= a.bound.radius + b.bound.radius &&
         overlap(a.solid.outline, b.solid.outline);
}

using BodyIterator = std::vector<Body>::const_iterator;

/// Null: none.
const Body* firstMet(const Body& body, BodyIterator first, BodyIterator last) {
  const auto met =
      std::find_if(first, last, [&body](const Body& other) { return meet(body, other); });
  return met == last ? nullptr : &*met;
}

/// One body that the ego vehicle may collide with, at one time.
struct Met {
  std::uint32_t object = kNoObject;
  std::string label;
  Pose2 center;
  BodySize size;
  Point2 velocity = Point2::Zero();
};

Met metObject(const ObjectState& object) {
  return {object.id, object.kind.label, object.center, bodySize(object.box()),
          object.moving ? object.velocity : Point2(Point2::Zero())};
}

/// The contact point of a building: the point of its outline that is nearest to the vehicle.
Met metFront(const Solid& solid, const Pose2& ego) {
  const auto* line = std::get_if<Segment>(&solid.outline);
  Point2 nearest = boundingCircle(solid.outline).center;
  if (line) {
    const Point2 along = line->end - line->start;
    const double share = (ego.position() - line->start).dot(along) / along.squaredNorm();
    nearest = line->start + std::clamp(share, 0.0, 1.0) * along;
  }
  return {kNoObject, "Front", {nearest, 0.0}, BodySize(), Point2::Zero()};
}

/// The body with which the ego vehicle overlaps at a time.
std::optional<Met> metAt(const World& world, double time) {
  const Body ego = bodyAt(world.ego(), "ego vehicle", time);
  for (const ObjectState& object : world.at(time).objects) {
    if (meet(ego, bodyOf(object.solid(), object.kind.label))) {
      return metObject(object);
    }
  }
  for (const Solid& solid : world.fixedSolids()) {
    if (solid.surface == Surface::kBody && solid.object == kNoObject &&
        meet(ego, bodyOf(solid, "Front"))) {
      return metFront(solid, world.ego().center(time));
    }
  }
  return std::nullopt;
}

/// m/s, of the center of the ego vehicle.
Point2 egoVelocity(const World& world, double time) {
  constexpr double kShort = 1e-3;  // s
  const Mover& ego = world.ego();
  return (ego.center(time).position() - ego.center(time - kShort).position()) / kShort;
}

Collision collisionOf(const Body& body, const Body& other, double time) {
  return {time, body.label, other.label, body.bound.center};
}

}  // namespace

std::optional<Collision> firstCollision(const World& world, const Mover& newcomer,
                                        double duration) {
  const std::vector<Body> standing = standingBodies(world);
  for (int step = 0; step * kStep <= duration; ++step) {
    const double time = step * kStep;
    const std::vector<Body> moving = movingBodies(world, time);
    const Body body = bodyAt(newcomer, newcomer.kind.label, time);
    const Body* other = firstMet(body, moving.begin(), moving.end());
    other = other ? other : firstMet(body, standing.begin(), standing.end());
    if (other) {
      return collisionOf(body, *other, time);
    }
  }
  return std::nullopt;
}

std::optional<Collision> firstCollision(const World& world, double duration) {
  const std::vector<Body> standing = standingBodies(world);
  for (int step = 0; step * kStep <= duration; ++step) {
    const double time = step * kStep;
    const std::vector<Body> moving = movingBodies(world, time);
    for (auto body = moving.begin(); body != moving.end(); ++body) {
      const Body* other = firstMet(*body, standing.begin(), standing.end());
      other = other ? other : firstMet(*body, std::next(body), moving.end());
      if (other) {
        return collisionOf(*body, *other, time);
      }
    }
  }
  return std::nullopt;
}

std::optional<EgoContact> firstEgoContact(const World& world, double duration) {
  constexpr double kPrecision = 1e-3;  // s
  for (int step = 0; step * kStep <= duration; ++step) {
    double after = step * kStep;
    if (!metAt(world, after)) {
      continue;
    }
    double before = std::max(0.0, after - kStep);
    while (after - before > kPrecision) {
      const double middle = 0.5 * (before + after);
      (metAt(world, middle) ? after : before) = middle;
    }
    const Met met = *metAt(world, after);
    const Mover& ego = world.ego();
    const Pose2 center = ego.center(after);
    const StruckSide side =
        struckSide(bodyPose(center.position(), center.heading()),
                   {0.5 * ego.kind.length, 0.5 * ego.kind.width},
                   bodyPose(met.center.position(), met.center.heading()), met.size);
    return EgoContact{after, met.object, met.label, side,
                      (met.velocity - egoVelocity(world, after)).norm()};
  }
  return std::nullopt;
}

}  // namespace datmo::simulator
