// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// What all users of a stereo camera's clouds have in common: their effective range and the road.
struct RoadSceneOptions {
  double effective_range = 36.0;  ///< m
  RoadPlaneOptions road;

  void visit(OptionVisitor& visitor);

  /// Returns the depth up to which points are used, m: somewhat beyond the effective range, because
  /// depths are noisy.
  double maxDepth(const StereoCamera& camera) const;
};

}  // namespace datmo
