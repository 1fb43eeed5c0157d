// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/lidar_points.h"
#include "datmo_fusion/sensor_model/road_plane.h"

namespace datmo {

struct CloudGroundOptions {
  bool estimate = true;
  double max_distance = 30.0;  ///< m
  double half_width = 10.0;    ///< m
  double voxel_size = 0.5;     ///< m
  double tolerance = 0.1;      ///< m
  int min_voxels = 60;
  double max_slope = 0.1;   ///< m / m
  double max_height = 0.4;  ///< m

  void visit(OptionVisitor& visitor);
};

/// The ground below a cloud.
struct CloudGround {
  RoadPlane plane;         ///< z = 0 of the base frame if none was found
  bool seen = false;       ///< found in this cloud
  std::size_t voxels = 0;  ///< inliers of the plane
};

/// Finds the ground plane around the vehicle in a cloud of a 3D lidar: RANSAC (Fischler and Bolles,
/// Random sample consensus, 1981; pcl::SACSegmentation with PCL's fixed seed, so that the same
/// cloud gives the same plane) over the centroids of voxels, so that dense points near the lidar do
/// not outweigh distant ones, then least squares through its inliers.
///
/// `points`: base_link, m, of which only `indices` are used. A plane that is too steep, too far
/// from z = 0 of base_link or has too little support is rejected; the ground then follows from the
/// lidar's mount.
CloudGround findGround(const LidarPoints& points, const std::vector<int>& indices,
                       const CloudGroundOptions& options);

}  // namespace datmo
