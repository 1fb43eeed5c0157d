#pragma once

#include <cstddef>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// What one cloud led to.
struct StereoGridResult {
  SensorGrid grid;
  RoadPlane road;            ///< that heights were counted from
  bool road_seen = false;    ///< false: the last known one, or the flat one of the thesis
  std::size_t points = 0;    ///< finite ones of the cloud
  std::size_t in_layer = 0;  ///< of these, in the layer of obstacles and within range
};

}  // namespace datmo
