// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/stereo_rig.h"

#include <cmath>
#include <stdexcept>

namespace datmo {

namespace {

constexpr double kMinDisparitySigmas = 3.0;

}  // namespace

void checkRig(const StereoRig& rig) {
  const bool valid = rig.left.focal_x > 0.0 && rig.left.focal_y > 0.0 && rig.baseline > 0.0 &&
                     rig.flow_sigma > 0.0 && rig.disparity_sigma > 0.0;
  if (!valid) {
    throw std::invalid_argument(
        "stereo rig: focal lengths, baseline, flow_sigma and disparity_sigma must be more than 0");
  }
}

bool isUsable(const StereoRig& rig, const StereoFeature& feature) {
  return feature.pixel.allFinite() && std::isfinite(feature.disparity) &&
         feature.disparity >= kMinDisparitySigmas * rig.disparity_sigma;
}

Eigen::Vector3d triangulate(const StereoRig& rig, const StereoFeature& feature) {
  const PinholeCamera& camera = rig.left;
  const double depth = camera.focal_x * rig.baseline / feature.disparity;
  return {depth * (feature.pixel.x() - camera.center_x) / camera.focal_x,
          depth * (feature.pixel.y() - camera.center_y) / camera.focal_y, depth};
}

}  // namespace datmo
