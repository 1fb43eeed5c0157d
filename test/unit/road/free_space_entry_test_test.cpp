// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/free_space_entry_test.h"

#include <functional>

#include "scan_history_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo {
namespace {

using samples::scanOf;

const Point2 kPosition(15.0, 0.0);

/// Something across the x axis.
ReflectionPoint across(const Point2& position) { return {position, Point2::UnitY()}; }

constexpr double kPeriod = 0.06;  // s

/// 3 s of scans that see something at the place when `seen(seconds before the last scan)`.
double evidenceOf(const std::function<bool(double)>& seen) {
  ScanHistory history{ScanHistoryOptions{}};
  constexpr int kScans = 50;
  for (int i = 0; i < kScans; ++i) {
    const double before = kPeriod * (kScans - 1 - i);
    history.add(
        scanOf(seen(before) ? std::vector<Point2>{kPosition} : std::vector<Point2>{}, kPeriod * i));
  }
  return FreeSpaceEntryTest(FreeSpaceEntryTestOptions{}).evidence(history, {across(kPosition)});
}

TEST(FreeSpaceEntryTestTest, WhatEnteredFreeSpaceHasEntered) {
  EXPECT_GT(evidenceOf([](double before) { return before < 0.5; }), 6.0);
}

TEST(FreeSpaceEntryTestTest, CountsTheScansThatSawThePointFree) {
  // 49 scans without a hit, each with ln(0.97 / 0.7).
  EXPECT_NEAR(evidenceOf([](double before) { return before < 0.01; }), 49 * std::log(0.97 / 0.7),
              1e-9);
}

TEST(FreeSpaceEntryTestTest, WhatWasThereAllTheTimeHasNotCome) {
  EXPECT_LE(evidenceOf([](double /*before*/) { return true; }), 0.0);
}

TEST(FreeSpaceEntryTestTest, WhatIsNewToTheHistoryHasNotCome) {
  ScanHistory history{ScanHistoryOptions{}};
  history.add(scanOf({kPosition}, 0.0));
  EXPECT_DOUBLE_EQ(
      FreeSpaceEntryTest(FreeSpaceEntryTestOptions{}).evidence(history, {across(kPosition)}), 0.0);
}

TEST(FreeSpaceEntryTestTest, APointThatReflectsNowAndThenIsNoMover) {
  int passed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    passed += evidenceOf([&](double before) { return before < 0.01 || random.chance(0.5); }) > 1.0;
  }
  EXPECT_EQ(passed, 0);
}

TEST(FreeSpaceEntryTestTest, AHitOfOldWeighsAgainstManyFreeScans) {
  const double clean = evidenceOf([](double before) { return before < 0.5; });
  const double once = evidenceOf(
      [](double before) { return before < 0.5 || std::abs(before - 2.4) < 0.5 * kPeriod; });
  EXPECT_NEAR(clean - once, std::log(0.97 / 0.7) - std::log(0.03 / 0.3), 1e-9);
}

TEST(FreeSpaceEntryTestTest, WhatStandsLongerThanAMoverWouldIsNone) {
  EXPECT_LT(evidenceOf([](double before) { return before < 2.7; }), 1.0);
}

TEST(FreeSpaceEntryTestTest, TakesTheMeanOverThePoints) {
  ScanHistory history{ScanHistoryOptions{}};
  const Point2 wall(15.0, 6.0);
  for (int i = 0; i < 20; ++i) {
    history.add(scanOf({wall}, kPeriod * i));
  }
  history.add(scanOf({wall, kPosition}, kPeriod * 20));
  const FreeSpaceEntryTest test{FreeSpaceEntryTestOptions{}};
  EXPECT_NEAR(
      test.evidence(history, {across(wall), across(kPosition)}),
      0.5 * (test.evidence(history, {across(wall)}) + test.evidence(history, {across(kPosition)})),
      1e-12);
}

}  // namespace
}  // namespace datmo
