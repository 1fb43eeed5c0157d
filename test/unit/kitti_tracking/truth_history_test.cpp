// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/truth_history.h"

#include <gtest/gtest.h>

namespace datmo::kitti::truth_history_test {
namespace {

using Coverage = TruthSummary::Coverage;

constexpr int kNone = kUnassigned;

/// A trajectory that must be found in each frame, matched to these tracks.
TruthSummary summaryOf(const std::vector<int>& tracks) {
  std::vector<TruthRecord> records;
  for (const int track : tracks) {
    records.push_back({track, true});
  }
  return summarize(records);
}

void expectCounts(const TruthSummary& summary, std::size_t id_switches,
                  std::size_t fragmentations) {
  EXPECT_EQ(summary.id_switches, id_switches);
  EXPECT_EQ(summary.fragmentations, fragmentations);
}

TEST(TruthHistory, OneTrackForTheWholeDrive) {
  expectCounts(summaryOf({5, 5, 5, 5}), 0, 0);
  EXPECT_EQ(summaryOf({5, 5, 5, 5}).coverage, Coverage::kMostly);
}

TEST(TruthHistory, AnotherTrackAtOnceIsBoth) { expectCounts(summaryOf({5, 5, 6, 6}), 1, 1); }

TEST(TruthHistory, TheSameTrackAfterAGapIsAFragmentation) {
  expectCounts(summaryOf({5, 5, kNone, 5, 5}), 0, 1);
}

TEST(TruthHistory, AnotherTrackAfterAGapIsNoSwitch) {
  expectCounts(summaryOf({5, 5, kNone, 6, 6}), 0, 1);
}

TEST(TruthHistory, ForthAndBackIsTwoSwitches) { expectCounts(summaryOf({5, 5, 6, 5, 5}), 2, 2); }

TEST(TruthHistory, AMatchOfOneFrameIsNoFragmentation) {
  expectCounts(summaryOf({5, 5, kNone, 5, kNone, kNone}), 0, 0);
}

TEST(TruthHistory, ALateBeginningIsNoFragmentation) {
  expectCounts(summaryOf({kNone, kNone, 5, 5}), 0, 0);
}

TEST(TruthHistory, ABeginningInTheLastFrameIsOne) {
  expectCounts(summaryOf({kNone, kNone, 5}), 0, 1);
}

TEST(TruthHistory, AnotherTrackWhileOptionalIsNeither) {
  expectCounts(summarize({{5, true}, {5, true}, {5, false}, {6, true}, {6, true}}), 0, 0);
}

TEST(TruthHistory, ObjectsNeverRequiredAreLeftOut) {
  EXPECT_EQ(summarize({{5, false}, {kNone, false}}).coverage, Coverage::kNotRequired);
  EXPECT_EQ(summarize({}).coverage, Coverage::kNotRequired);
}

TEST(TruthHistory, FourFifthsIsPartly) {
  EXPECT_EQ(summaryOf({5, 5, 5, 5, kNone}).coverage, Coverage::kPartly);
}

TEST(TruthHistory, AFifthIsPartlyAndLessIsMostlyLost) {
  EXPECT_EQ(summaryOf({kNone, 5, kNone, kNone, kNone}).coverage, Coverage::kPartly);
  EXPECT_EQ(summaryOf({kNone, 5, kNone, kNone, kNone, kNone}).coverage, Coverage::kMostlyLost);
  EXPECT_EQ(summaryOf({kNone, kNone}).coverage, Coverage::kMostlyLost);
}

}  // namespace
}  // namespace datmo::kitti::truth_history_test
