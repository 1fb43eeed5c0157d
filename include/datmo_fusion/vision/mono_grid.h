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

/// How an image is converted to a grid (MonoGridModel).
enum class MonoGridMethod { kLines, kThesis };

struct MonoGridOptions {
  GridWindowOptions window;
  MonoGridMethod method = MonoGridMethod::kLines;
  double occupied_probability = 0.8;
  double free_probability = 0.2;
  double beam_width = 0.0;           ///< rad
  double effective_range = 25.0;     ///< m
  double learning_range = 20.0;      ///< m
  double min_obstacle_height = 0.3;  ///< m
  double pitch_sigma = 0.01;         ///< rad
  /// 0.1 to 100: method thesis: a pixel this many standard deviations from the road's colors
  /// belongs to an object (thesis eq. 4.1.6: a threshold of the density)
  double thesis_distance = 3.0;
  RoadColorOptions color;

  void visit(OptionVisitor& visitor);
};

/// Result for one image.
struct MonoGridResult {
  SensorGrid grid;
  std::size_t free = 0;      ///< cells of the grid
  std::size_t occupied = 0;  ///< cells of the grid
  std::size_t learned = 0;   ///< road pixels
};

/// Converts an image and a scan of the same time to a grid around the vehicle (thesis 4.1). The
/// road's appearance is learned from cells that the scanner sees free (RoadColor).
///
/// Method `thesis` (4.1.4): the pixel at each beam's end is background or not, which decides all
/// cells along its line, to the end of the grid.
///
/// Method `lines`, proposed in the thesis as future work (4.1.6): each cell on the road is a patch
/// of the image, and what the patches along a line of sight say is limited by the scan's depth and
/// by obstacles that may stand on the road. A patch is road if its colors are likelier on the road
/// than elsewhere. Cells of road color are free up to the scanner's echo, and beyond it where the
/// scanner sees past it; the echo's cell is occupied if it has another color, else undecided.
/// Another color is free (paint) if road reappears so soon behind it that nothing of
/// `min_obstacle_height` can be hidden there. Otherwise it is undecided, and so is the road before
/// it, as far as the camera's pitch may shift it, unless the scanner determines where it ends.
///
/// Not thread safe. Deterministic.
class MonoGridModel {
 public:
  /// Throws OptionError.
  explicit MonoGridModel(const Checked<MonoGridOptions>& options);

  /// `image`: 8 bit, gray or BGR, of the camera's size (else std::invalid_argument). `scan`: in the
  /// vehicle's frame at the exposure, its stamp; `scanner_height`: above the road, m. All cells are
  /// unknown until the road is learned, and if the camera is not above the road.
  MonoGridResult grid(const cv::Mat& image, const MountedCamera& camera, const Scan& scan,
                      double scanner_height);

  /// Forgets the road's appearance.
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
