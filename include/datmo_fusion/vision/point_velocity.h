// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/vision/stereo_rig.h"

namespace datmo {

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
  /// m^2/s^2, what comes on top and neighbors have in common: the camera's own motion, and errors
  /// of the images' rectification.
  Eigen::Matrix3d common_covariance = Eigen::Matrix3d::Zero();
};

/// The velocity of one feature found in two image pairs, own motion taken out by the two poses
/// (Franke et al. 2005, "6D-Vision", for two exposures and without its filter). The covariance is
/// of first order in the noise of flow and disparity; errors of the poses are not in it. Nothing if
/// `earlier` does not precede `later`, a value is not finite, or a disparity is less than three of
/// its standard deviations: its depth has no useful mean. Throws std::invalid_argument if a focal
/// length, the baseline or a standard deviation is not more than 0.
std::optional<PointVelocity> pointVelocity(const StereoRig& rig, const StereoFeature& from,
                                           const Exposure& earlier, const StereoFeature& to,
                                           const Exposure& later);

/// How the features of one object become its velocity.
struct SharedVelocityOptions {
  double outlier_share = 0.2;  ///< 1
  double max_speed = 40.0;     ///< m/s
  double turn_rate = 0.2;      ///< rad/s
  double curvature = 0.1;      ///< 1/m

  void visit(OptionVisitor& visitor);
};

/// About which a body turns, as far as that is known.
struct BodyCenter {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2
};

/// The velocity over the ground of the center of an object, from its features.
struct SharedVelocity {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();    ///< m/s
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2/s^2
  double inliers = 0.0;                                  ///< sum of probabilities
  double wrong_probability = 1.0;  ///< 0 to 1, that all inliers are of something else
};

/// The most likely x and y velocity of the points: normal with each point's covariance, or an
/// outlier, uniform over all speeds (expectation maximization from the most likely one of the
/// points' own velocities). The covariance grows with the scatter of the inliers where that is more
/// than their noise says; what they have in common stays, however many they are; and as that of the
/// center it is the less certain the farther the points are from it: the rear of a van that turns
/// moves aside. (The turn rate is not estimated: at the end of a line of sight the noise of range
/// makes levers where there are none.) It is the object's own unless all inliers are outliers that
/// agree by chance: the fewer they are the likelier. Nothing of no points, or beyond `max_speed`.
/// Covariances must be positive definite, the center's semidefinite. Throws OptionError.
std::optional<SharedVelocity> sharedVelocity(const std::vector<PointVelocity>& points,
                                             const BodyCenter& center,
                                             const Checked<SharedVelocityOptions>& options);

}  // namespace datmo
