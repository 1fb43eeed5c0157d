// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// What all that looks at a stereo camera's clouds takes of them: up to where, and above which
/// road.
struct RoadSceneOptions {
  double effective_range = 36.0;  ///< m
  RoadPlaneOptions road;

  void visit(OptionVisitor& visitor);

  /// Depth up to which points belong to the effective range, m: some beyond it, as depths are
  /// noisy.
  double maxDepth(const StereoCamera& camera) const;
};

}  // namespace datmo
