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

/// When the thesis's method marks a cell as occupied.
struct StereoConesOptions {
  int threshold = 20;  ///< points

  void visit(OptionVisitor& visitor);
};

/// When the contents of image columns make a cell occupied or free.
struct StereoColumnsOptions {
  /// m^2, 0.0001 to 10: a cell is occupied if at least this much surface is seen in it between the
  /// bottom and the top of the layer; a pole of 0.1 m width has 0.1 m^2 for each meter of height
  double min_surface = 0.01;
  int min_points = 3;
  /// 0 to 10: a point belongs to the road if a depth error of this many standard deviations
  /// explains its position
  double road_sigmas = 2.0;
  /// 0 to 10: cells within this many standard deviations of an obstacle's depth are not marked free
  double obstacle_sigmas = 1.5;

  void visit(OptionVisitor& visitor);
};

/// How a cloud is converted to a grid (StereoGridModel).
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

/// The result for one cloud.
struct StereoGridResult {
  SensorGrid grid;
  RoadPlane road;            ///< reference of heights
  bool road_seen = false;    ///< false: the last known one, or the flat one of the thesis
  std::size_t points = 0;    ///< finite and in front of the camera
  std::size_t in_layer = 0;  ///< of these, in the layer of obstacles and within range
};

class StereoEvidence;

/// Inverse sensor model of a stereo or depth camera: the evidence of one cloud on each cell around
/// the vehicle (thesis 3.2.2).
///
/// Method `cones`, as in the thesis, on a flat road (eq. 3.2.2 to 3.2.4): points in the layer above
/// the scanner's plane are counted in cells; free in front of each object, undecided behind it,
/// free elsewhere in view.
///
/// Method `columns`, beyond the thesis: surfaces are found in columns of the image over inverse
/// depth, where the noise of a stereo camera is uniform (Badino et al., Free space computation
/// using stochastic occupancy grids and dynamic programming, 2007); the road is a plane estimated
/// from the points; a cell is only free if enough lines of sight cross it near the ground.
///
/// A cloud may be dense or thinned, organized or not: its density is estimated. Not thread-safe.
/// Keeps the last road plane from cloud to cloud.
class StereoGridModel {
 public:
  /// Throws OptionError.
  explicit StereoGridModel(const Checked<StereoGridOptions>& options);
  ~StereoGridModel();

  /// Throws std::invalid_argument for invalid cameras, see StereoView.
  StereoGridResult grid(const StereoCloud& cloud);

  /// Forgets the last road plane, as after construction.
  void reset() { road_.reset(); }

 private:
  StereoGridOptions options_;
  GridWindow window_;
  RoadPlaneEstimator road_;
  std::unique_ptr<StereoEvidence> evidence_;  ///< reused memory
};

}  // namespace datmo
