// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "simulator/world.h"

namespace datmo::simulator {

/// Two objects at the same position.
struct Collision {
  double time = 0.0;                 ///< s
  std::string mover;                 ///< label of the one that moves
  std::string other;                 ///< of what it meets
  Point2 position = Point2::Zero();  ///< m, the mover's middle
};

/// The first time in `duration` (s) at which something that moves, the ego vehicle included, shares
/// ground with another body; curbs and paint do not count.
std::optional<Collision> firstCollision(const World& world, double duration);

/// The same for one more mover, which is not among the world's.
std::optional<Collision> firstCollision(const World& world, const Mover& newcomer, double duration);

}  // namespace datmo::simulator
