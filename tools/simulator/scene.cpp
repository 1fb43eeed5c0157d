// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/scene.h"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "simulator/collision.h"
#include "simulator/scene_items.h"
#include "simulator/scene_reader.h"

namespace datmo::simulator {

namespace {

/// s; greater than the error of a contact's time.
constexpr double kContactMargin = 2e-3;

std::size_t findRoad(const std::string& name, const std::vector<Road>& roads) {
  std::string names;
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (roads[i].name == name) {
      return i;
    }
    names += " '" + roads[i].name + "'";
  }
  throw OptionError("road = '" + name + "': expected one of" + names);
}

RoadNetwork readRoads(const YAML::Node& scene) {
  std::vector<Road> roads;
  readList(scene, "roads", [&roads](const YAML::Node& entry) {
    const auto item = readItem<RoadItem>(entry, {"points"});
    roads.push_back({item.name, Path(readPoints(entry, "points"), item.corner_radius), item.width,
                     item.corner_radius, item.dash_length, item.dash_gap, item.paint_width});
  });
  std::vector<Crossing> crossings;
  readList(scene, "crossings", [&roads, &crossings](const YAML::Node& entry) {
    const auto item = readItem<CrossingItem>(entry);
    crossings.push_back({findRoad(item.road, roads), item.at, item.length});
  });
  return {roads, crossings};
}

/// m to the left of the road's center line.
double leftOf(const Road& road, RoadSide side, double from_curb) {
  const double from_middle = 0.5 * road.width + from_curb;
  return side == RoadSide::kLeft ? from_middle : -from_middle;
}

std::vector<std::string> readKinds(const YAML::Node& entry) {
  const YAML::Node list = entry["kinds"];
  if (!list.IsDefined() || !list.IsSequence() || list.size() == 0) {
    throw OptionError("kinds: expected a list of at least one kind of object");
  }
  std::vector<std::string> kinds;
  for (const YAML::Node& kind : list) {
    ActorItem named;
    named.kind = kind.as<std::string>("");
    checkOptions(named);
    kinds.push_back(named.kind);
  }
  return kinds;
}

std::set<int> readLeftOut(const YAML::Node& entry) {
  if (!entry["leave_out"].IsDefined()) {
    return {};
  }
  try {
    const auto numbers = entry["leave_out"].as<std::vector<int>>();
    return {numbers.begin(), numbers.end()};
  } catch (const YAML::Exception&) {
    throw OptionError("leave_out: expected a list of whole numbers, 0 for the first position");
  }
}

/// Objects on another road, or in the bend of its curb, are omitted.
void addRow(const YAML::Node& entry, World& world) {
  const auto item = readItem<RowItem>(entry, {"kinds", "leave_out"});
  const std::vector<std::string> kinds = readKinds(entry);
  const std::set<int> left_out = readLeftOut(entry);
  const std::size_t road_index = findRoad(item.road, world.roads().roads());
  const Road& road = world.roads().roads()[road_index];
  const double left = leftOf(road, item.side, item.from_curb);
  const Pose2 turned(0.0, 0.0, item.side == RoadSide::kLeft ? kPi : 0.0);
  int position = 0;
  for (double arc_length = item.from; arc_length <= item.to;
       arc_length = item.from + position * item.spacing) {
    const std::string& kind = kinds[static_cast<std::size_t>(position) % kinds.size()];
    const Pose2 pose = world.roads().beside(road_index, arc_length, left) * turned;
    if (left_out.count(position) == 0 &&
        !world.roads().onOtherRoad(road_index, pose.position(), road.corner_radius)) {
      world.addStanding(objectKind(kind), pose);
    }
    ++position;
  }
}

void addFront(const YAML::Node& entry, World& world) {
  const auto item = readItem<FrontItem>(entry);
  const std::size_t road_index = findRoad(item.road, world.roads().roads());
  const double left = leftOf(world.roads().roads()[road_index], item.side, item.from_curb);
  for (double from = item.from; from < item.to; from += item.piece + item.gap) {
    const double to = std::min(from + item.piece, item.to);
    for (const Polyline& line :
         world.roads().sideLines(road_index, left, from, to, item.from_curb)) {
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        world.addSolid({Segment{line[i], line[i + 1]}, item.height, Surface::kBody, kNoObject});
      }
    }
  }
}

