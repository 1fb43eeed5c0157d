// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/sweep_timing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::sweep_timing_test {
namespace {

/// A ring of points, each timed by `timing`.
struct Ring {
  explicit Ring(const SweepTiming& timing) {
    for (int i = 0; i < 3600; ++i) {
      const double bearing = degrees(0.1 * i);
      points.push_back({static_cast<float>(10.0 * std::cos(bearing)),
                        static_cast<float>(10.0 * std::sin(bearing)), 0.0F});
      times.push_back(static_cast<float>(timing.timeAt(bearing)));
    }
  }

  LidarPoints points;
  std::vector<float> times;
};

TEST(SweepTimingTest, ATurnToTheLeftReachesTheBearingsInOrder) {
  const SweepTiming sweep{degrees(90.0), false, 0.1, -0.02};
  EXPECT_NEAR(sweep.timeAt(degrees(90.0)), -0.02, 1e-9);
  EXPECT_NEAR(sweep.timeAt(degrees(180.0)), -0.02 + 0.025, 1e-9);
  EXPECT_NEAR(sweep.timeAt(degrees(0.0)), -0.02 + 0.075, 1e-9);
}

TEST(SweepTimingTest, ATurnToTheRightReachesThemInReverseOrder) {
  const SweepTiming sweep{degrees(90.0), true, 0.1, 0.0};
  EXPECT_NEAR(sweep.timeAt(degrees(0.0)), 0.025, 1e-9);
  EXPECT_NEAR(sweep.timeAt(degrees(180.0)), 0.075, 1e-9);
}

TEST(SweepTimingTest, TheTimesOfPointsGiveTheTurn) {
  for (const bool clockwise : {false, true}) {
    const SweepTiming truth{degrees(123.4), clockwise, 0.1, -0.05};
    const Ring ring(truth);
    const auto found = sweepOf(ring.points, ring.times, {0.0, 0.0});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->clockwise, clockwise);
    EXPECT_NEAR(found->duration, 0.1, 1e-4);
    // A sector of one degree holds both ends of the turn.
    EXPECT_NEAR(normalizeAngle(found->first_bearing - truth.first_bearing), 0.0, degrees(1.0));
    EXPECT_NEAR(found->timeAt(degrees(-10.0)), truth.timeAt(degrees(-10.0)), 1e-4);
  }
}

TEST(SweepTimingTest, PointsOfOneTimeGiveNone) {
  Ring ring(SweepTiming{0.0, false, 0.1, 0.0});
  ring.times.assign(ring.times.size(), 0.01F);
  EXPECT_FALSE(sweepOf(ring.points, ring.times, {0.0, 0.0}));
}

TEST(SweepTimingTest, TimesThatDoNotFollowTheBearingGiveNone) {
  Ring ring(SweepTiming{0.0, false, 0.1, 0.0});
  for (std::size_t i = 0; i < ring.times.size(); ++i) {
    ring.times[i] = static_cast<float>(0.05 + 0.05 * std::sin(0.01 * static_cast<double>(i)));
  }
  EXPECT_FALSE(sweepOf(ring.points, ring.times, {0.0, 0.0}));
}

TEST(SweepTimingTest, NoPointsGiveNone) { EXPECT_FALSE(sweepOf({}, {}, {0.0, 0.0})); }

TEST(SweepTimingTest, TheManualsTurnIsReproduced) {
  SweepOptions options;
  EXPECT_FALSE(options.timing());
  options.duration = 0.1;
  options.first_bearing = kPi;
  options.stamp_share = 0.5;
  const auto sweep = options.timing();
  ASSERT_TRUE(sweep);
  EXPECT_NEAR(sweep->timeAt(0.0), 0.0, 1e-9) << "it looks ahead at the stamp";
}

}  // namespace
}  // namespace datmo::sweep_timing_test
