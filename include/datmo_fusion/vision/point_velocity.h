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

/// Stamp of an image pair and pose of the left camera's optical frame in a fixed frame.
struct Exposure {
  Stamp stamp;
  Eigen::Isometry3d camera_in_fixed = Eigen::Isometry3d::Identity();
};

/// A point and its velocity, in the fixed frame's axes.
struct PointVelocity {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< m, at the later exposure
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();    ///< m/s
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the velocity, m^2/s^2
  /// m^2/s^2, additional covariance that neighbors have in common: from the camera's own motion and
  /// from rectification errors.
  Eigen::Matrix3d common_covariance = Eigen::Matrix3d::Zero();
};

/// Returns the velocity of a feature found in two image pairs, compensated for the camera's motion
/// by the two poses (Franke et al. 2005, "6D-Vision", for two exposures and without its filter).
/// The covariance is first order in the noise of flow and disparity; it does not include errors of
/// the poses. Returns none if `earlier` does not precede `later`, a value is not finite, or a
/// disparity is less than three of its standard deviations: its depth has no useful mean. Throws
/// std::invalid_argument if a focal length, the baseline or a standard deviation is not positive.
std::optional<PointVelocity> pointVelocity(const StereoRig& rig, const StereoFeature& from,
                                           const Exposure& earlier, const StereoFeature& to,
                                           const Exposure& later);

/// How the velocities of an object's features are fused.
struct SharedVelocityOptions {
  double outlier_share = 0.2;  ///< 1
  double max_speed = 40.0;     ///< m/s
  double turn_rate = 0.2;      ///< rad/s
  double curvature = 0.1;      ///< 1/m

  void visit(OptionVisitor& visitor);
};

/// Estimated center about which a body turns.
struct BodyCenter {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2
};

/// Velocity of an object's center over ground, from its features.
struct SharedVelocity {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();    ///< m/s
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2/s^2
  double inliers = 0.0;                                  ///< sum of probabilities
  double wrong_probability = 1.0;  ///< 0 to 1, that all inliers belong to something else
};

/// Returns the most likely x and y velocity of the points: each is either normal with its
/// covariance, or an outlier, uniform over all speeds (expectation maximization, started from the
/// most likely of the points' own velocities). The covariance grows if the inliers scatter more
/// than their noise; the common part stays regardless of their number; and since the velocity is
/// that of the center, it is less certain the farther the points are from it: the rear of a turning
/// van moves sideways. (The turn rate is not estimated: at the end of a line of sight range noise
/// creates false lever arms.) The result is wrong if all inliers are outliers that agree by chance,
/// which is likelier the fewer they are. None without points, or beyond `max_speed`. Covariances
/// must be positive definite, the center's semidefinite. Throws OptionError.
std::optional<SharedVelocity> sharedVelocity(const std::vector<PointVelocity>& points,
                                             const BodyCenter& center,
                                             const Checked<SharedVelocityOptions>& options);

}  // namespace datmo
