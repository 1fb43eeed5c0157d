// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/pose2.h"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace datmo::pose2_test {
namespace {

class RandomPoses {
 public:
  Pose2 next() { return {meters_(random_), meters_(random_), radians_(random_)}; }
  Point2 point() { return {meters_(random_), meters_(random_)}; }

 private:
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> meters_{-50.0, 50.0};
  std::uniform_real_distribution<double> radians_{-kPi, kPi};
};

void expectNear(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR((a.position() - b.position()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(angleBetween(a.heading(), b.heading()), 0.0, 1e-9);
}

TEST(Pose2, ASensorAheadOfACarFacingLeft) {
  const Pose2 car_in_map(10.0, 5.0, kPi / 2.0);
  const Pose2 sensor_in_car(2.0, 0.0, 0.0);
  expectNear(car_in_map * sensor_in_car, {10.0, 7.0, kPi / 2.0});
}

TEST(Pose2, TransformsAPointToTheParentFrame) {
  const Point2 in_parent = Pose2(1.0, 2.0, kPi / 2.0) * Point2(3.0, 0.0);
  EXPECT_NEAR(in_parent.x(), 1.0, 1e-12);
  EXPECT_NEAR(in_parent.y(), 5.0, 1e-12);
}

TEST(Pose2, HeadingIsNormalized) { EXPECT_NEAR(Pose2(0, 0, 1.5 * kPi).heading(), -kPi / 2, 1e-12); }

TEST(Pose2, InverseUndoes) {
  RandomPoses poses;
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose = poses.next();
    expectNear(pose * pose.inverse(), {});
    expectNear(pose.inverse() * pose, {});
  }
}

TEST(Pose2, CompositionIsAssociativeAndAgreesOnPoints) {
  RandomPoses poses;
  for (int i = 0; i < 200; ++i) {
    const Pose2 a = poses.next();
    const Pose2 b = poses.next();
    const Pose2 c = poses.next();
    const Point2 point = poses.point();
    expectNear((a * b) * c, a * (b * c));
    EXPECT_NEAR(((a * b) * point - a * (b * point)).norm(), 0.0, 1e-9);
  }
}

TEST(Pose2, RotationMatrixTurnsAsRotateDoes) {
  RandomPoses poses;
  const Pose2 pose = poses.next();
  const Point2 vector = poses.point();
  EXPECT_NEAR((pose.rotation() * vector - pose.rotate(vector)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(pose.rotation().determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace datmo::pose2_test
