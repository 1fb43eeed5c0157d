#pragma once

#include <cstddef>
#include <vector>

#include "depth_bins.h"
#include "stereo_view.h"
#include "summed_counts.h"

#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// What the points of one cloud are counted by.
struct EvidenceLimits {
  double cell_size = 0.0;        ///< m, of the grid that is asked for
  double nearest_depth = 0.0;    ///< m, nearer points are mismatches
  double farthest_depth = 0.0;   ///< m, obstacles beyond are not of interest
  double layer_bottom = 0.0;     ///< m above the road
  double layer_top = 0.0;        ///< m above the road
  double road_sigmas = 0.0;      ///< of the depth: what is so near to the road is on it
  double obstacle_sigmas = 0.0;  ///< of the depth: lines of sight are sure up to so much before it
};

/// The points of one cloud, counted in columns of the camera's level image over depth: how many
/// stand in the layer of obstacles, and how many lines of sight cross each place near the ground.
///
/// Counts are whole numbers, so that no order of the points changes a result.
class StereoEvidence {
 public:
  /// Forgets what it knew, and counts the cloud's points. `view`: of this cloud.
  void take(const StereoCloud& cloud, const StereoView& view, const EvidenceLimits& limits);

  /// Surface (m^2) in the layer of obstacles that is seen from one depth to another (m), within
  /// `half_width` (m) to either side of a place in view.
  double surface(const ViewedPlace& place, double half_width, double near, double far) const;

  /// How many lines of sight cross a place in view between the road and the layer's bottom, within
  /// `half_width` (m) to either side of it.
  int lines(const ViewedPlace& place, double half_width) const;

  /// As many as it would be if the image had no holes.
  double expectedLines(const ViewedPlace& place, double half_width) const;

  std::size_t points() const { return points_; }
  std::size_t inLayer() const { return in_layer_; }

 private:
  struct Columns {
    int first, end;
  };

  void prepare(const StereoCamera& camera, const EvidenceLimits& limits);
  void addPoints(const StereoCloud& cloud, const StereoView& view, const EvidenceLimits& limits);
  double estimateThinning() const;

  /// At least one.
  Columns columnsAt(const ViewedPlace& place, double half_width) const;

  DepthBins bins_;
  int columns_ = 0;
  double left_ = 0.0;  ///< tangent of the first column's left border
  double columns_per_tangent_ = 0.0;
  double focal_length_ = 0.0;  ///< px
  double band_ = 0.0;          ///< m, from the road to the layer's bottom
  int tile_shift_ = 0;         ///< a tile of the image is 2^this columns wide
  int tile_rows_ = 0;
  int tile_columns_ = 0;

  SummedCounts obstacles_;  ///< points, by bin and column
  SummedCounts lines_;      ///< lines of sight that begin less those that end, by bin and column
  std::vector<int> tiles_;  ///< points in each tile of the image, row by row
  double thinning_ = 1.0;   ///< pixels for each point of the cloud, 1: dense
  std::size_t points_ = 0;
  std::size_t in_layer_ = 0;
};

}  // namespace datmo
