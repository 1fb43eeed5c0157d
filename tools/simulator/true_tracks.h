// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include "simulator/ground_truth.h"
#include "simulator/world.h"

#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo::simulator {

/// The ego vehicle at a time (s) as its sensors would measure it, in the world's frame: present
/// speed and yaw rate, acceleration over the last half second.
HostState trueHost(const World& world, double time, const HostVehicleOptions& vehicle);

/// The output of an ideal perception for a scene, in the world's frame.
struct TruePerception {
  std::vector<Track> tracks;
  std::vector<Point2> standing;  ///< m, on the outlines of solids that have not been seen moving
                                 ///< yet
};

/// Tracks of an ideal tracker: of all objects that a sensor has seen once and that have moved
/// since, with the true state, a small covariance, and the mode of the true motion.
class IdealTracker {
 public:
  /// `world` must outlive this.
  explicit IdealTracker(const World& world) : world_(world) {}

  /// `truths`: at that time (s). Times must increase.
  TruePerception at(double time, const std::vector<ObjectTruth>& truths);

 private:
  const World& world_;
  std::set<std::uint32_t> seen_;
  std::set<std::uint32_t> moved_;
};

}  // namespace datmo::simulator
