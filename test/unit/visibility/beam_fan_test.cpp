// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/beam_fan.h"

#include <limits>

#include <gtest/gtest.h>

namespace datmo::beam_fan_test {
namespace {

const double kDegree = degrees(1.0);

TEST(BeamFan, ABeamCoversHalfASpacingToEitherSide) {
  const BeamFan fan(-10.0 * kDegree, kDegree);
  EXPECT_EQ(fan.indexAt(-10.4 * kDegree, 21), 0U);
  EXPECT_EQ(fan.indexAt(-10.6 * kDegree, 21), std::nullopt);
  EXPECT_EQ(fan.indexAt(10.4 * kDegree, 21), 20U);
  EXPECT_EQ(fan.indexAt(10.6 * kDegree, 21), std::nullopt);
  EXPECT_NEAR(fan.bearingAt(12.5), 2.5 * kDegree, 1e-12);
}

TEST(BeamFan, BearingsAreOfAnyTurnAndEitherDirection) {
  for (const double direction : {1.0, -1.0}) {
    const BeamFan fan(direction * -kPi, direction * kDegree);
    for (const double turns : {-2.0, 0.0, 3.0}) {
      const double bearing = direction * (-kPi + 30.3 * kDegree) + turns * kTurn;
      EXPECT_EQ(fan.indexAt(bearing, 360), 30U);
      EXPECT_NEAR(fan.positionAt(bearing), 30.3, 1e-9);
    }
  }
}

TEST(BeamFan, AFullTurnHasNoSeam) {
  const BeamFan fan(0.0, kDegree);
  EXPECT_EQ(fan.indexAt(359.4 * kDegree, 360), 359U);
  EXPECT_EQ(fan.indexAt(359.6 * kDegree, 360), 0U);
  EXPECT_NEAR(fan.positionAt(359.7 * kDegree), -0.3, 1e-9);
  EXPECT_EQ(fan.nearest(360.2, 360), 0U);
  EXPECT_EQ(fan.nearest(-1.0, 360), 359U);
}

TEST(BeamFan, NaNIsCoveredByNone) {
  const BeamFan fan(0.0, kDegree);
  EXPECT_EQ(fan.indexAt(std::numeric_limits<double>::quiet_NaN(), 360), std::nullopt);
  EXPECT_EQ(fan.nearest(std::numeric_limits<double>::quiet_NaN(), 360), std::nullopt);
}

}  // namespace
}  // namespace datmo::beam_fan_test
