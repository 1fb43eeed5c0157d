// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/camera_motion.h"

#include <limits>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::camera_motion_test {
namespace {

// Focal length times baseline: 200 px m.
const StereoRig kRig{{500.0, 500.0, 320.0, 240.0}, 0.4, 0.15, 0.15};
constexpr double kInterval = 0.1;  // s

StereoFeature project(const Eigen::Vector3d& point, Random& random) {
  const auto noise = [&random] { return random.normal(kRig.disparity_sigma); };
  return {{320.0 + 500.0 * point.x() / point.z(), 240.0 + 500.0 * point.y() / point.z()},
          200.0 / point.z() + noise()};
}

/// 10 m/s ahead, in a bend, pitching.
Eigen::Isometry3d trueMotion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = (Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(0.004, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
  motion.translation() = Eigen::Vector3d(0.02, 0.0, -1.0);
  return motion;
}

/// Features of the static scene, and of an object that has moved by `shift` (m).
void add(std::vector<FeatureQuad>& quads, int count, const Eigen::Vector3d& shift, Random& random) {
  for (int i = 0; i < count; ++i) {
    const double depth = random.uniform(5.0, 40.0);
    const Eigen::Vector3d point(random.uniform(-0.5, 0.5) * depth,
                                random.uniform(-0.2, 0.1) * depth, depth);
    FeatureQuad quad{project(point, random), project(trueMotion() * (point + shift), random)};
    quad.later.pixel +=
        Eigen::Vector2d(random.normal(kRig.flow_sigma), random.normal(kRig.flow_sigma));
    quads.push_back(quad);
  }
}

/// Poorly known: 3 degrees, 1 m.
CameraMotion vaguePrior(const Eigen::Isometry3d& motion) {
  CameraMotion prior;
  prior.earlier_in_later = motion;
  prior.covariance.diagonal() << 0.003, 0.003, 0.003, 1.0, 1.0, 1.0;
  return prior;
}

Eigen::Matrix<double, 6, 1> errorOf(const CameraMotion& motion) {
  const Eigen::Isometry3d difference = trueMotion() * motion.earlier_in_later.inverse();
  const Eigen::AngleAxisd turn(difference.linear());
  Eigen::Matrix<double, 6, 1> error;
  error << turn.angle() * turn.axis(), difference.translation();
  return error;
}

TEST(CameraMotion, IsFoundFromAZeroMotionPriorThoughAThirdMoves) {
  Random random(1);
  std::vector<FeatureQuad> quads;
  add(quads, 200, Eigen::Vector3d::Zero(), random);
  add(quads, 100, {1.0, 0.0, 0.5}, random);
  const auto motion =
      cameraMotion(kRig, quads, vaguePrior(Eigen::Isometry3d::Identity()), CameraMotionOptions());
  ASSERT_TRUE(motion);
  EXPECT_LT(errorOf(*motion).head<3>().norm(), 0.0015);
  EXPECT_LT(errorOf(*motion).tail<3>().norm(), 0.05);
  EXPECT_NEAR(motion->inliers, 200.0, 30.0);
}

TEST(CameraMotion, CovarianceIsConsistent) {
  constexpr int kRuns = 100;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(run + 10));
    std::vector<FeatureQuad> quads;
    add(quads, 100, Eigen::Vector3d::Zero(), random);
    add(quads, 10, {1.0, 0.0, 0.0}, random);
    const auto motion = cameraMotion(kRig, quads, vaguePrior(trueMotion()), CameraMotionOptions());
    ASSERT_TRUE(motion);
    const auto error = errorOf(*motion);
    nees += error.dot(motion->covariance.inverse() * error) / kRuns;
  }
  EXPECT_GT(nees, 4.0) << "6 degrees of freedom";
  EXPECT_LT(nees, 9.0);
}

TEST(CameraMotion, ACertainPriorIsKeptWhenAnObjectFillsTheImage) {
  Random random(2);
  std::vector<FeatureQuad> quads;
  add(quads, 40, Eigen::Vector3d::Zero(), random);
  add(quads, 160, {0.0, 0.0, 0.8}, random);
  CameraMotion prior = vaguePrior(trueMotion());
  prior.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
  CameraMotionOptions options;
  options.moving_share = 0.8;
  const auto motion = cameraMotion(kRig, quads, prior, options);
  ASSERT_TRUE(motion);
  EXPECT_LT(errorOf(*motion).tail<3>().norm(), 0.1);
}

TEST(CameraMotion, TooFewFeaturesGiveNothing) {
  Random random(3);
  std::vector<FeatureQuad> quads;
  add(quads, 5, Eigen::Vector3d::Zero(), random);
  EXPECT_FALSE(cameraMotion(kRig, quads, vaguePrior(trueMotion()), CameraMotionOptions()));
  quads.assign(100, quads.front());
  for (FeatureQuad& quad : quads) {
    quad.later.disparity = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_FALSE(cameraMotion(kRig, quads, vaguePrior(trueMotion()), CameraMotionOptions()));
}

TEST(CameraMotion, CommonErrorGrowsWithTheDistance) {
  CameraMotion motion;
  motion.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
  const Eigen::Matrix3d near = commonVelocityCovariance(motion, {0.0, 0.0, 10.0}, kInterval);
  // To the side: 1 mrad at 10 m is 1 cm, and 1 cm of its own, in 0.1 s.
  EXPECT_NEAR(near(0, 0), 0.02, 1e-9);
  EXPECT_NEAR(near(2, 2), 0.01, 1e-9);
}

}  // namespace
}  // namespace datmo::camera_motion_test
