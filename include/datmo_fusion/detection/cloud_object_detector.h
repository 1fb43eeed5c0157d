// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/detection/object_classifier.h"
#include "datmo_fusion/sensor_model/cloud_ground.h"
#include "datmo_fusion/sensor_model/lidar_points.h"

namespace datmo {

struct CloudObjectDetectorOptions {
  double min_height = 0.3;        ///< m above the ground
  double max_height = 3.5;        ///< m above the ground
  double max_range = 60.0;        ///< m
  double voxel_size = 0.25;       ///< m
  double cluster_distance = 0.5;  ///< m
  int min_points = 8;
  double max_size = 15.0;          ///< m
  double column_spacing = 0.0035;  ///< rad
  double row_spacing = 0.007;      ///< rad
  double range_sigma = 0.1;        ///< m
  double position_sigma = 0.2;     ///< m
  double max_doubt = 3.0;          ///< log odds
  OwnVehicleOptions vehicle;
  CloudGroundOptions ground;
  ObjectClassifierOptions classifier;

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// The result for one cloud. All points except those of the vehicle itself, of the ground and above
/// the height band are in some cluster, but not every cluster is an object.
struct CloudObjects {
  ObjectList list;             ///< base_link at the cloud's stamp
  CloudGround ground;          ///< reference of heights
  std::size_t points = 0;      ///< in the height band, to be clustered
  std::size_t too_large = 0;   ///< clusters: walls, hedges
  std::size_t own_points = 0;  ///< on the vehicle itself
};

/// Detects objects in a cloud of a 3D lidar: clusters of neighboring points above the ground
/// (pcl::EuclideanClusterExtraction; Rusu, Semantic 3D object maps, 2009, ch. 6.2), each with a
/// box, whose sides are those visible from above, a height, and a class by its size. Whether they
/// move is unknown.
///
/// A side on which points lie is known to the range noise; the end of a visible side, to the gap
/// between two columns of the lidar, unless something nearer hides what is beyond; all others are
/// kHiddenSide.
class CloudObjectDetector {
 public:
  /// Throws OptionError.
  explicit CloudObjectDetector(const Checked<CloudObjectDetectorOptions>& options);

  /// Detects the objects. `twist`: of the vehicle during the sweep, by which points with times are
  /// compensated to the stamp; none: all are taken as simultaneous. An empty cloud has no objects.
  CloudObjects detect(const LidarCloud& cloud, Stamp stamp,
                      const std::optional<Twist2>& twist) const;

 private:
  CloudObjectDetectorOptions options_;
  ObjectClassifier classifier_;
};

}  // namespace datmo
