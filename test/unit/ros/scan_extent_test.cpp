// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/scan_extent.h"

#include "grid/small_map.h"
#include <gtest/gtest.h>

namespace datmo::scan_extent_test {
namespace {

/// Ten beams that end this far ahead.
Scan scanWithReach(double range, double reach) {
  Scan scan = samples::scanTo(std::vector<Point2>(10, {range, 0.0}));
  scan.field.range = reach;
  return scan;
}

/// Returns the warnings after a hundred such scans.
std::vector<InputError> warningsOf(const Scan& scan, double length, double width) {
  GridWindowOptions window;
  window.length = length;
  window.width = width;
  ScanExtent extent(window);
  std::vector<InputError> warnings;
  for (int i = 0; i < 100; ++i) {
    if (const auto error = extent.update(scan)) {
      warnings.push_back(*error);
    }
  }
  return warnings;
}

TEST(ScanExtent, AWindowThatFitsIsFine) {
  EXPECT_TRUE(warningsOf(scanWithReach(49.0, 50.0), 90.0, 108.0).empty());
  EXPECT_TRUE(warningsOf(scanWithReach(8.0, 8.0), 24.0, 24.0).empty());
}

TEST(ScanExtent, EndPointsOutsideOfTheWindowAreReportedOnce) {
  const auto warnings = warningsOf(scanWithReach(30.0, 80.0), 24.0, 24.0);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].reason(), "small_window");
  EXPECT_NE(std::string(warnings[0].what()).find("30.0 m"), std::string::npos)
      << warnings[0].what();
  EXPECT_NE(std::string(warnings[0].what()).find("24.0 m x 24.0 m"), std::string::npos);
}

TEST(ScanExtent, AScannerOfShortReachInALargeWindowIsReported) {
  const auto warnings = warningsOf(scanWithReach(3.0, 8.0), 90.0, 108.0);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].reason(), "large_window");
  EXPECT_NE(std::string(warnings[0].what()).find("8.0 m"), std::string::npos) << warnings[0].what();
}

TEST(ScanExtent, WithoutAnyHitTheReachIsJudgedAlone) {
  Scan scan = scanWithReach(3.0, 50.0);
  scan.rays.clear();
  EXPECT_TRUE(warningsOf(scan, 90.0, 108.0).empty());
}

}  // namespace
}  // namespace datmo::scan_extent_test
