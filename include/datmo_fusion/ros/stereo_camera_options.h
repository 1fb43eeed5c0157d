// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/sensor_model/depth_noise.h"
#include "datmo_fusion/sensor_model/road_scene.h"

namespace datmo {

/// Used until a camera info has been received, and for what no message contains.
struct StereoCameraOptions : DepthNoiseOptions {
  double focal_length = 0.0;             ///< px; 0: unknown
  double baseline = 0.0;                 ///< m; 0: unknown, or none
  double field_of_view = degrees(60.0);  ///< rad
  double min_depth = 0.0;                ///< m; 0: no bound
  double max_depth = 0.0;                ///< m; 0: no bound
  bool align = true;
  /// s, 0.1 to 3600: how long after its stamp a disagreement of camera and scanner is assumed to
  /// last, since a silent scanner cannot confirm it; the time over which agreement is judged
  double alignment_hold = 5.0;

  void visit(OptionVisitor& visitor);
};

/// The stereo or depth camera and the road in its view, for all stages: section `stereo_camera` of
/// a sensor set.
struct StereoSceneOptions : StereoCameraOptions, RoadSceneOptions {
  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
