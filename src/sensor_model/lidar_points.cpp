// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/lidar_points.h"

#include <limits>

#include <pcl/common/transforms.h>
#include <pcl/filters/crop_box.h>

namespace datmo {

LidarPoints::Ptr toBase(const LidarCloud& cloud) {
  LidarPoints::Ptr points(new LidarPoints);
  if (cloud.points->empty()) {
    return points;  // avoids PCL's console warning
  }
  const Eigen::Matrix4f transform = cloud.lidar_in_base.matrix().cast<float>();
  pcl::transformPointCloud(*cloud.points, *points, transform);
  return points;
}

std::vector<int> outsideOfVehicle(const LidarPoints::ConstPtr& points,
                                  const OwnVehicleOptions& vehicle) {
  constexpr float kFar = std::numeric_limits<float>::max();
  const auto half_width = static_cast<float>(vehicle.half_width);
  pcl::CropBox<pcl::PointXYZ> box;
  box.setInputCloud(points);
  box.setMin({static_cast<float>(vehicle.rear), -half_width, -kFar, 1.0F});
  box.setMax({static_cast<float>(vehicle.front), half_width, kFar, 1.0F});
  box.setNegative(true);
  std::vector<int> outside;
  box.filter(outside);
  return outside;
}

}  // namespace datmo
