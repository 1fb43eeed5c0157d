// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "simulator/world.h"

#include "datmo_fusion/risk/box_contact.h"

namespace datmo::simulator {

/// Two objects at the same position.
struct Collision {
  double time = 0.0;                 ///< s
  std::string mover;                 ///< label of the moving one
  std::string other;                 ///< label of the other one
  Point2 position = Point2::Zero();  ///< m, the mover's center
};

/// The first time in `duration` (s) at which a moving object, including the ego vehicle, overlaps
/// with another body; curbs and paint are ignored.
std::optional<Collision> firstCollision(const World& world, double duration);

/// The same for an additional mover that is not in the world.
std::optional<Collision> firstCollision(const World& world, const Mover& newcomer, double duration);

/// The ego vehicle strikes something, or is struck.
struct EgoContact {
  double time = 0.0;                    ///< s
  std::uint32_t object = kNoObject;     ///< id in the ground truth; kNoObject: a building, a fence
  std::string label;                    ///< of the object
  StruckSide side = StruckSide::kNone;  ///< of the ego vehicle
  double speed = 0.0;                   ///< m/s, relative speed
};

/// The first contact of the ego vehicle in `duration` (s), to a millisecond; none if there is none.
std::optional<EgoContact> firstEgoContact(const World& world, double duration);

}  // namespace datmo::simulator
