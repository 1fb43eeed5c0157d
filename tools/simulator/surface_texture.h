// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simulator/sloped_ray.h"

namespace datmo::simulator {

/// Which pieces of the world look so even that stereo matching finds nothing on them.
///
/// The world is cut into cubes; whether what lies in one is even is decided by a hash of the cube
/// and the object, so that it stays the same over time. The cubes of an object are laid in its own
/// frame and move with it.
class SurfaceTexture {
 public:
  /// `patch`: m, edge of the cubes. The shares (0 to 1) of even cubes on what stands, and on the
  /// road. `seed`: of the run.
  SurfaceTexture(double patch, double share_on_solids, double share_on_road, std::uint64_t seed);

  /// Whether the point where a ray ends is even. `point`: m, world frame.
  bool isEven(const RayEnd& end, const Point2& point) const;

 private:
  double patch_;
  double share_on_solids_;
  double share_on_road_;
  std::uint64_t seed_;
};

}  // namespace datmo::simulator
