// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/gradual_correction.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::gradual_correction_test {
namespace {

TEST(GradualCorrectionTest, TheVehicleIsMovedAndTurnedNoFasterThanAllowed) {
  const GradualCorrectionOptions options;
  GradualCorrection correction(options);
  const Pose2 target(3.0, -2.0, degrees(10.0));
  const Pose2 vehicle(300.0, 200.0, 1.0);  // 63 m between target and start there
  Pose2 before = correction.advance(Stamp::fromSeconds(1000.0), vehicle, target) * vehicle;
  EXPECT_NEAR((before.position() - vehicle.position()).norm(), 0.0, 1e-9) << "no time has passed";
  for (int i = 1; i <= 50; ++i) {
    const Pose2 now =
        correction.advance(Stamp::fromSeconds(1000.0 + 0.1 * i), vehicle, target) * vehicle;
    EXPECT_LE((now.position() - before.position()).norm(), 0.1 * options.speed + 1e-9);
    EXPECT_LE(std::abs(angleBetween(before.heading(), now.heading())),
              0.1 * options.turn_rate + 1e-9);
    before = now;
  }
  Pose2 end;
  for (int i = 1; i <= 150; ++i) {
    end = correction.advance(Stamp::fromSeconds(1005.0 + i), vehicle, target);
  }
  EXPECT_NEAR((end.position() - target.position()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(end.heading(), target.heading(), 1e-9);
}

TEST(GradualCorrectionTest, AfterAGapNothingJumps) {
  const GradualCorrectionOptions options;
  GradualCorrection correction(options);
  const Pose2 target(50.0, 0.0, 0.0);
  correction.advance(Stamp::fromSeconds(1000.0), Pose2(), target);
  const Pose2 after = correction.advance(Stamp::fromSeconds(1060.0), Pose2(), target);
  EXPECT_NEAR(after.x(), options.speed, 1e-9) << "as in a second";
}

TEST(GradualCorrectionTest, AClockThatStopsOrJumpsBackMovesNothing) {
  GradualCorrection correction{GradualCorrectionOptions()};
  correction.advance(Stamp::fromSeconds(1000.0), Pose2(), Pose2(1.0, 0.0, 0.0));
  EXPECT_EQ(correction.advance(Stamp::fromSeconds(999.0), Pose2(), Pose2(1.0, 0.0, 0.0)).x(), 0.0);
}

}  // namespace
}  // namespace datmo::gradual_correction_test
