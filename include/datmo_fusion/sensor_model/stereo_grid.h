// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/road_scene.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// When the thesis's plain form calls a cell occupied.
struct StereoConesOptions {
  int threshold = 20;  ///< points

  void visit(OptionVisitor& visitor);
};

/// When what is seen in the columns of the image makes a cell occupied or free.
struct StereoColumnsOptions {
  double min_surface = 0.01;  ///< m^2
  int min_points = 3;
  double road_sigmas = 2.0;      ///< standard deviations of the depth
  double obstacle_sigmas = 1.5;  ///< standard deviations of the depth

  void visit(OptionVisitor& visitor);
};

/// How a cloud becomes a grid (StereoGridModel).
enum class StereoGridMethod { kColumns, kCones };

struct StereoGridOptions : RoadSceneOptions {
  GridWindowOptions window;
  StereoGridMethod method = StereoGridMethod::kColumns;
  double occupied_probability = 0.8;
  double free_probability = 0.2;
  double min_layer_height = 0.2;  ///< m
  double layer_thickness = 1.0;   ///< m
  double min_depth = 0.5;         ///< m
  StereoColumnsOptions columns;
  StereoConesOptions cones;

  void visit(OptionVisitor& visitor);
};

/// What one cloud led to.
struct StereoGridResult {
  SensorGrid grid;
  RoadPlane road;            ///< that heights were counted from
  bool road_seen = false;    ///< false: the last known one, or the flat one of the thesis
  std::size_t points = 0;    ///< those that are finite and in front of the camera
  std::size_t in_layer = 0;  ///< of these, in the layer of obstacles and within range
};

class StereoEvidence;

/// One cloud of a stereo or depth camera -> its evidence on each cell around the vehicle
/// (thesis 3.2.2).
///
/// Method `cones`, the thesis's plain form on a flat road (eq. 3.2.2 to 3.2.4): points in the layer
/// above the scanner's plane counted in cells, free before each object, undecided behind it, free
/// elsewhere in view.
///
/// Method `columns`, beyond the thesis: surface found in columns of the image over inverse depth,
/// where the noise of a stereo camera is uniform (Badino et al., Free space computation using
/// stochastic occupancy grids and dynamic programming, 2007); the road is a plane estimated from
/// the points; free is only what enough lines of sight cross near the ground.
///
/// A cloud may be dense or thinned, organized or not: its density is estimated from it. Not thread
/// safe. Keeps the last road plane from cloud to cloud.
class StereoGridModel {
 public:
  /// Throws OptionError.
  explicit StereoGridModel(const Checked<StereoGridOptions>& options);
  ~StereoGridModel();

  /// Throws std::invalid_argument for a camera as StereoView does.
  StereoGridResult grid(const StereoCloud& cloud);

  /// Forgets the last road plane, as after construction.
  void reset() { road_.reset(); }

 private:
  StereoGridOptions options_;
  GridWindow window_;
  RoadPlaneEstimator road_;
  std::unique_ptr<StereoEvidence> evidence_;  ///< memory that is used again
};

}  // namespace datmo
