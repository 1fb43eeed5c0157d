// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/clear_mot.h"

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::clear_mot_test {
namespace {

ClearMot score(const Frames& frames) {
  return scoreClearMot(frames, matchFrames(frames, MatchOptions()), MatchOptions());
}

TEST(ClearMot, PerfectRun) {
  const ClearMot result = score(followedBy({1, 1, 1}));
  EXPECT_EQ(result.required, 3U);
  EXPECT_EQ(result.matches, 3U);
  EXPECT_EQ(result.misses + result.false_positives, 0U);
  EXPECT_EQ(result.switches.size() + result.fragmentations, 0U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.motp.value(), 0.0);
  EXPECT_DOUBLE_EQ(result.mostly_tracked.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.mostly_lost.value(), 0.0);
}

TEST(ClearMot, NothingIsDefinedWithoutFrames) {
  const ClearMot result = score({});
  EXPECT_FALSE(result.mota || result.motp || result.mostly_tracked || result.mostly_lost);
}

TEST(ClearMot, FalseTracksAloneAreCounted) {
  const ClearMot result = score(FrameMaker().add({}, {trackAt(1, 0.0), trackAt(2, 9.0)}).frames());
  EXPECT_EQ(result.false_positives, 2U);
  EXPECT_FALSE(result.mota);
}

TEST(ClearMot, AllMissed) {
  const ClearMot result = score(followedBy({0, 0}));
  EXPECT_EQ(result.misses, 2U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 0.0);
  EXPECT_FALSE(result.motp);
  EXPECT_DOUBLE_EQ(result.mostly_lost.value(), 1.0);
}

TEST(ClearMot, AnIdSwitch) {
  // 1 - 1 / 4.
  const ClearMot result = score(followedBy({1, 1, 2, 2}));
  EXPECT_EQ(result.switches.size(), 1U);
  EXPECT_EQ(result.fragmentations, 0U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 0.75);
}

TEST(ClearMot, AFragmentation) {
  // 1 - 1 miss / 4.
  const ClearMot result = score(followedBy({1, 0, 1, 1}));
  EXPECT_EQ(result.fragmentations, 1U);
  EXPECT_EQ(result.switches.size(), 0U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 0.75);
}

TEST(ClearMot, AGapAndAnotherIdIsBoth) {
  const ClearMot result = score(followedBy({1, 0, 0, 2}));
  EXPECT_EQ(result.fragmentations, 1U);
  EXPECT_EQ(result.switches.size(), 1U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 1.0 - 3.0 / 4.0);
}

TEST(ClearMot, LateBeginningAndEarlyEndAreNoFragmentation) {
  const ClearMot result = score(followedBy({0, 1, 1, 0}));
  EXPECT_EQ(result.misses, 2U);
  EXPECT_EQ(result.fragmentations, 0U);
}

TEST(ClearMot, TwoTracksThatSwapPositions) {
  // Each object gets another track: 1 - 2 / 4.
  const ClearMot result =
      score(FrameMaker()
                .add({truthAt(1, 0.0), truthAt(2, 9.0)}, {trackAt(1, 0.0), trackAt(2, 9.0)})
                .add({truthAt(1, 0.0), truthAt(2, 9.0)}, {trackAt(1, 9.0), trackAt(2, 0.0)})
                .frames());
  EXPECT_EQ(result.switches.size(), 2U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 0.5);
}

TEST(ClearMot, ANearerTrackBesideTheKeptOneIsFalseAndNoSwitch) {
  const ClearMot result = score(FrameMaker()
                                    .add({truthAt(1, 0.0)}, {trackAt(1, 0.0)})
                                    .add({truthAt(1, 0.0)}, {trackAt(1, 1.0), trackAt(2, 0.1)})
                                    .frames());
  EXPECT_EQ(result.switches.size(), 0U);
  EXPECT_EQ(result.false_positives, 1U);
  EXPECT_DOUBLE_EQ(result.mota.value(), 0.5);
}

TEST(ClearMot, MoreFalseTracksThanObjectsMakeItNegative) {
  const ClearMot result =
      score(FrameMaker().add({truthAt(1, 0.0)}, {trackAt(1, 9.0), trackAt(2, 20.0)}).frames());
  EXPECT_DOUBLE_EQ(result.mota.value(), 1.0 - (1.0 + 2.0) / 1.0);
}

TEST(ClearMot, PrecisionIsTheMeanDistance) {
  const ClearMot result = score(FrameMaker()
                                    .add({truthAt(1, 0.0)}, {trackAt(1, 0.5)})
                                    .add({truthAt(1, 0.0)}, {trackAt(1, 0.0, -1.5)})
                                    .add({truthAt(1, 0.0)}, {})
                                    .frames());
  EXPECT_DOUBLE_EQ(result.motp.value(), 1.0);
}

TEST(ClearMot, SharesIncludeAndExcludeTheirBounds) {
  // 4 of 5 is mostly tracked; 1 of 5 is not mostly lost.
  EXPECT_DOUBLE_EQ(score(followedBy({0, 1, 1, 1, 1})).mostly_tracked.value(), 1.0);
  EXPECT_DOUBLE_EQ(score(followedBy({0, 0, 1, 1, 1})).mostly_tracked.value(), 0.0);
  EXPECT_DOUBLE_EQ(score(followedBy({0, 0, 0, 0, 1})).mostly_lost.value(), 0.0);
  EXPECT_DOUBLE_EQ(score(followedBy({0, 0, 0, 0, 0, 1})).mostly_lost.value(), 1.0);
}

TEST(ClearMot, FramesNotRequiredAreNoPartOfAnObjectsLife) {
  const ClearMot result = score(FrameMaker()
                                    .add({truthAt(1, 0.0)}, {trackAt(1, 0.0)})
                                    .add({optionalAt(1, 0.0)}, {})
                                    .add({optionalAt(1, 0.0)}, {trackAt(2, 0.0)})
                                    .add({truthAt(1, 0.0)}, {trackAt(2, 0.0)})
                                    .frames());
  EXPECT_EQ(result.required, 2U);
  EXPECT_EQ(result.misses, 0U);
  EXPECT_EQ(result.false_positives, 0U);
  EXPECT_EQ(result.fragmentations, 0U);
  EXPECT_EQ(result.switches.size(), 1U);
}

}  // namespace
}  // namespace datmo::evaluation::clear_mot_test
