// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/sensor_model/lidar_points.h"

/// Clouds of a 3D lidar, which tests modify.
namespace datmo::samples {

inline constexpr double kLidarHeight = 1.7;  // m above the ground

/// The lidar 0.5 m ahead of the vehicle's origin, pitched down by `pitch` (rad).
inline Eigen::Isometry3d lidarMount(double pitch = 0.0) {
  return Eigen::Translation3d(0.5, 0.0, kLidarHeight) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
}

/// Points of base_link (m) as the mounted lidar measures them.
class LidarCloudMaker {
 public:
  explicit LidarCloudMaker(const Eigen::Isometry3d& mount = lidarMount()) {
    cloud.lidar_in_base = mount;
  }

  void add(double x, double y, double z) {
    const Eigen::Vector3d point = cloud.lidar_in_base.inverse() * Eigen::Vector3d(x, y, z);
    cloud.points->push_back({static_cast<float>(point.x()), static_cast<float>(point.y()),
                             static_cast<float>(point.z())});
  }

  /// Rings of the ground z = height + slope_x x + slope_y y around the lidar, one point per degree.
  void addGround(double height = 0.0, double slope_x = 0.0, double slope_y = 0.0) {
    const Eigen::Vector3d lidar = cloud.lidar_in_base.translation();
    for (int ring = 0; ring < 30; ++ring) {
      const double range = 3.0 + ring;
      for (int i = 0; i < 360; ++i) {
        const double bearing = degrees(i + 0.5);
        const double x = lidar.x() + range * std::cos(bearing);
        const double y = lidar.y() + range * std::sin(bearing);
        add(x, y, height + slope_x * x + slope_y * y);
      }
    }
  }

  /// A wall across the view, at `x` ahead of the vehicle's origin, from y = -1 to 1, z = 0 to 2
  /// (m).
  void addWall(double x, double ground = 0.0) {
    for (int row = 0; row <= 20; ++row) {
      for (int column = -20; column <= 20; ++column) {
        add(x, 0.05 * column, ground + 0.1 * row);
      }
    }
  }

  LidarCloud cloud;
};

}  // namespace datmo::samples
