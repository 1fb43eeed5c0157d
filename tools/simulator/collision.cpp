#include "simulator/collision.h"

#include <algorithm>

namespace datmo::simulator {

namespace {

/// s; at 15 m/s a thing moves by less than its own length.
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

std::vector<Body> movingBodies(const World& world, double time) {
  std::vector<Body> bodies;
  ObjectState ego;
  ego.kind = world.ego().kind;
  ego.centre = world.ego().centre(time);
  bodies.push_back(bodyOf(ego.solid(), "ego vehicle"));
  for (const Mover& mover : world.movers()) {
    ObjectState object;
    object.kind = mover.kind;
    object.centre = mover.centre(time);
    bodies.push_back(bodyOf(object.solid(), mover.kind.label));
  }
  return bodies;
}

bool meet(const Body& a, const Body& b) {
  return (a.bound.centre - b.bound.centre).norm() <= a.bound.radius + b.bound.radius &&
         overlap(a.solid.outline, b.solid.outline);
}

using BodyIterator = std::vector<Body>::const_iterator;

/// Null: none.
const Body* firstMet(const Body& body, BodyIterator first, BodyIterator last) {
  const auto met =
      std::find_if(first, last, [&body](const Body& other) { return meet(body, other); });
  return met == last ? nullptr : &*met;
}

}  // namespace

std::optional<Collision> firstCollision(const World& world, double duration) {
  const std::vector<Body> standing = standingBodies(world);
  for (int step = 0; step * kStep <= duration; ++step) {
    const double time = step * kStep;
    const std::vector<Body> moving = movingBodies(world, time);
    for (auto body = moving.begin(); body != moving.end(); ++body) {
      const Body* other = firstMet(*body, standing.begin(), standing.end());
      other = other ? other : firstMet(*body, std::next(body), moving.end());
      if (other) {
        return Collision{time, body->label, other->label, body->bound.centre};
      }
    }
  }
  return std::nullopt;
}

}  // namespace datmo::simulator
