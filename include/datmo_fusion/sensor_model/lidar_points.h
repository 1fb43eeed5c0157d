// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "datmo_fusion/sensor_model/own_vehicle.h"

namespace datmo {

using LidarPoints = pcl::PointCloud<pcl::PointXYZ>;

/// One cloud of a 3D lidar; all points are finite.
struct LidarCloud {
  LidarPoints::Ptr points{new LidarPoints};  ///< m, in the lidar's frame
  std::vector<float> times;  ///< s after the cloud's stamp, one per point; empty: unknown
  Eigen::Isometry3d lidar_in_base = Eigen::Isometry3d::Identity();

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

/// Returns the points of `cloud` in base_link, in the same order.
LidarPoints::Ptr toBase(const LidarCloud& cloud);

/// Returns the indices of points (base_link) outside the vehicle, at any height (pcl::CropBox).
std::vector<int> outsideOfVehicle(const LidarPoints::ConstPtr& points,
                                  const OwnVehicleOptions& vehicle);

}  // namespace datmo
