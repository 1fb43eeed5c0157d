// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "simulator/path.h"
#include "simulator/random_stream.h"
#include "simulator/world.h"

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// The amount of random traffic. With the same seed, more traffic leaves the first movers and the
/// ego vehicle's odometry unchanged.
struct TrafficOptions {
  int movers = 0;
  double gap = 3.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// A lane of random traffic, and its speeds.
struct Lane {
  Path path;
  std::vector<ObjectKind> kinds;  ///< at least one
  double min_speed = 0.0;         ///< m/s
  double max_speed = 0.0;         ///< m/s, at least `min_speed`
  double min_ahead = 0.0;         ///< m along the lane, of the ego vehicle when it is met
  double max_ahead = 0.0;         ///< m, at least `min_ahead`
};

/// Adds movers to the world, each drawn from the stream: its lane, kind and constant speed, the
/// time at which it meets the ego vehicle, from 0 to `duration` (s), and how far ahead of it in the
/// lane it is then; so all of them come near. A mover that would come closer than the gap to a body
/// ahead or behind is drawn again.
///
/// Throws OptionError if there is no lane, or if no free lane is found for a mover.
void addTraffic(const std::vector<Lane>& lanes, const TrafficOptions& options, double duration,
                RandomStream random, World& world);

}  // namespace datmo::simulator
