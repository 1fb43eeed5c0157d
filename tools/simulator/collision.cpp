// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/collision.h"

#include <algorithm>

namespace datmo::simulator {

namespace {

/// s; at 15 m/s an object moves by less than its own length.
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

}  // namespace datmo::simulator
