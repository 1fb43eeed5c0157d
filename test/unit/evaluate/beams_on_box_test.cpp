// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/beams_on_box.h"

#include <cmath>
#include <vector>

#include "scan_samples.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::beams_on_box_test {
namespace {

using samples::scanWithRays;

constexpr double kTolerance = 0.1;  // m

Ray rayTo(double bearing, double range, bool hit = true) {
  Ray ray;
  ray.range = range;
  ray.end = range * Point2(std::cos(bearing), std::sin(bearing));
  ray.bearing = bearing;
  ray.hit = hit;
  return ray;
}

/// 2 m across the line of sight, the near side at 10 m.
Box2 boxAhead() { return {Pose2(11.0, 0.0, 0.0), 2.0, 2.0}; }

TEST(BeamsOnBox, ABeamThatEndsOnTheNearSide) {
  const BoxObservation seen = observeBox(scanWithRays({rayTo(0.0, 10.05)}), boxAhead(), kTolerance);
  ASSERT_EQ(seen.beams.size(), 1U);
  EXPECT_TRUE(seen.beams[0].direction.isApprox(Point2(1.0, 0.0)));
  EXPECT_TRUE(seen.beams[0].normal.isApprox(Point2(-1.0, 0.0)));
}

TEST(BeamsOnBox, TheSideOfATurnedBox) {
  Box2 box = boxAhead();
  box.center = Pose2(11.0, 0.0, kPi / 2.0);
  const BoxObservation seen = observeBox(scanWithRays({rayTo(0.0, 10.0)}), box, kTolerance);
  ASSERT_EQ(seen.beams.size(), 1U);
  EXPECT_TRUE(seen.beams[0].normal.isApprox(Point2(-1.0, 0.0)));
}

TEST(BeamsOnBox, BeamsInFrontBehindAndBesideBelongToOthers) {
  const std::vector<Ray> rays = {rayTo(0.0, 9.8), rayTo(0.0, 12.2), rayTo(0.3, 10.0),
                                 rayTo(0.0, 40.0, false), rayTo(kPi, 10.0)};
  for (const Ray& ray : rays) {
    const BoxObservation seen = observeBox(scanWithRays({ray}), boxAhead(), kTolerance);
    EXPECT_TRUE(seen.beams.empty());
    EXPECT_FALSE(seen.lateral);
  }
}

TEST(BeamsOnBox, BeamsOnAndBesideLimitHowFarItSlides) {
  // Ends at +-0.09967 rad (atan 1/10). Beams every 0.08 rad: at -0.08, 0, 0.08 on it, at +-0.16
  // beside it. It turns by 0.08 - 0.09967 = -0.01967 before it leaves the last, and as far to the
  // other side; 11 m away.
  std::vector<Ray> rays;
  for (int i = -2; i <= 2; ++i) {
    rays.push_back(std::abs(i) == 2 ? rayTo(0.08 * i, 40.0, false)
                                    : rayTo(0.08 * i, 10.0 / std::cos(0.08 * i)));
  }
  const BoxObservation seen = observeBox(scanWithRays(rays), boxAhead(), kTolerance);
  EXPECT_EQ(seen.beams.size(), 3U);
  ASSERT_TRUE(seen.lateral);
  EXPECT_NEAR(seen.lateral->width, 11.0 * 2.0 * (std::atan(0.1) - 0.08), 1e-9);
  EXPECT_NEAR(std::abs(seen.lateral->axis.y()), 1.0, 1e-12);
}

TEST(BeamsOnBox, ABeamPastAnObstacleLimitsNothing) {
  // One beam on the box, at its middle: it may turn by its half width to either side, but the
  // neighbors at +-0.12 rad leave 0.12 - 0.09967 only; the left one ends before the box.
  const Ray beside = rayTo(-0.12, 40.0, false);
  const Ray middle = rayTo(0.0, 10.0);
  const double end = std::atan(0.1);
  const BoxObservation free =
      observeBox(scanWithRays({beside, middle, rayTo(0.12, 40.0, false)}), boxAhead(), kTolerance);
  ASSERT_TRUE(free.lateral);
  EXPECT_NEAR(free.lateral->width, 11.0 * 2.0 * (0.12 - end), 1e-9);
  const BoxObservation hidden =
      observeBox(scanWithRays({beside, middle, rayTo(0.12, 5.0)}), boxAhead(), kTolerance);
  ASSERT_TRUE(hidden.lateral);
  EXPECT_NEAR(hidden.lateral->width, 11.0 * (0.12 - end + end), 1e-9);
}

TEST(BeamsOnBox, TheScannerInTheBoxSeesNothingOfIt) {
  const Box2 box{Pose2(), 4.0, 2.0};
  EXPECT_TRUE(observeBox(scanWithRays({rayTo(0.0, 2.0)}), box, kTolerance).beams.empty());
}

}  // namespace
}  // namespace datmo::evaluation::beams_on_box_test
