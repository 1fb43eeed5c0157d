// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/scene_items.h"

#include "simulator/scene.h"
#include "simulator/world.h"

namespace datmo::simulator {

namespace {

constexpr Bounds kArcLength{-1e5, 1e5};

void visitStretch(OptionVisitor& visitor, std::string& road, RoadSide& side, double& from,
                  double& to) {
  visitor.text({"road", "", "name of the road beside which it is"}, road, {});
  visitor.choice({"side", "", "of the road, looking along it"}, side,
                 {{"left", RoadSide::kLeft}, {"right", RoadSide::kRight}});
  visitor.number({"from", "m", "start along the road's middle line"}, from, kArcLength);
  visitor.number({"to", "m", "end along the road's middle line"}, to, kArcLength);
}

}  // namespace

void RoadItem::visit(OptionVisitor& visitor) {
  visitor.text({"name", "", "by which other entries refer to the road"}, name, {});
  visitor.number({"width", "m", "from curb to curb"}, width, {2.0, 100.0});
  visitor.number({"corner_radius", "m", "of the middle line's bends and of the curbs at junctions"},
                 corner_radius, {0.5, 200.0});
  visitor.number({"dash_length", "m", "of the white middle line; 0: none"}, dash_length,
                 {0.0, 1000.0});
  visitor.number({"dash_gap", "m", "between dashes"}, dash_gap, {0.1, 1000.0});
  visitor.number({"paint_width", "m", "of the white middle line"}, paint_width, {0.05, 1.0});
}

void CrossingItem::visit(OptionVisitor& visitor) {
  visitor.text({"road", "", "name of the road that has the zebra crossing"}, road, {});
  visitor.number({"at", "m", "its middle along the road's middle line"}, at, kArcLength);
  visitor.number({"length", "m", "of the stripes, along the road"}, length, {1.0, 20.0});
}

void RowItem::visit(OptionVisitor& visitor) {
  visitStretch(visitor, road, side, from, to);
  visitor.number({"spacing", "m", "from the middle of one object to that of the next"}, spacing,
                 {0.5, 1000.0});
  visitor.number({"from_curb", "m", "from the curb to the middle; negative: on the carriageway"},
                 from_curb, {-50.0, 50.0});
}

void FrontItem::visit(OptionVisitor& visitor) {
  visitStretch(visitor, road, side, from, to);
  visitor.number({"from_curb", "m", "from the curb outwards"}, from_curb, {0.5, 100.0});
  visitor.number({"piece", "m", "length of an unbroken piece"}, piece, {0.5, 1000.0});
  visitor.number({"gap", "m", "between pieces; 0: unbroken"}, gap, {0.0, 1000.0});
  visitor.number({"height", "m", "8 for a building, 1 for a fence"}, height, {0.1, 100.0});
}

void ActorItem::visit(OptionVisitor& visitor) {
  visitor.text({"kind", "", "what it is"}, kind, objectKindKeys());
  visitor.number({"corner_radius", "m", "of the arcs at the corners of its path"}, corner_radius,
                 {0.0, 200.0});
  visitor.number({"start", "m", "position along its path at the start"}, start, {0.0, 1e5});
}

void LaneItem::visit(OptionVisitor& visitor) {
  visitor.number({"corner_radius", "m", "of the arcs at the corners of its path"}, corner_radius,
                 {0.0, 200.0});
  visitor.number({"min_speed", "m/s", "minimum speed of the movers in it"}, min_speed,
                 {0.1, 100.0});
  visitor.number({"max_speed", "m/s", "maximum speed of the movers in it"}, max_speed,
                 {0.1, 100.0});
  visitor.number({"min_ahead", "m", "ahead of the ego vehicle along the lane when they meet"},
                 min_ahead, {-500.0, 500.0});
  visitor.number({"max_ahead", "m", "ahead of the ego vehicle along the lane when they meet"},
                 max_ahead, {-500.0, 500.0});
}

void SimulationOptions::visit(OptionVisitor& visitor) {
  constexpr double kMaxSeed = 2147483647.0;
  visitor.integer({"seed", "1", "of all random numbers"}, seed, {0.0, kMaxSeed});
  visitor.number({"duration", "s", "of the bag"}, duration, {0.1, 36000.0});
  visitor.text({"compression", "", "of the bag"}, compression, {"none", "bz2", "lz4"});
  visitor.toggle({"contact", "",
                  "the ego vehicle may collide: the drive ends there, and /ground_truth/contact "
                  "says when, with what and how; false: such a scene is rejected"},
                 contact);
  visitor.group("scanner", [&] { scanner.visit(visitor); });
  visitor.group("stereo", [&] { stereo.visit(visitor); });
  visitor.group("mono", [&] { mono.visit(visitor); });
  visitor.group("odometer", [&] { odometer.visit(visitor); });
  visitor.group("vehicle_sensors", [&] { vehicle_sensors.visit(visitor); });
  visitor.group("ground_truth", [&] { ground_truth.visit(visitor); });
  visitor.group("traffic", [&] { traffic.visit(visitor); });
}

}  // namespace datmo::simulator
