// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/scan_merger.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::scan_merger_test {
namespace {

/// 62 beams, 0.10134 rad apart; beam 31 faces ahead, beam 0 backward.
constexpr std::size_t kBeams = 62;
constexpr std::size_t kAhead = 31;
constexpr double kSpacing = kTurn / static_cast<double>(kBeams);

ScanMergerOptions options(double surface_gap = 0.5) {
  ScanMergerOptions merger;
  merger.beam_spacing = 0.1;
  merger.surface_gap = surface_gap;
  return merger;
}

Ray ray(std::uint32_t beam, const Point2& end, bool hit = true) {
  Ray one;
  one.beam = beam;
  one.end = end;
  one.hit = hit;
  return one;
}

Scan scan(std::vector<Ray> rays) {
  Scan one;
  one.rays = std::move(rays);
  return one;
}

std::vector<float> merged(const std::vector<Scan>& scans,
                          const ScanMergerOptions& with = options()) {
  return ScanMerger(with).ranges(scans);
}

TEST(ScanMerger, RangesCountFromTheVehiclesOrigin) {
  const auto ranges = merged({scan({ray(0, {10.0, 0.0})}), scan({ray(0, {-6.0, 0.0})})});
  ASSERT_EQ(ranges.size(), kBeams);
  EXPECT_FLOAT_EQ(ranges[kAhead], 10.0F);
  EXPECT_FLOAT_EQ(ranges[0], 6.0F);
  EXPECT_TRUE(std::isnan(ranges[kAhead + 1])) << "nobody has measured there";
  EXPECT_DOUBLE_EQ(ScanMerger(options()).beamSpacing(), kSpacing);
}

TEST(ScanMerger, OfSeveralEndPointsTheNearestCounts) {
  const auto ranges = merged({scan({ray(0, {10.0, 0.0})}), scan({ray(0, {8.0, 0.0})}),
                              scan({ray(0, {40.0, 0.0}, false)})});
  EXPECT_FLOAT_EQ(ranges[kAhead], 8.0F);
}

TEST(ScanMerger, ABeamWithoutReturnIsFreeAndOneFartherThanTheMergedScanTooIs) {
  EXPECT_TRUE(std::isinf(merged({scan({ray(0, {40.0, 0.0}, false)})})[kAhead]));
  EXPECT_TRUE(std::isinf(merged({scan({ray(0, {90.0, 0.0})})})[kAhead]));
}

TEST(ScanMerger, ASurfaceBetweenTwoBeamsIsSeenByAllBetweenThem) {
  const Scan wall = scan({ray(0, {5.0, -2.0}), ray(1, {5.0, 2.0})});
  const auto ranges = merged({wall}, options(5.0));
  for (const int off : {-2, -1, 0, 1, 2}) {
    EXPECT_NEAR(ranges[kAhead + static_cast<std::size_t>(off)], 5.0 / std::cos(off * kSpacing),
                1e-5);
  }
  EXPECT_TRUE(std::isnan(merged({wall})[kAhead])) << "4 m apart: two surfaces";
}

TEST(ScanMerger, ASurfaceBehindCrossesTheSeam) {
  const auto ranges = merged({scan({ray(0, {-5.0, 1.0}), ray(1, {-5.0, -1.0})})}, options(5.0));
  EXPECT_FLOAT_EQ(ranges[0], 5.0F);
  EXPECT_NEAR(ranges[1], 5.0 / std::cos(kSpacing), 1e-5);
  EXPECT_NEAR(ranges[kBeams - 1], 5.0 / std::cos(kSpacing), 1e-5);
}

TEST(ScanMerger, TheLastBeamOfAFullTurnIsBesideTheFirst) {
  Scan around = scan({ray(0, {-5.0, -1.0}), ray(3, {-5.0, 1.0})});
  around.field.beams = 4;
  around.field.beam_spacing = kTurn / 4.0;
  EXPECT_FLOAT_EQ(merged({around}, options(5.0))[0], 5.0F);
  around.field.beam_spacing = kTurn / 8.0;
  EXPECT_TRUE(std::isnan(merged({around}, options(5.0))[0])) << "half a turn";
}

TEST(ScanMerger, BetweenBeamsWithoutReturnItIsFreeBesideAHitItIsNotMeasured) {
  const Ray right = ray(0, {40.0, -12.0}, false);
  EXPECT_TRUE(std::isinf(merged({scan({right, ray(1, {40.0, 12.0}, false)})})[kAhead]));
  EXPECT_TRUE(std::isnan(merged({scan({right, ray(1, {5.0, 1.5})})})[kAhead]));
  EXPECT_TRUE(std::isnan(merged({scan({right, ray(2, {40.0, 12.0}, false)})})[kAhead]))
      << "the beam between them is blind";
}

TEST(ScanMerger, BeamsInSectorsAreLeftOut) {
  Scan all;
  for (const double bearing : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
    all.rays.push_back(ray(0, {1.0, 0.0}));
    all.rays.back().bearing = bearing;
  }
  EXPECT_EQ(withoutSectors(all, {}).rays.size(), 5U);
  EXPECT_EQ(withoutSectors(all, {-0.5, 1.0}).rays.size(), 3U);
  const Scan ahead = withoutSectors(all, {2.0, -2.0});
  ASSERT_EQ(ahead.rays.size(), 3U) << "the sector behind lies across the seam";
  EXPECT_EQ(ahead.rays.front().bearing, -1.0);
}

TEST(ScanMerger, OptionsOutOfRangeAreRefused) {
  ScanMergerOptions wrong;
  wrong.beam_spacing = 0.0;
  EXPECT_THROW(ScanMerger{wrong}, OptionError);
}

}  // namespace
}  // namespace datmo::scan_merger_test
