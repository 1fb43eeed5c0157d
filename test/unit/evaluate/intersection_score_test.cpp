// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/intersection_score.h"

#include <utility>

#include <gtest/gtest.h>

namespace datmo::evaluation::intersection_score_test {
namespace {

constexpr double kMergeGap = 1.0;  // s

/// A state every 0.5 s for 30 s, true within the intervals (first and last second).
std::vector<RecordedIntersection> statesOf(
    const std::vector<std::pair<double, double>>& stretches) {
  std::vector<RecordedIntersection> states;
  for (int i = 0; i <= 60; ++i) {
    const double seconds = 0.5 * i;
    bool at_intersection = false;
    for (const auto& [first, last] : stretches) {
      at_intersection = at_intersection || (first <= seconds && seconds <= last);
    }
    states.push_back({Stamp::fromSeconds(seconds), at_intersection});
  }
  return states;
}

TEST(ScoreIntersections, FoundMissedAndFalse) {
  const auto score = scoreIntersections(statesOf({{2, 5}, {20, 24}}),
                                        statesOf({{4, 6}, {10, 11}, {14, 15}}), kMergeGap);
  EXPECT_EQ(score.intersections, 2U);
  EXPECT_EQ(score.found, 1U);
  EXPECT_EQ(score.wrong, 2U);
}

TEST(ScoreIntersections, OneLongReportOfTwoFindsBoth) {
  const auto score = scoreIntersections(statesOf({{2, 5}, {8, 9}}), statesOf({{1, 20}}), kMergeGap);
  EXPECT_EQ(score.found, 2U);
  EXPECT_EQ(score.wrong, 0U);
}

TEST(ScoreIntersections, AFlickerIsOne) {
  const auto score =
      scoreIntersections(statesOf({{2, 4}}), statesOf({{10, 11}, {12, 13}, {15, 16}}), kMergeGap);
  EXPECT_EQ(score.wrong, 2U);  // 10 s to 13 s, and 15 s to 16 s
}

TEST(ScoreIntersections, ARunWithoutDetectionHasNoCounts) {
  const auto score = scoreIntersections(statesOf({{2, 4}}), std::nullopt, kMergeGap);
  EXPECT_EQ(score.intersections, 1U);
  EXPECT_FALSE(score.found);
  EXPECT_FALSE(score.wrong);
}

TEST(ScoreIntersections, NoneAtAll) {
  const auto score = scoreIntersections(statesOf({}), statesOf({}), kMergeGap);
  EXPECT_EQ(score.intersections, 0U);
  EXPECT_EQ(score.found, 0U);
  EXPECT_EQ(score.wrong, 0U);
}

}  // namespace
}  // namespace datmo::evaluation::intersection_score_test
