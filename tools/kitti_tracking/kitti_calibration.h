// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

namespace datmo::kitti {

using Projection = Eigen::Matrix<double, 3, 4>;

/// Calibration of the sensors of a KITTI tracking sequence. A point is a column vector, homogeneous
/// if the matrix has four columns; m, px.
struct Calibration {
  Projection image_from_camera = Projection::Zero();        ///< P2: rectified -> left color image
  Eigen::Matrix3d rectification = Eigen::Matrix3d::Zero();  ///< R0_rect: camera 0 -> rectified
  Projection camera_from_velodyne = Projection::Zero();     ///< Tr_velo_to_cam, to camera 0
  Projection velodyne_from_imu = Projection::Zero();        ///< Tr_imu_to_velo
};

/// Reads `KEY: VALUES` lines, with the names of the object benchmark (above) or those of the
/// tracking benchmark (R_rect, Tr_velo_cam, Tr_imu_velo); other keys are ignored. Throws
/// std::runtime_error that names the file, the line, the value and what was expected, and for a key
/// that is missing.
Calibration readCalibration(const std::string& file);

}  // namespace datmo::kitti
