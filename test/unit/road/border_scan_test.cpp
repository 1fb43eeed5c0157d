// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_scan.h"

#include "scan_history_samples.h"
#include <gtest/gtest.h>

namespace datmo::border_scan_test {
namespace {

TEST(BorderScanTest, HoldsAllBeamsButTheBlindOnes) {
  LabeledScan scan = samples::scanOf({{20.0, 0.0}}, 0.0);
  scan.blind_beams = {0, 80};
  const BorderScan beams = borderScan(scan, HitGrid{HitGridOptions{}}, 0.06);
  ASSERT_EQ(beams.beams.size(), 79U);
  EXPECT_TRUE(beams.beams[39].hit);
  EXPECT_NEAR(beams.beams[39].end.x(), 20.0, 1e-9);
  EXPECT_FALSE(beams.beams[40].hit);
  EXPECT_NEAR(beams.beams[40].end.norm(), 40.0, 1e-9) << "as far as it is known free";
}

TEST(BorderScanTest, OfAnUnknownFieldItHoldsTheHits) {
  LabeledScan scan = samples::scanOf({{20.0, 0.0}, {10.0, 3.0}}, 0.0);
  scan.field = {};
  const BorderScan beams = borderScan(scan, HitGrid{HitGridOptions{}}, 0.06);
  ASSERT_EQ(beams.beams.size(), 2U);
  EXPECT_TRUE(beams.beams[0].hit);
  EXPECT_TRUE(beams.beams[1].hit);
}

TEST(BorderScanTest, KnowsPersistentPoints) {
  HitGrid hits{HitGridOptions{}};
  const LabeledScan first = samples::scanOf({{20.0, 0.0}}, 0.0);
  hits.update(first);
  EXPECT_FALSE(borderScan(first, hits, 0.0).beams[40].lasting);
  const LabeledScan second = samples::scanOf({{20.0, 0.0}}, 1.5);
  hits.update(second);
  EXPECT_TRUE(borderScan(second, hits, 1.5).beams[40].lasting) << "hit for more than 1 s";
  EXPECT_EQ(borderScan(second, hits, 1.5).beams[40].hits_there, 2);
}

}  // namespace
}  // namespace datmo::border_scan_test
