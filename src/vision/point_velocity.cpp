// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/point_velocity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kConverged = 1e-6;  // m/s

/// Common error of neighbors, in units of each one's own error: rectification residuals, and the
/// matcher's reaction to blur. Velocities of static objects, measured at 8 m to 30 m by a pair with
/// 0.1 px noise, were off by 0.1 px of flow and 0.05 px of the disparity's change regardless of the
/// number of features per object (KITTI raw drive 0005, medians).
constexpr double kCommonFlow = 1.0;
constexpr double kCommonDisparity = 0.5;

/// Covariance of a triangulated point, in the optical frame; the depth is f b / d. Standard
/// deviations in px.
Eigen::Matrix3d pointCovariance(const StereoRig& rig, const Eigen::Vector3d& point,
                                double disparity, double disparity_sigma, double pixel_sigma) {
  const Eigen::Vector3d by_disparity = -point / disparity * disparity_sigma;
  const Eigen::Vector3d by_pixel(point.z() / rig.left.focal_x * pixel_sigma,
                                 point.z() / rig.left.focal_y * pixel_sigma, 0.0);
  Eigen::Matrix3d covariance = by_disparity * by_disparity.transpose();
  covariance.diagonal() += by_pixel.cwiseAbs2();
  return covariance;
}

Eigen::Matrix3d turned(const Eigen::Isometry3d& pose, const Eigen::Matrix3d& covariance) {
  return pose.linear() * covariance * pose.linear().transpose();
}

/// A point's velocity over ground, prepared for weighting.
struct Sample {
  Eigen::Vector2d position;
  Eigen::Vector2d velocity;
  Eigen::Matrix2d information;
  Eigen::Matrix2d common_covariance;
  double density;  ///< peak density of its normal distribution
};

std::vector<Sample> samplesOf(const std::vector<PointVelocity>& points) {
  std::vector<Sample> samples;
  samples.reserve(points.size());
  for (const PointVelocity& point : points) {
    const Eigen::Matrix2d covariance = point.covariance.topLeftCorner<2, 2>();
    samples.push_back({point.position.head<2>(), point.velocity.head<2>(), covariance.inverse(),
                       point.common_covariance.topLeftCorner<2, 2>(),
                       1.0 / (2.0 * kPi * std::sqrt(covariance.determinant()))});
  }
  return samples;
}

double squaredDistance(const Sample& sample, const Eigen::Vector2d& velocity) {
  const Eigen::Vector2d error = sample.velocity - velocity;
  return error.dot(sample.information * error);
}

/// Mixture of inliers and outliers, with their shares.
class VelocityMixture {
 public:
  explicit VelocityMixture(const SharedVelocityOptions& options)
      : inlier_share_(1.0 - options.outlier_share),
        outlier_(options.outlier_share / (kPi * options.max_speed * options.max_speed)) {}

  double inlierProbability(const Sample& sample, const Eigen::Vector2d& velocity) const {
    const double inlier = inlierDensity(sample, velocity);
    return inlier / (inlier + outlier_);
  }

  double logLikelihood(const std::vector<Sample>& samples, const Eigen::Vector2d& velocity) const {
    double sum = 0.0;
    for (const Sample& sample : samples) {
      sum += std::log(inlierDensity(sample, velocity) + outlier_);
    }
    return sum;
  }

 private:
  double inlierDensity(const Sample& sample, const Eigen::Vector2d& velocity) const {
    return inlier_share_ * sample.density * std::exp(-0.5 * squaredDistance(sample, velocity));
  }

  double inlier_share_;
  double outlier_;
};

Eigen::Vector2d mostLikelySample(const std::vector<Sample>& samples,
                                 const VelocityMixture& mixture) {
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double best_likelihood = -std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples) {
    const double likelihood = mixture.logLikelihood(samples, sample.velocity);
    if (likelihood > best_likelihood) {
      best_likelihood = likelihood;
      best = sample.velocity;
    }
  }
  return best;
}

/// One step of expectation maximization: mean of the samples weighted by their inlier probability
/// at `around`.
SharedVelocity weightedMean(const std::vector<Sample>& samples, const VelocityMixture& mixture,
                            const Eigen::Vector2d& around) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  SharedVelocity mean;
  for (const Sample& sample : samples) {
    const double weight = mixture.inlierProbability(sample, around);
    information += weight * sample.information;
    sum += weight * sample.information * sample.velocity;
    mean.inliers += weight;
  }
  mean.covariance = information.inverse();
  mean.velocity = mean.covariance * sum;
  return mean;
}

/// Squared errors of the inliers in units of their noise, per degree of freedom; at least 1.
double excessScatter(const std::vector<Sample>& samples, const VelocityMixture& mixture,
                     const SharedVelocity& mean) {
  double sum = 0.0;
  for (const Sample& sample : samples) {
    sum +=
        mixture.inlierProbability(sample, mean.velocity) * squaredDistance(sample, mean.velocity);
  }
  const double degrees_of_freedom = 2.0 * mean.inliers - 2.0;
  return degrees_of_freedom > 0.0 ? std::max(1.0, sum / degrees_of_freedom) : 1.0;
}

