// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/angle.h"

#include <random>

#include <gtest/gtest.h>

namespace datmo::angle_test {
namespace {

TEST(Angle, DegreesAndBack) {
  EXPECT_DOUBLE_EQ(degrees(180.0), kPi);
  EXPECT_DOUBLE_EQ(toDegrees(kPi / 2.0), 90.0);
}

TEST(Angle, HalfTurnIsAlwaysThePositiveOne) {
  EXPECT_EQ(normalizeAngle(kPi), kPi);
  EXPECT_EQ(normalizeAngle(-kPi), kPi);
  EXPECT_NEAR(normalizeAngle(3.0 * kPi), kPi, 1e-12);
}

TEST(Angle, NormalizedIsInRangeAndTheSameDirection) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-100.0, 100.0);
  for (int i = 0; i < 1000; ++i) {
    const double angle = any(random);
    const double normalized = normalizeAngle(angle);
    EXPECT_GT(normalized, -kPi);
    EXPECT_LE(normalized, kPi);
    EXPECT_NEAR(std::cos(normalized), std::cos(angle), 1e-12);
    EXPECT_NEAR(std::sin(normalized), std::sin(angle), 1e-12);
  }
}

TEST(Angle, BetweenGoesTheShortWay) {
  EXPECT_NEAR(angleBetween(degrees(170.0), degrees(-170.0)), degrees(20.0), 1e-12);
  EXPECT_NEAR(angleBetween(degrees(-170.0), degrees(170.0)), degrees(-20.0), 1e-12);
  EXPECT_NEAR(angleBetween(degrees(10.0), degrees(40.0)), degrees(30.0), 1e-12);
}

}  // namespace
}  // namespace datmo::angle_test
