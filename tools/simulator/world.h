// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulator/path.h"
#include "simulator/road_network.h"
#include "simulator/shape.h"
#include "simulator/speed_profile.h"

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo::simulator {

/// How a solid responds to a beam.
enum class Surface {
  kBody,   ///< reflects, and hides what is behind it
  kCurb,   ///< an edge so low that it reflects only sometimes, and hides nothing
  kPaint,  ///< white paint on the road, flat; a false return (thesis 1.3.3)
};

/// Not an object of the ground truth: buildings, fences, curbs.
inline constexpr std::uint32_t kNoObject = 0;

/// An object on the road, as an upright prism.
struct Solid {
  Shape outline;
  double height = 0.0;  ///< m above the road
  Surface surface = Surface::kBody;
  std::uint32_t object = kNoObject;  ///< id in the ground truth
};

/// Dimensions and class of a kind of object.
struct ObjectKind {
  std::string key;    ///< in scene files
  std::string label;  ///< in the ground truth
  ObjectClass object_class = ObjectClass::kUnknown;
  double length = 0.0;          ///< m
  double width = 0.0;           ///< m
  double height = 0.0;          ///< m
  bool round = false;           ///< a circle of diameter `width`
  double axle_to_center = 0.0;  ///< m, from the point that follows the path (the rear axle)
};

/// All kinds of objects in scenes: car, van, truck, cyclist, pedestrian, pole, tree.
const std::vector<ObjectKind>& objectKinds();

/// The keys of objectKinds().
std::vector<std::string> objectKindKeys();

/// Throws std::out_of_range for an unknown key.
const ObjectKind& objectKind(const std::string& key);

/// An object of the ground truth at one time.
struct ObjectState {
  std::uint32_t id = kNoObject;
  ObjectKind kind;
  Pose2 center;
  Point2 velocity = Point2::Zero();  ///< m/s, of the center over ground
  bool moving = false;

  Box2 box() const { return {center, kind.length, kind.width}; }
  Solid solid() const;
};

/// Something that drives or walks along a path.
struct Mover {
  ObjectKind kind;
  Path path;
  SpeedProfile speed;
  double start = 0.0;  ///< m along the path, at time 0

  /// The point that follows the path (`axle`) and its motion, without slip, at a time (s).
  Pose2 axle(double time) const;
  Twist2 twist(double time) const;
  /// Pose of the box's center.
  Pose2 center(double time) const;
};

/// The state of the world at one time, which the sensors measure.
struct WorldState {
  double time = 0.0;  ///< s since the start
  Pose2 base;         ///< of the ego vehicle, in the world's frame
  Twist2 twist;       ///< of the ego vehicle
  std::vector<ObjectState> objects;
  std::vector<Solid> moving_solids;  ///< of the objects that move at some time
};

/// A scene over time: stationary solids, movers, and the ego vehicle, which is not among the solids
/// because its sensors do not see it.
class World {
 public:
  World(RoadNetwork roads, Mover ego);

  void addSolid(const Solid& solid) { fixed_solids_.push_back(solid); }
  /// An object that never moves.
  void addStanding(const ObjectKind& kind, const Pose2& center);
  void addMover(const Mover& mover) { movers_.push_back(mover); }

  const RoadNetwork& roads() const { return roads_; }
  const Mover& ego() const { return ego_; }
  const std::vector<Mover>& movers() const { return movers_; }
  /// All solids that never move, including curbs, paint and stationary objects.
  const std::vector<Solid>& fixedSolids() const { return fixed_solids_; }

  /// `time`: s since the start. Ids of objects are the same at all times: first the stationary
  /// ones, then the movers.
  WorldState at(double time) const;

 private:
  RoadNetwork roads_;
  Mover ego_;
  std::vector<Solid> fixed_solids_;
  std::vector<ObjectState> standing_;
  std::vector<Mover> movers_;
};

}  // namespace datmo::simulator
