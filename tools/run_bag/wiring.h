#pragma once

#include "last_stage.h"

namespace datmo {

/// What the stereo camera's points come from.
enum class StereoPoints { kClouds, kRectifiedImages, kRawImages };

/// Which stages there are, and what feeds them.
struct Wiring {
  LastStage last = LastStage::kEnd;  ///< the stages after it are left out
  bool scan_from_cloud = false;      ///< of a 3D lidar
  bool low_level_fusion = false;
  bool road_border = false;
  bool object_fusion = false;
  bool track_fusion = false;
  StereoPoints stereo = StereoPoints::kClouds;
};

}  // namespace datmo
