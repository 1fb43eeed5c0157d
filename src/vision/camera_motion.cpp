// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/camera_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Jacobian = Eigen::Matrix<double, 3, 6>;

/// Tolerances of the iterations, in multiples of the features' noise.
constexpr std::array<double, 10> kScales = {16.0, 8.0, 4.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

/// m; points closer to the camera's plane are not projected.
constexpr double kMinDepth = 0.1;

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

/// Jacobian of a point's motion for a small rotation and translation of its frame's content.
Jacobian shiftOf(const Eigen::Vector3d& point) {
  Jacobian jacobian;
  jacobian << -crossMatrix(point), Eigen::Matrix3d::Identity();
  return jacobian;
}

Eigen::Isometry3d small(const Vector6d& motion) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d turn = motion.head<3>();
  if (turn.norm() > 0.0) {
    result.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  result.translation() = motion.tail<3>();
  return result;
}

Vector6d smallOf(const Eigen::Isometry3d& motion) {
  const Eigen::AngleAxisd turn(motion.linear());
  Vector6d result;
  result << turn.angle() * turn.axis(), motion.translation();
  return result;
}

/// Column, row and disparity of a point, and their derivatives.
struct Projection {
  Eigen::Vector3d image;
  Eigen::Matrix3d by_point;
};

Projection project(const StereoRig& rig, const Eigen::Vector3d& point) {
  const double fx = rig.left.focal_x / point.z();
  const double fy = rig.left.focal_y / point.z();
  const double disparity = fx * rig.baseline;
  Projection result;
  result.image << fx * point.x() + rig.left.center_x, fy * point.y() + rig.left.center_y, disparity;
  result.by_point << fx, 0.0, -fx * point.x() / point.z(),  //
      0.0, fy, -fy * point.y() / point.z(),                 //
      0.0, 0.0, -disparity / point.z();
  return result;
}

Eigen::Isometry3d inSpace(const Pose2& pose) {
  Eigen::Isometry3d result(Eigen::AngleAxisd(pose.heading(), Eigen::Vector3d::UnitZ()));
  result.translation().head<2>() = pose.position();
  return result;
}

/// A feature prepared for comparison: its earlier position (m, earlier frame), the derivative with
/// respect to the disparity (m/px), and its observation.
struct FeatureSample {
  Eigen::Vector3d point;
  Eigen::Vector3d by_disparity;
  Eigen::Vector3d image;
};

std::vector<FeatureSample> featureSamplesOf(const StereoRig& rig,
                                            const std::vector<FeatureQuad>& quads) {
  std::vector<FeatureSample> samples;
  samples.reserve(quads.size());
  for (const auto& [earlier, later] : quads) {
    if (isUsable(rig, earlier) && isUsable(rig, later)) {
      const Eigen::Vector3d point = triangulate(rig, earlier);
      samples.push_back(
          {point, -point / earlier.disparity, {later.pixel.x(), later.pixel.y(), later.disparity}});
    }
  }
  return samples;
}

/// Normal equations of all features at one motion.
struct Equations {
  MotionCovariance information = MotionCovariance::Zero();
  Vector6d gradient = Vector6d::Zero();
  double inliers = 0.0;
  double squared_residuals = 0.0;  ///< of inliers, in units of their noise
};

class MotionEstimator {
 public:
  MotionEstimator(const StereoRig& rig, const CameraMotionOptions& options)
      : rig_(rig),
        moving_share_(options.moving_share),
        moving_density_(options.moving_share / std::pow(2.0 * options.max_residual, 3)) {}

  /// `scale`: factor on the noise.
  Equations equations(const std::vector<FeatureSample>& samples, const Eigen::Isometry3d& motion,
                      double scale) const {
    Equations sum;
    for (const FeatureSample& sample : samples) {
      const Eigen::Vector3d point = motion * sample.point;
      if (point.z() > kMinDepth) {
        add(sample, point, motion, scale, sum);
      }
    }
    return sum;
  }

 private:
  void add(const FeatureSample& sample, const Eigen::Vector3d& point,
           const Eigen::Isometry3d& motion, double scale, Equations& sum) const {
    const Projection projection = project(rig_, point);
    const Eigen::Vector3d by_disparity =
        projection.by_point * (motion.linear() * sample.by_disparity);
    Eigen::Matrix3d noise = square(rig_.disparity_sigma) * by_disparity * by_disparity.transpose();
    noise.diagonal() += Eigen::Vector3d(square(rig_.flow_sigma), square(rig_.flow_sigma),
                                        square(rig_.disparity_sigma));
    noise *= square(scale);
    const Eigen::Matrix3d information = noise.inverse();
    const Eigen::Vector3d residual = sample.image - projection.image;
    const double squared = residual.dot(information * residual);
    const double standing = (1.0 - moving_share_) * std::exp(-0.5 * squared) /
                            std::sqrt(std::pow(2.0 * kPi, 3) * noise.determinant());
    const double weight = standing / (standing + moving_density_);
    const Jacobian jacobian = projection.by_point * shiftOf(point);
    sum.information += weight * jacobian.transpose() * information * jacobian;
    sum.gradient += weight * jacobian.transpose() * (information * residual);
    sum.inliers += weight;
    sum.squared_residuals += weight * squared;
  }

  const StereoRig& rig_;
  double moving_share_;
  double moving_density_;  ///< 1/px^3
};

/// Squared residuals per degree of freedom if they exceed the noise; at least 1.
double excessResidual(const Equations& equations) {
  const double degrees_of_freedom = 3.0 * equations.inliers - 6.0;
  return degrees_of_freedom > 0.0 ? std::max(1.0, equations.squared_residuals / degrees_of_freedom)
                                  : 1.0;
}

}  // namespace

void CameraMotionOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"moving_share", "1",
       "share of features that are on moving objects or mismatched, where there are many"},
      moving_share, {0.01, 0.9});
  visitor.number(
      {"max_residual", "px",
       "their flow and disparity deviate from those of stationary features by up to this"},
      max_residual, {1.0, 1000.0});
}

CameraMotion priorMotion(const CameraMotionPrior& prior, const Eigen::Isometry3d& mounted_earlier,
                         const Eigen::Isometry3d& mounted_later) {
  CameraMotion motion;
  motion.earlier_in_later =
      mounted_later.inverse() * inSpace(prior.moved.inverse()) * mounted_earlier;
  motion.covariance.setZero();
  motion.covariance.diagonal().head<3>().setConstant(square(prior.turn_sigma * prior.seconds));
  motion.covariance.diagonal().tail<3>().setConstant(square(prior.speed_sigma * prior.seconds));
  return motion;
}

std::optional<CameraMotion> cameraMotion(const StereoRig& rig,
                                         const std::vector<FeatureQuad>& quads,
                                         const CameraMotion& prior,
                                         const Checked<CameraMotionOptions>& options) {
  checkRig(rig);
  const std::vector<FeatureSample> samples = featureSamplesOf(rig, quads);
  const MotionCovariance known = prior.covariance.inverse();
  const MotionEstimator estimator(rig, *options);
  CameraMotion motion = prior;
  for (const double scale : kScales) {
    const Equations equations = estimator.equations(samples, motion.earlier_in_later, scale);
    const Vector6d to_prior = smallOf(prior.earlier_in_later * motion.earlier_in_later.inverse());
    const MotionCovariance information = equations.information + known;
    const Vector6d step = information.ldlt().solve(equations.gradient + known * to_prior);
    motion.earlier_in_later = small(step) * motion.earlier_in_later;
    motion.covariance = excessResidual(equations) * information.inverse();
    motion.inliers = equations.inliers;
  }
  const bool found = motion.inliers >= options->min_inliers && motion.covariance.allFinite() &&
                     motion.earlier_in_later.matrix().allFinite();
  return found ? std::make_optional(motion) : std::nullopt;
}

Eigen::Matrix3d commonVelocityCovariance(const CameraMotion& motion, const Eigen::Vector3d& point,
                                         double seconds) {
  const Jacobian jacobian = shiftOf(point);
  return jacobian * motion.covariance * jacobian.transpose() / square(seconds);
}

std::vector<PointVelocity> pointVelocities(const StereoRig& rig,
                                           const std::vector<FeatureQuad>& quads,
                                           const CameraMotion& motion, Stamp earlier,
                                           const Exposure& later) {
  const Eigen::Isometry3d& camera = later.camera_in_fixed;
  const Exposure before{earlier, camera * motion.earlier_in_later};
  const double seconds = secondsBetween(earlier, later.stamp);
  std::vector<PointVelocity> points;
  for (const FeatureQuad& quad : quads) {
    if (auto point = pointVelocity(rig, quad.earlier, before, quad.later, later)) {
      const Eigen::Vector3d in_camera = camera.inverse() * point->position;
      point->common_covariance += camera.linear() *
                                  commonVelocityCovariance(motion, in_camera, seconds) *
                                  camera.linear().transpose();
      points.push_back(*point);
    }
  }
  return points;
}

}  // namespace datmo
