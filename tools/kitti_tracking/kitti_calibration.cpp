// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/kitti_calibration.h"

#include <stdexcept>
#include <vector>

#include "kitti_tracking/text_lines.h"

namespace datmo::kitti {

namespace {

bool isOneOf(const std::string& key, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (key == name || key == name + ":") {
      return true;
    }
  }
  return false;
}

/// Row by row.
template <typename Matrix>
void readMatrix(const TextLine& line, Matrix& matrix) {
  line.expectColumns(1 + static_cast<std::size_t>(matrix.size()));
  std::size_t column = 1;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index i = 0; i < matrix.cols(); ++i) {
      matrix(row, i) = line.number(column++, line.columns().front());
    }
  }
}

/// The last line of the file whose key is one of `names`.
template <typename Matrix>
void readMatrix(const std::string& file, const std::vector<std::string>& names, Matrix& matrix) {
  bool found = false;
  forEachLine(file, ' ', [&](const TextLine& line) {
    if (isOneOf(line.columns().front(), names)) {
      readMatrix(line, matrix);
      found = true;
    }
  });
  if (!found) {
    throw std::runtime_error(file + ": has no " + names.front() + ", expected a line of it");
  }
}

}  // namespace

Calibration readCalibration(const std::string& file) {
  Calibration calibration;
  readMatrix(file, {"P2"}, calibration.image_from_camera);
  readMatrix(file, {"R0_rect", "R_rect"}, calibration.rectification);
  readMatrix(file, {"Tr_velo_to_cam", "Tr_velo_cam"}, calibration.camera_from_velodyne);
  readMatrix(file, {"Tr_imu_to_velo", "Tr_imu_velo"}, calibration.velodyne_from_imu);
  return calibration;
}

}  // namespace datmo::kitti
