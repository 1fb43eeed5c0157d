// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/traffic.h"

#include <string>

#include "simulator/collision.h"

namespace datmo::simulator {

namespace {

/// Maximum number of draws for a mover; lanes that are not full need only a few.
constexpr int kMaxDraws = 1000;
/// m; step of the search for the arc length of a lane beside the ego vehicle.
constexpr double kSearchStep = 1.0;

double between(double min, double max, double share) { return min + share * (max - min); }

template <typename Item>
const Item& oneOf(const std::vector<Item>& items, RandomStream& random) {
  return items[static_cast<std::size_t>(random.uniform() * static_cast<double>(items.size()))];
}

/// Arc length of the path's nearest point to a point, m.
double arcLengthBeside(const Path& path, const Point2& point) {
  double nearest = 0.0;
  for (double arc_length = 0.0; arc_length <= path.length(); arc_length += kSearchStep) {
    if ((path.at(arc_length).pose.position() - point).norm() <
        (path.at(nearest).pose.position() - point).norm()) {
      nearest = arc_length;
    }
  }
  return nearest;
}

Mover draw(const std::vector<Lane>& lanes, double duration, const Mover& ego,
           RandomStream& random) {
  const Lane& lane = oneOf(lanes, random);
  const ObjectKind& kind = oneOf(lane.kinds, random);
  const double speed = between(lane.min_speed, lane.max_speed, random.uniform());
  const double meeting = between(0.0, duration, random.uniform());
  const double ahead = between(lane.min_ahead, lane.max_ahead, random.uniform());
  const double start =
      arcLengthBeside(lane.path, ego.axle(meeting).position()) + ahead - speed * meeting;
  return {kind, lane.path, SpeedProfile({{0.0, speed}}), start};
}

bool isFree(const World& world, Mover mover, double gap, double duration) {
  mover.kind.length += 2.0 * gap;
  return !firstCollision(world, mover, duration);
}

bool addMover(const std::vector<Lane>& lanes, const TrafficOptions& options, double duration,
              RandomStream& random, World& world) {
  for (int i = 0; i < kMaxDraws; ++i) {
    const Mover mover = draw(lanes, duration, world.ego(), random);
    if (isFree(world, mover, options.gap, duration)) {
      world.addMover(mover);
      return true;
    }
  }
  return false;
}

}  // namespace

void TrafficOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"movers", "1", "that drive at random in the scene's lanes"}, movers,
                  {0.0, 1000.0});
  visitor.number({"gap", "m", "minimum distance that each of them keeps ahead and behind"}, gap,
                 {0.0, 100.0});
}

void addTraffic(const std::vector<Lane>& lanes, const TrafficOptions& options, double duration,
                RandomStream random, World& world) {
  const std::string given = "traffic/movers = " + std::to_string(options.movers);
  if (options.movers > 0 && lanes.empty()) {
    throw OptionError(given + ": expected lanes in the scene for them");
  }
  for (int i = 0; i < options.movers; ++i) {
    if (!addMover(lanes, options, duration, random, world)) {
      throw OptionError(given + ": expected at most the " + std::to_string(i) +
                        " for which the lanes have room");
    }
  }
}

}  // namespace datmo::simulator
