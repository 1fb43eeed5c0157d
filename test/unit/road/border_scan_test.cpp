// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_scan.h"

#include <vector>

#include "scan_history_samples.h"
#include <gtest/gtest.h>

namespace datmo::border_scan_test {
namespace {

std::vector<double> allStanding(const LabeledScan& scan) {
  return std::vector<double>(scan.points.size(), 1.0);
}

TEST(BorderScanTest, HoldsAllBeamsButTheBlindOnes) {
  LabeledScan scan = samples::scanOf({{20.0, 0.0}}, 0.0);
  scan.blind_beams = {0, 80};
  const BorderScan beams = borderScan(scan, HitGrid{HitGridOptions{}}, allStanding(scan), 0.06);
  ASSERT_EQ(beams.beams.size(), 79U);
  EXPECT_TRUE(beams.beams[39].hit);
  EXPECT_NEAR(beams.beams[39].end.x(), 20.0, 1e-9);
  EXPECT_FALSE(beams.beams[40].hit);
  EXPECT_NEAR(beams.beams[40].end.norm(), 40.0, 1e-9) << "as far as it is known free";
}

TEST(BorderScanTest, OfAnUnknownFieldItHoldsTheHits) {
  LabeledScan scan = samples::scanOf({{20.0, 0.0}, {10.0, 3.0}}, 0.0);
  scan.field = {};
  const BorderScan beams = borderScan(scan, HitGrid{HitGridOptions{}}, allStanding(scan), 0.06);
  ASSERT_EQ(beams.beams.size(), 2U);
  EXPECT_TRUE(beams.beams[0].hit);
  EXPECT_TRUE(beams.beams[1].hit);
}

TEST(BorderScanTest, EachHitHasTheProbabilityOfItsPoint) {
  const LabeledScan scan = samples::scanOf({{20.0, 0.0}, {10.0, 3.0}}, 0.0);
  const BorderScan beams = borderScan(scan, HitGrid{HitGridOptions{}}, {0.3, 0.6}, 0.06);
  std::vector<double> of_hits;
  for (const BorderScan::Beam& beam : beams.beams) {
    if (beam.hit) {
      of_hits.push_back(beam.standing_probability);
    } else {
      EXPECT_EQ(beam.standing_probability, 1.0);
    }
  }
  EXPECT_EQ(of_hits, (std::vector<double>{0.3, 0.6}));
}

TEST(BorderScanTest, KnowsWhatLasts) {
  HitGrid hits{HitGridOptions{}};
  const LabeledScan first = samples::scanOf({{20.0, 0.0}}, 0.0);
  hits.update(first);
  EXPECT_FALSE(borderScan(first, hits, allStanding(first), 0.0).beams[40].lasting);
  const LabeledScan second = samples::scanOf({{20.0, 0.0}}, 1.5);
  hits.update(second);
  EXPECT_TRUE(borderScan(second, hits, allStanding(second), 1.5).beams[40].lasting)
      << "hit for more than 1 s";
  EXPECT_EQ(borderScan(second, hits, allStanding(second), 1.5).beams[40].hits_there, 2);
}

}  // namespace
}  // namespace datmo::border_scan_test
