// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simulator/sloped_ray.h"

namespace datmo::simulator {

/// Which parts of the world have so little texture that stereo matching finds nothing on them.
///
/// The world is divided into cubes; a hash of the cube and the object decides whether the surface
/// inside has no texture, so that this is constant over time. The cubes of an object are defined in
/// its own frame and move with it.
class SurfaceTexture {
 public:
  /// `patch`: m, edge of the cubes. Shares (0 to 1) of cubes without texture on solids, and on the
  /// road. `seed`: of the run.
  SurfaceTexture(double patch, double share_on_solids, double share_on_road, std::uint64_t seed);

  /// Whether the end point of a ray has no texture. `point`: m, world frame.
  bool isEven(const RayEnd& end, const Point2& point) const;

 private:
  double patch_;
  double share_on_solids_;
  double share_on_road_;
  std::uint64_t seed_;
};

}  // namespace datmo::simulator
