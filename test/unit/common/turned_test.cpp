// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/turned.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace datmo::turned_test {
namespace {

TEST(Turned, IsTheRotationToTheSeriesAccuracy) {
  const Point2 vector(3.0, -4.0);
  for (const double angle : {0.0, 0.05, 0.0999, -0.0999, 0.1001, -0.1001, 3.0, -3.0}) {
    const Point2 exact = Eigen::Rotation2Dd(angle) * vector;
    EXPECT_LT((turned(vector, angle) - exact).norm(), 1e-5 * vector.norm()) << angle;
  }
}

TEST(Turned, ToTheLeftForPositiveAngles) {
  EXPECT_GT(turned({1.0, 0.0}, 0.05).y(), 0.0);
  EXPECT_GT(turned({1.0, 0.0}, 1.0).y(), 0.0);
}

}  // namespace
}  // namespace datmo::turned_test
