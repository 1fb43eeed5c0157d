#include "datmo_fusion/tracking/object_check.h"

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

TEST(ObjectCheck, TransformTurnsPlaceCovarianceAndPoints) {
  Object object = objectAt(2.0, 0.0);
  object.position_covariance = Eigen::Vector2d(4.0, 1.0).asDiagonal();
  object.points = {Point2(1.0, 0.0)};
  const Object turned = transformed(Pose2(10.0, 0.0, 0.5 * kPi), object);
  EXPECT_TRUE(turned.box.centre.position().isApprox(Point2(10.0, 2.0), 1e-12));
  EXPECT_NEAR(turned.box.centre.heading(), 0.5 * kPi, 1e-12);
  const Eigen::Matrix2d expected = Eigen::Vector2d(1.0, 4.0).asDiagonal();
  EXPECT_TRUE(turned.position_covariance.isApprox(expected, 1e-12));
  EXPECT_TRUE(turned.points[0].isApprox(Point2(10.0, 1.0), 1e-12));
}

TEST(ObjectCheck, TakesAGoodObjectAndRefusesASkewCovariance) {
  Object object = objectAt(1.0, 2.0);
  EXPECT_TRUE(isValid(object));
  object.position_covariance << 1.0, 0.5, 0.0, 1.0;
  EXPECT_FALSE(isValid(object));
  object.position_covariance << -1.0, 0.0, 0.0, -1.0;
  EXPECT_FALSE(isValid(object));
}

TEST(ObjectCheck, SharesAreFromZeroToOne) {
  Object object = objectAt(1.0, 2.0);
  object.moving_fraction = 1.0;
  object.class_probability = 1.0;
  EXPECT_TRUE(isValid(object));
  object.moving_fraction = 1000.0;  // would outweigh all other evidence of motion
  EXPECT_FALSE(isValid(object));
  object.moving_fraction = 1.0;
  object.class_probability = -0.5;
  EXPECT_FALSE(isValid(object));
}

}  // namespace
}  // namespace datmo
