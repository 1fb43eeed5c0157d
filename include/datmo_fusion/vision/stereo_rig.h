// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/vision/box_projection.h"

namespace datmo {

/// A rectified pair of cameras and the noise of features in its images.
struct StereoRig {
  PinholeCamera left;
  double baseline = 0.0;         ///< m, > 0: from the left camera to the right one
  double flow_sigma = 0.0;       ///< px, > 0: of a feature's motion from image to image, by axis
  double disparity_sigma = 0.0;  ///< px, > 0: of each disparity, independent between images
};

/// A feature of the left image that has a disparity.
struct StereoFeature {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< px
  double disparity = 0.0;                           ///< px, left column minus right one
};

/// Throws std::invalid_argument if a focal length, the baseline or a standard deviation is not
/// positive.
void checkRig(const StereoRig& rig);

/// Whether a feature is finite and its disparity at least three of its standard deviations;
/// otherwise its depth has no useful mean.
bool isUsable(const StereoRig& rig, const StereoFeature& feature);

/// Returns the point of a usable feature, m, left camera's frame.
Eigen::Vector3d triangulate(const StereoRig& rig, const StereoFeature& feature);

}  // namespace datmo
