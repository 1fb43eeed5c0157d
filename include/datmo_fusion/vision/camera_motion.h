// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/vision/point_velocity.h"
#include "datmo_fusion/vision/stereo_rig.h"

namespace datmo {

/// A feature that was matched in both images of two exposures of a stereo camera.
struct FeatureQuad {
  StereoFeature earlier;
  StereoFeature later;
};

using MotionCovariance = Eigen::Matrix<double, 6, 6>;

/// How a camera moved from one exposure to the next.
struct CameraMotion {
  /// Pose of the camera at the earlier exposure in its frame at the later one.
  Eigen::Isometry3d earlier_in_later = Eigen::Isometry3d::Identity();
  /// Of a small rotation (rad), followed by a translation (m), in the later frame's axes.
  MotionCovariance covariance = MotionCovariance::Identity();
  double inliers = 0.0;  ///< sum of the features' probabilities of being static
};

/// Prior knowledge of the motion of a camera on a vehicle, without the images.
struct CameraMotionPrior {
  Pose2 moved;  ///< pose of the vehicle at the later exposure in its frame at the earlier one
  double seconds = 0.0;      ///< between the exposures, > 0
  double turn_sigma = 0.0;   ///< rad/s, > 0, about each axis
  double speed_sigma = 0.0;  ///< m/s, > 0, along each axis
};

/// Converts the prior to a motion of the camera; `mounted_earlier`, `mounted_later`: camera poses
/// in the vehicle's frame, z up.
CameraMotion priorMotion(const CameraMotionPrior& prior, const Eigen::Isometry3d& mounted_earlier,
                         const Eigen::Isometry3d& mounted_later);

struct CameraMotionOptions {
  double moving_share = 0.3;   ///< 1
  double max_residual = 30.0;  ///< px
  /// 3 to 10000: minimum number of stationary features; with fewer the motion is unknown
  double min_inliers = 12.0;

  void visit(OptionVisitor& visitor);
};

/// Estimates the motion of a stereo camera from features that are mostly static, by maximum
/// likelihood: each feature is either static, with the noise of its disparities and its flow, or
/// moving or mismatched, then uniform over `max_residual` px in column, row and disparity
/// (iteratively reweighted Gauss-Newton, from large to small tolerances, so that a wrong `prior`
/// does not trap it; Geiger, Ziegler and Stiller, StereoScan: dense 3d reconstruction in real-time,
/// 2011, section 3, without its random samples).
///
/// `prior`: motion known without the images, as from odometry; it is used as one more measurement
/// with its covariance. Returns none if fewer than `min_inliers` features are static, or values are
/// not finite. Throws std::invalid_argument like pointVelocity, and OptionError.
std::optional<CameraMotion> cameraMotion(const StereoRig& rig,
                                         const std::vector<FeatureQuad>& quads,
                                         const CameraMotion& prior,
                                         const Checked<CameraMotionOptions>& options);

/// Returns the velocity covariance, m^2/s^2, that the uncertainty of the camera's own motion causes
/// for a point (m, later frame) over `seconds` > 0: nearly common to all points.
Eigen::Matrix3d commonVelocityCovariance(const CameraMotion& motion, const Eigen::Vector3d& point,
                                         double seconds);

/// Returns the velocities of all features with their common covariance, between two exposures with
/// this motion, in the frame of `later`; features without velocity (pointVelocity) are omitted.
std::vector<PointVelocity> pointVelocities(const StereoRig& rig,
                                           const std::vector<FeatureQuad>& quads,
                                           const CameraMotion& motion, Stamp earlier,
                                           const Exposure& later);

}  // namespace datmo
