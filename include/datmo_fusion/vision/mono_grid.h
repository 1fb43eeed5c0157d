// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/sensor_grid.h"
#include "datmo_fusion/sensor_model/lidar_grid.h"
#include "datmo_fusion/vision/image_region.h"
#include "datmo_fusion/vision/road_color.h"

namespace cv {
class Mat;
}

namespace datmo {

/// How an image becomes a grid (MonoGridModel).
enum class MonoGridMethod { kLines, kThesis };

struct MonoGridOptions {
  GridWindowOptions window;
  MonoGridMethod method = MonoGridMethod::kLines;
  double occupied_probability = 0.8;
  double free_probability = 0.2;
  double beam_width = 0.0;           ///< rad
  double effective_range = 25.0;     ///< m
  double learning_range = 15.0;      ///< m
  double min_road_share = 0.5;       ///< 1
  double min_obstacle_height = 0.3;  ///< m
  double pitch_sigma = 0.01;         ///< rad
  double thesis_distance = 3.0;      ///< 1
  RoadColorOptions color;

  void visit(OptionVisitor& visitor);
};

/// What one image led to.
struct MonoGridResult {
  SensorGrid grid;
  std::size_t free = 0;      ///< cells of the grid
  std::size_t occupied = 0;  ///< cells of the grid
  std::size_t learned = 0;   ///< pixels of the road
};

/// One image and the scan of its time -> what the image says of each cell around the vehicle
/// (thesis 4.1). What the road looks like is learned from cells that the scanner sees free
/// (RoadColor).
///
/// Method `thesis` (4.1.4): the pixel of each beam's end is background or not, and so are all cells
/// along its line, to the end of the grid.
///
/// Method `lines`, beyond the thesis, which proposes it (4.1.6): each cell on the road is a patch
/// of the image, and what the patches of a line of sight say is bounded by the scan's depth and by
/// what may stand on the road. Cells of the road's colors are free up to where the scanner sees
/// something; that is occupied if it is of other colors, else undecided. What is of other colors
/// without an echo is free if the road goes on so soon behind it that nothing of
/// `min_obstacle_height` hides there: paint. Otherwise it is undecided, and so is, by as much as
/// the camera's pitch may deceive, the road before it, unless the scanner says where it ends.
///
/// Not thread safe. Same input, same output.
class MonoGridModel {
 public:
  /// Throws OptionError.
  explicit MonoGridModel(const Checked<MonoGridOptions>& options);

  /// `image`: 8 bit, gray or BGR, of the camera's size (else std::invalid_argument). `scan`: in the
  /// vehicle's frame at the exposure, its stamp; `scanner_height`: above the road, m. All is
  /// unknown until something is learned, or with a camera that is not above the road.
  MonoGridResult grid(const cv::Mat& image, const MountedCamera& camera, const Scan& scan,
                      double scanner_height);

  /// Forgets what the road looks like.
  void reset() { color_.reset(); }

 private:
  std::size_t learn(const cv::Mat& image, const MountedCamera& camera, const SensorGrid& scanned);
  void fillAsInThesis(const cv::Mat& image, const MountedCamera& camera, const Scan& scan,
                      double scanner_height, SensorGrid& grid) const;

  MonoGridOptions options_;
  GridWindow window_;
  LidarGridModel scanner_;
  RoadColor color_;
};

}  // namespace datmo
