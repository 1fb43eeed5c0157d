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

/// A feature that was found in both images of two exposures of a stereo camera.
struct FeatureQuad {
  StereoFeature earlier;
  StereoFeature later;
};

using MotionCovariance = Eigen::Matrix<double, 6, 6>;

/// How a camera moved from one exposure to the next.
struct CameraMotion {
  /// Pose of the camera at the earlier exposure in its frame at the later one.
  Eigen::Isometry3d earlier_in_later = Eigen::Isometry3d::Identity();
  /// Of a small rotation (rad) and a translation (m) that follow, in the later frame's axes.
  MotionCovariance covariance = MotionCovariance::Identity();
  double inliers = 0.0;  ///< features that stand, sum of their probabilities
};

/// What is known without the images of how a camera on a vehicle moved.
struct CameraMotionPrior {
  Pose2 moved;  ///< pose of the vehicle at the later exposure in its frame at the earlier one
  double seconds = 0.0;      ///< between the exposures, > 0
  double turn_sigma = 0.0;   ///< rad/s, > 0, about each axis
  double speed_sigma = 0.0;  ///< m/s, > 0, along each axis
};

/// That as a motion of the camera; `mounted_earlier`, `mounted_later`: the camera in the vehicle's
/// frame, z up.
CameraMotion priorMotion(const CameraMotionPrior& prior, const Eigen::Isometry3d& mounted_earlier,
                         const Eigen::Isometry3d& mounted_later);

struct CameraMotionOptions {
  double moving_share = 0.3;   ///< 1
  double max_residual = 30.0;  ///< px
  double min_inliers = 12.0;   ///< 1

  void visit(OptionVisitor& visitor);
};

/// The motion of a stereo camera from features, most of which are on what stands: the one that
/// makes them likeliest, each standing with the noise of its disparities and its flow, or moving or
/// mismatched, then uniform over `max_residual` px in column, row and disparity (iteratively
/// reweighted Gauss-Newton, from large deviations to the real ones, so that a wrong `prior` does
/// not hold it; Geiger, Ziegler and Stiller, StereoScan: dense 3d reconstruction in real-time,
/// 2011, section 3, without its random samples).
///
/// `prior`: what is known of the motion without the images, as odometry says; its covariance counts
/// as one more measurement. Nothing if fewer than `min_inliers` features stand, or values are not
/// finite. Throws std::invalid_argument as pointVelocity does, and OptionError.
std::optional<CameraMotion> cameraMotion(const StereoRig& rig,
                                         const std::vector<FeatureQuad>& quads,
                                         const CameraMotion& prior,
                                         const Checked<CameraMotionOptions>& options);

/// m^2/s^2: of the velocity of a point (m, later frame) that `seconds` > 0 lie between, as far as
/// the camera's own motion is not known: what all points have in common, nearly.
Eigen::Matrix3d commonVelocityCovariance(const CameraMotion& motion, const Eigen::Vector3d& point,
                                         double seconds);

/// The velocities of all features, with what they have in common, between two exposures with this
/// motion. `later`: its frame is that of the result; features without velocity (pointVelocity) are
/// left out.
std::vector<PointVelocity> pointVelocities(const StereoRig& rig,
                                           const std::vector<FeatureQuad>& quads,
                                           const CameraMotion& motion, Stamp earlier,
                                           const Exposure& later);

}  // namespace datmo
