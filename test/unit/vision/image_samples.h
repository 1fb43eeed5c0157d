// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "datmo_fusion/vision/image_region.h"

namespace datmo::test {

inline constexpr double kCameraHeight = 1.5;  ///< m

/// 1000 x 400 px, 500 px of focal length, at the vehicle's origin, level, facing ahead: a point at
/// (x, y) on the road is at column 500 - 500 y / x and row 200 + 750 / x.
inline MountedCamera levelCamera() {
  MountedCamera camera;
  camera.pinhole = {500.0, 500.0, 500.0, 200.0};
  camera.width = 1000.0;
  camera.height = 400.0;
  camera.in_base.linear() << 0.0, 0.0, 1.0,  // x of the vehicle is the camera's z
      -1.0, 0.0, 0.0,                        // y its -x
      0.0, -1.0, 0.0;                        // z its -y
  camera.in_base.translation() = Eigen::Vector3d(0.0, 0.0, kCameraHeight);
  return camera;
}

inline Object objectAt(double x, double y, double length, double width, double height) {
  Object object;
  object.box = {Pose2(x, y, 0.0), length, width};
  object.height = height;
  object.position_covariance = 0.0025 * Eigen::Matrix2d::Identity();
  return object;
}

inline ImageDetection detectionOf(ObjectClass object_class, double left, double top, double right,
                                  double bottom, double score = 0.9) {
  return {{Eigen::Vector2d(left, top), Eigen::Vector2d(right, bottom)}, object_class, score};
}

/// Detects the same in each image.
class FixedDetector : public ImageDetector {
 public:
  explicit FixedDetector(std::vector<ImageDetection> seen) : seen_(std::move(seen)) {}

  std::vector<ImageDetection> detect(const cv::Mat& /*image*/,
                                     const std::vector<ImageRegion>& /*regions*/) override {
    return seen_;
  }

 private:
  std::vector<ImageDetection> seen_;
};

}  // namespace datmo::test