/// Average over the inliers: their number does not reduce it.
Eigen::Matrix2d commonCovariance(const std::vector<Sample>& samples, const VelocityMixture& mixture,
                                 const SharedVelocity& mean) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  double weights = 0.0;
  for (const Sample& sample : samples) {
    const double weight = mixture.inlierProbability(sample, mean.velocity);
    sum += weight * sample.common_covariance;
    weights += weight;
  }
  return sum / weights;
}

/// m^2, second moment of the inliers' mean position about the body's center.
Eigen::Matrix2d leverOf(const std::vector<Sample>& samples, const VelocityMixture& mixture,
                        const SharedVelocity& mean, const BodyCenter& center) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Sample& sample : samples) {
    sum += mixture.inlierProbability(sample, mean.velocity) * sample.position;
  }
  const Eigen::Vector2d arm = sum / mean.inliers - center.position;
  return arm * arm.transpose() + center.covariance;
}

/// rad/s, standard deviation of the body's turn rate. A stationary body does not turn; the noise
/// variance is subtracted from the squared speed.
double turnRate(const SharedVelocity& mean, const SharedVelocityOptions& options) {
  const double squared_speed = mean.velocity.squaredNorm() - mean.covariance.trace();
  return std::min(options.turn_rate, options.curvature * std::sqrt(std::max(0.0, squared_speed)));
}

/// m^2/s^2, covariance of the velocity at the end of a lever arm relative to that of its center.
Eigen::Matrix2d turnCovariance(double turn_rate, const Eigen::Matrix2d& lever) {
  Eigen::Matrix2d quarter_turn;
  quarter_turn << 0.0, -1.0, 1.0, 0.0;
  return square(turn_rate) * quarter_turn * lever * quarter_turn.transpose();
}

}  // namespace

void SharedVelocityOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"outlier_share", "1",
       "share of features in an object's box that do not belong to the object, or are mismatched"},
      outlier_share, {0.001, 0.999});
  visitor.number(
      {"max_speed", "m/s", "velocities of outliers are uniformly distributed up to this"},
      max_speed, {0.1, 200.0});
  visitor.number({"turn_rate", "rad/s",
                  "standard deviation of objects' turn rates: the visible side moves differently "
                  "from the center"},
                 turn_rate, {0.0, 10.0});
  visitor.number({"curvature", "1/m",
                  "standard deviation of the curvature of objects' paths: a slow object turns no "
                  "faster than this times its speed"},
                 curvature, {0.0, 10.0});
}

std::optional<PointVelocity> pointVelocity(const StereoRig& rig, const StereoFeature& from,
                                           const Exposure& earlier, const StereoFeature& to,
                                           const Exposure& later) {
  checkRig(rig);
  const double seconds = secondsBetween(earlier.stamp, later.stamp);
  if (seconds <= 0.0 || !isUsable(rig, from) || !isUsable(rig, to) ||
      !earlier.camera_in_fixed.matrix().allFinite() ||
      !later.camera_in_fixed.matrix().allFinite()) {
    return std::nullopt;
  }
  const Eigen::Vector3d first = triangulate(rig, from);
  const Eigen::Vector3d second = triangulate(rig, to);
  PointVelocity result;
  result.position = later.camera_in_fixed * second;
  result.velocity = (result.position - earlier.camera_in_fixed * first) / seconds;
  // The first pixel defines which point is meant and has no error: the flow has it.
  result.covariance =
      (turned(earlier.camera_in_fixed,
              pointCovariance(rig, first, from.disparity, rig.disparity_sigma, 0.0)) +
       turned(later.camera_in_fixed,
              pointCovariance(rig, second, to.disparity, rig.disparity_sigma, rig.flow_sigma))) /
      square(seconds);
  result.common_covariance =
      turned(later.camera_in_fixed,
             pointCovariance(rig, second, to.disparity, kCommonDisparity * rig.disparity_sigma,
                             kCommonFlow * rig.flow_sigma)) /
      square(seconds);
  return result;
}

std::optional<SharedVelocity> sharedVelocity(const std::vector<PointVelocity>& points,
                                             const BodyCenter& center,
                                             const Checked<SharedVelocityOptions>& options) {
  if (points.empty()) {
    return std::nullopt;
  }
  const std::vector<Sample> samples = samplesOf(points);
  const VelocityMixture mixture(*options);
  Eigen::Vector2d around = mostLikelySample(samples, mixture);
  SharedVelocity mean = weightedMean(samples, mixture, around);
  for (int i = 0; i < kMaxIterations && (mean.velocity - around).norm() > kConverged; ++i) {
    around = mean.velocity;
    mean = weightedMean(samples, mixture, around);
  }
  if (!(mean.velocity.norm() <= options->max_speed)) {
    return std::nullopt;
  }
  mean.wrong_probability = std::pow(options->outlier_share, mean.inliers);
  mean.covariance *= excessScatter(samples, mixture, mean);
  mean.covariance += commonCovariance(samples, mixture, mean);
  mean.covariance +=
      turnCovariance(turnRate(mean, *options), leverOf(samples, mixture, mean, center));
  return mean;
}

}  // namespace datmo
