// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/world.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace datmo::simulator {

namespace {

/// Curb stones of German city streets stand 10 to 15 cm above the road.
constexpr double kCurbHeight = 0.12;
/// Objects slower than this (m/s) are stationary in the ground truth.
constexpr double kStandstill = 0.1;

}  // namespace

const std::vector<ObjectKind>& objectKinds() {
  static const std::vector<ObjectKind> kinds{
      {"car", "Car", ObjectClass::kVehicle, 4.4, 1.8, 1.5, false, 1.35},
      {"van", "Van", ObjectClass::kVehicle, 5.3, 2.0, 2.3, false, 1.6},
      {"truck", "Truck", ObjectClass::kVehicle, 9.0, 2.5, 3.5, false, 2.7},
      {"cyclist", "Cyclist", ObjectClass::kCyclist, 1.8, 0.6, 1.75, false, 0.5},
      {"pedestrian", "Pedestrian", ObjectClass::kPedestrian, 0.5, 0.5, 1.75, true, 0.0},
      {"pole", "Pole", ObjectClass::kPole, 0.12, 0.12, 4.0, true, 0.0},
      {"tree", "Tree", ObjectClass::kPole, 0.3, 0.3, 6.0, true, 0.0},
  };
  return kinds;
}

std::vector<std::string> objectKindKeys() {
  std::vector<std::string> keys;
  for (const ObjectKind& kind : objectKinds()) {
    keys.push_back(kind.key);
  }
  return keys;
}

const ObjectKind& objectKind(const std::string& key) {
  const auto found = std::find_if(objectKinds().begin(), objectKinds().end(),
                                  [&key](const ObjectKind& kind) { return kind.key == key; });
  if (found == objectKinds().end()) {
    throw std::out_of_range("no kind of object is named " + key);
  }
  return *found;
}

Solid ObjectState::solid() const {
  const Shape outline = kind.round ? Shape(Circle{center.position(), 0.5 * kind.width}) : box();
  return {outline, kind.height, Surface::kBody, id};
}

Pose2 Mover::axle(double time) const { return path.at(start + speed.distance(time)).pose; }

Twist2 Mover::twist(double time) const {
  const double forward = speed.speed(time);
  return {forward, forward * path.at(start + speed.distance(time)).curvature};
}

Pose2 Mover::center(double time) const { return axle(time) * Pose2(kind.axle_to_center, 0.0, 0.0); }

World::World(RoadNetwork roads, Mover ego) : roads_(std::move(roads)), ego_(std::move(ego)) {
  for (const Polyline& curb : roads_.curbs()) {
    for (std::size_t i = 0; i + 1 < curb.size(); ++i) {
      addSolid({Segment{curb[i], curb[i + 1]}, kCurbHeight, Surface::kCurb, kNoObject});
    }
  }
  for (const Box2& paint : roads_.paint()) {
    addSolid({paint, 0.0, Surface::kPaint, kNoObject});
  }
}

void World::addStanding(const ObjectKind& kind, const Pose2& center) {
  ObjectState state;
  state.id = static_cast<std::uint32_t>(standing_.size()) + 1;
  state.kind = kind;
  state.center = center;
  standing_.push_back(state);
  addSolid(state.solid());
}

WorldState World::at(double time) const {
  WorldState state;
  state.time = time;
  state.base = ego_.axle(time);
  state.twist = ego_.twist(time);
  state.objects = standing_;
  for (const Mover& mover : movers_) {
    const Twist2 twist = mover.twist(time);
    ObjectState object;
    object.id = static_cast<std::uint32_t>(state.objects.size()) + 1;
    object.kind = mover.kind;
    object.center = mover.center(time);
    object.velocity =
        object.center.rotate({twist.forward_speed, twist.yaw_rate * mover.kind.axle_to_center});
    object.moving = twist.forward_speed > kStandstill;
    state.objects.push_back(object);
    state.moving_solids.push_back(object.solid());
  }
  return state;
}

}  // namespace datmo::simulator
