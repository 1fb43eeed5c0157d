// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/hota.h"

#include <cmath>

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::hota_test {
namespace {

HotaScores score(const Frames& frames) {
  const MatchOptions options;
  return scoreHota(scoredRun(frames, matchFrames(frames, options)), options.gate);
}

TEST(Hota, PerfectRun) {
  const HotaScores result =
      score(FrameMaker()
                .add({truthAt(1, 0.0), truthAt(2, 1.0)}, {trackAt(8, 0.0), trackAt(9, 1.0)})
                .add({truthAt(1, 0.0), truthAt(2, 1.0)}, {trackAt(9, 1.0), trackAt(8, 0.0)})
                .frames());
  EXPECT_DOUBLE_EQ(result.hota.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.deta.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.assa.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.loca.value(), 1.0);
  ASSERT_EQ(result.alphas.size(), 19U);
  EXPECT_DOUBLE_EQ(result.alphas.front(), 0.05);
  EXPECT_DOUBLE_EQ(result.alphas.back(), 0.95);
  EXPECT_EQ(result.hota_alpha, std::vector<double>(19, 1.0));
}

TEST(Hota, NothingIsDefinedWithoutObjectsAndTracks) {
  const HotaScores result = score(FrameMaker().add({}, {}).frames());
  EXPECT_FALSE(result.hota || result.deta || result.assa || result.loca);
  EXPECT_TRUE(result.hota_alpha.empty());
}

TEST(Hota, AllMissedOrAllFalse) {
  for (const Frames& frames :
       {followedBy({0, 0}), FrameMaker().add({}, {trackAt(1, 0.0)}).frames()}) {
    const HotaScores result = score(frames);
    EXPECT_DOUBLE_EQ(result.hota.value(), 0.0);
    EXPECT_DOUBLE_EQ(result.deta.value(), 0.0);
    EXPECT_DOUBLE_EQ(result.assa.value(), 0.0);
    EXPECT_FALSE(result.loca);
  }
}

TEST(Hota, AnIdSwitchHalvesTheAssociation) {
  // TPA 2, FNA 2, FPA 0 of each match.
  const HotaScores result = score(followedBy({1, 1, 2, 2}));
  EXPECT_DOUBLE_EQ(result.deta.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.assa.value(), 0.5);
  EXPECT_DOUBLE_EQ(result.hota.value(), std::sqrt(0.5));
}

TEST(Hota, ATrackOfTwoObjectsIsPunishedForBoth) {
  // Object 1 in three frames, object 2 in one, track 1 on both in turn: TPA 3 of 4 three times,
  // TPA 1 of 4 once.
  FrameMaker maker;
  for (int i = 0; i < 3; ++i) {
    maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.0)});
  }
  maker.add({truthAt(2, 0.0)}, {trackAt(1, 0.0)});
  EXPECT_DOUBLE_EQ(score(maker.frames()).assa.value(), (3.0 * 0.75 + 0.25) / 4.0);
}

TEST(Hota, DetectionAndAssociationAreBalanced) {
  // TP 2, FN 2, FP 1; TPA 2, FNA 2.
  FrameMaker maker;
  maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.0)});
  maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.0), trackAt(2, 9.0)});
  maker.add({truthAt(1, 0.0)}, {});
  maker.add({truthAt(1, 0.0)}, {});
  const HotaScores result = score(maker.frames());
  EXPECT_DOUBLE_EQ(result.deta.value(), 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(result.assa.value(), 0.5);
  EXPECT_NEAR(result.hota.value(), std::sqrt(0.2), 1e-12);
}

TEST(Hota, ATrackAtHalfTheGateCountsUpToAlphaOfAHalf) {
  const HotaScores result = score(FrameMaker().add({truthAt(1, 0.0)}, {trackAt(1, 1.0)}).frames());
  EXPECT_NEAR(result.hota.value(), 10.0 / 19.0, 1e-12);
  EXPECT_NEAR(result.deta.value(), 10.0 / 19.0, 1e-12);
  EXPECT_DOUBLE_EQ(result.loca.value(), 0.5);
  EXPECT_DOUBLE_EQ(result.hota_alpha[9], 1.0) << "alpha 0.5";
  EXPECT_DOUBLE_EQ(result.hota_alpha[10], 0.0) << "alpha 0.55";
}

TEST(Hota, TheLongAssociationIsPreferredToTheNearTrack) {
  // Track 1 follows at 0.5 m (similarity 0.75), track 2 is there once, exactly. Up to alpha 0.75
  // (15 of 19) track 1 is matched: TP 4, FP 1, A 1. Above, track 2 alone: TP 1, FN 3, FP 4, A 1/4.
  FrameMaker maker;
  for (int i = 0; i < 3; ++i) {
    maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.5)});
  }
  maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.5), trackAt(2, 0.0)});
  const HotaScores result = score(maker.frames());
  EXPECT_NEAR(result.hota.value(), (15.0 * std::sqrt(0.8) + 4.0 * std::sqrt(1.0 / 32.0)) / 19.0,
              1e-12);
}

TEST(Hota, MoreMatchesArePreferredToTheLongAssociation) {
  // Track 1 is of object 1; in the last frame only track 1 is within the gate of object 2, while
  // object 1 has track 2 as well. All four detections are matched.
  FrameMaker maker;
  maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.0)});
  maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.0)});
  maker.add({truthAt(1, 0.0), truthAt(2, 1.6)}, {trackAt(1, 0.0), trackAt(2, -1.6)});
  const HotaScores result = score(maker.frames());
  // At alpha 0.05 to 0.2: object 1 - track 1 with A 2/4 twice, and two pairs with A 1/3.
  EXPECT_NEAR(result.hota_alpha[0], std::sqrt((2.0 * 2.0 / 4.0 + 1.0 / 3.0 + 1.0 / 3.0) / 4.0),
              1e-12);
}

TEST(Hota, NeutralTracksAreLeftOut) {
  EXPECT_DOUBLE_EQ(
      score(FrameMaker()
                .add({truthAt(1, 0.0), optionalAt(2, 9.0)}, {trackAt(1, 0.0), trackAt(2, 9.0)})
                .add({optionalAt(1, 0.0)}, {trackAt(1, 0.0)})
                .frames())
          .hota.value(),
      1.0);
}

}  // namespace
}  // namespace datmo::evaluation::hota_test
