// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "simulator/world.h"

namespace datmo::simulator {

/// The heights that a beam illuminates at each range: between two planes through the sensor.
struct HeightBand {
  double sensor_height = 0.0;  ///< m above the road
  double low_slope = 0.0;      ///< tangent of the lower edge's angle above the horizon
  double high_slope = 0.0;     ///< of the upper edge's

  /// Whether an object of this height (m) on the road at this range (m) is illuminated.
  bool lights(double height, double range) const {
    return sensor_height + low_slope * range <= height && sensor_height + high_slope * range >= 0.0;
  }
};

/// A hit of a ray on a solid.
struct RayHit {
  double range = 0.0;  ///< m
  std::uint32_t object = kNoObject;
  Surface surface = Surface::kBody;
};

/// The passage of a ray through a solid.
struct Passage {
  RaySpan span;                  ///< m from the ray's origin, over the solid's outline
  const Solid* solid = nullptr;  ///< lives as long as the world and its state
};

/// Casts rays from one position into the world at one time; only solids within reach are
/// considered.
class RayCaster {
 public:
  /// `reach`: m, the longest ray that will be requested. Keeps references to both, which must
  /// outlive the caster.
  RayCaster(const World& world, const WorldState& state, const Point2& origin, double reach);

  /// The nearest illuminated solid of a surface at a heading (rad, world frame), not farther than
  /// `reach`.
  std::optional<RayHit> nearest(double heading, const HeightBand& band, Surface surface,
                                double reach) const;

  /// All solids (bodies and curbs, not paint) along a heading (rad, world frame) that begin ahead
  /// of the origin, not farther than `reach`; the nearest first. Heights are left to the caller, as
  /// a low object hides only a part of what is behind it.
  std::vector<Passage> passages(double heading, double reach) const;

 private:
  struct Candidate {
    const Solid* solid = nullptr;
    Circle bound;
  };

  /// Whether the ray passes close enough to the solid to hit it.
  bool mayMeet(const Candidate& candidate, const Point2& direction) const;
  void addWithin(const std::vector<Solid>& solids, double reach);

  Point2 origin_;
  std::vector<Candidate> candidates_;
};

}  // namespace datmo::simulator