Mover readMover(const YAML::Node& entry, double duration) {
  const auto item = readItem<ActorItem>(entry, {"path", "speed"});
  const Mover mover{objectKind(item.kind), Path(readPoints(entry, "path"), item.corner_radius),
                    readSpeed(entry), item.start};
  const double arc_length = mover.start + mover.speed.distance(duration);
  if (arc_length > mover.path.length()) {
    std::ostringstream message;
    message << "path of " << mover.path.length() << " m: expected at least the " << arc_length
            << " m of start and speed in " << duration << " s";
    throw OptionError(message.str());
  }
  return mover;
}

void checkOrder(const std::string& what, double min, double max) {
  if (min > max) {
    throw OptionError("min_" + what + " = " + std::to_string(min) + ": expected at most max_" +
                      what + ", " + std::to_string(max));
  }
}

Lane readLane(const YAML::Node& entry) {
  const auto item = readItem<LaneItem>(entry, {"path", "kinds"});
  checkOrder("speed", item.min_speed, item.max_speed);
  checkOrder("ahead", item.min_ahead, item.max_ahead);
  Lane lane{Path(readPoints(entry, "path"), item.corner_radius),
            {},
            item.min_speed,
            item.max_speed,
            item.min_ahead,
            item.max_ahead};
  for (const std::string& kind : readKinds(entry)) {
    lane.kinds.push_back(objectKind(kind));
  }
  return lane;
}

void readTraffic(const YAML::Node& scene, const SimulationOptions& options, World& world) {
  std::vector<Lane> lanes;
  readList(scene, "lanes", [&](const YAML::Node& entry) { lanes.push_back(readLane(entry)); });
  addTraffic(lanes, options.traffic, options.duration,
             RandomStream(static_cast<std::uint64_t>(options.seed), "traffic"), world);
}

World readWorld(const YAML::Node& scene, const SimulationOptions& options) {
  const double duration = options.duration;
  if (!scene["ego"].IsDefined()) {
    throw OptionError("ego is missing: expected the ego vehicle's path and speed");
  }
  std::optional<World> world;
  const RoadNetwork roads = readRoads(scene);
  readAt("ego", [&] { world.emplace(roads, readMover(scene["ego"], duration)); });
  readList(scene, "rows", [&](const YAML::Node& entry) { addRow(entry, *world); });
  readList(scene, "fronts", [&](const YAML::Node& entry) { addFront(entry, *world); });
  readList(scene, "actors",
           [&](const YAML::Node& entry) { world->addMover(readMover(entry, duration)); });
  readTraffic(scene, options, *world);
  return *world;
}

/// Bodies other than the ego vehicle must not collide; the ego vehicle only with `contact`. Checked
/// up to its contact, at which the drive ends.
void refuseCollisions(const World& world, double duration) {
  if (const auto collision = firstCollision(world, duration)) {
    std::ostringstream message;
    message << collision->mover << " and " << collision->other << " collide at ["
            << collision->position.x() << ", " << collision->position.y() << "] after "
            << collision->time << " s: expected paths without collisions";
    throw OptionError(message.str());
  }
}

}  // namespace

Scene readScene(const std::string& file, const OptionValues& overrides) {
  const YAML::Node yaml = loadYaml(file);
  std::optional<Scene> scene;
  readAt(file, [&] {
    expectKeys(yaml, {"options", "ego", "roads", "crossings", "rows", "fronts", "actors", "lanes"});
    OptionValues values = optionValues(yaml["options"]);
    for (const auto& [key, value] : overrides) {
      values[key] = value;
    }
    const auto options = readOptions<SimulationOptions>(values);
    scene.emplace(Scene{options, readWorld(yaml, options), std::nullopt});
    if (options.contact) {
      scene->contact = firstEgoContact(scene->world, options.duration);
    }
    // The last moment is the contact itself.
    refuseCollisions(scene->world,
                     scene->contact ? scene->contact->time - kContactMargin : options.duration);
  });
  return *scene;
}

}  // namespace datmo::simulator
