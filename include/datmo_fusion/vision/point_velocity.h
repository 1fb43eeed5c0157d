// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/vision/box_projection.h"

namespace datmo {

/// A rectified pair of cameras and the noise of what is found in its images.
struct StereoPair {
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

/// When an image pair was taken, and from where: the left camera's optical frame in a fixed frame.
struct Exposure {
  Stamp stamp;
  Eigen::Isometry3d camera_in_fixed = Eigen::Isometry3d::Identity();
};

/// A point and how it moves, in the fixed frame's axes.
struct PointVelocity {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< m, at the later exposure
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();    ///< m/s
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the velocity, m^2/s^2
};

/// The velocity of one feature found in two image pairs, own motion taken out by the two poses
/// (Franke et al. 2005, "6D-Vision", for two exposures and without its filter). The covariance is
/// of first order in the noise of flow and disparity; errors of the poses are not in it. Nothing if
/// `earlier` does not precede `later`, a value is not finite, or a disparity is less than three of
/// its standard deviations: its depth has no useful mean. Throws std::invalid_argument if a focal
/// length, the baseline or a standard deviation is not more than 0.
std::optional<PointVelocity> pointVelocity(const StereoPair& pair, const StereoFeature& from,
                                           const Exposure& earlier, const StereoFeature& to,
                                           const Exposure& later);

/// How the features of one object become its velocity.
struct SharedVelocityOptions {
  double outlier_share = 0.2;  ///< in (0, 1): features that are not the object's, or mismatched
  double max_speed = 40.0;     ///< m/s, > 0: velocities of outliers are uniform up to it
  double min_inliers = 3.0;    ///< > 0: sum of the features' probabilities to be the object's
  /// m^2/s^2, of what all features share and their number does not lessen: errors of the own
  /// motion, and of the matcher where windows overlap.
  Eigen::Matrix2d common_covariance = Eigen::Matrix2d::Zero();
};

/// The velocity over the ground that features of one object share.
struct SharedVelocity {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();    ///< m/s
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2/s^2
  double inliers = 0.0;                                  ///< sum of probabilities
};

/// The most likely x and y velocity of the points: normal with each point's covariance, or an
/// outlier, uniform over all speeds (expectation maximization from the most likely one of the
/// points' own velocities). The covariance grows with the scatter of the inliers where that is more
/// than their noise says, as when the object turns. Nothing if fewer than `min_inliers` agree.
/// Covariances must be positive definite. Throws std::invalid_argument for options out of range.
std::optional<SharedVelocity> sharedVelocity(const std::vector<PointVelocity>& points,
                                             const SharedVelocityOptions& options);

}  // namespace datmo
