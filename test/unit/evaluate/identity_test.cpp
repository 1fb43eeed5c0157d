// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/identity.h"

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::identity_test {
namespace {

IdentityScores score(const Frames& frames) {
  return scoreIdentity(scoredRun(frames, matchFrames(frames, MatchOptions())));
}

TEST(Identity, PerfectRun) {
  const IdentityScores result = score(followedBy({1, 1, 1}));
  EXPECT_DOUBLE_EQ(result.idf1.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.idp.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.idr.value(), 1.0);
}

TEST(Identity, NothingIsDefinedWithoutObjectsAndTracks) {
  const IdentityScores result = score(FrameMaker().add({}, {}).frames());
  EXPECT_FALSE(result.idf1 || result.idp || result.idr);
}

TEST(Identity, AllMissed) {
  const IdentityScores result = score(followedBy({0, 0}));
  EXPECT_DOUBLE_EQ(result.idf1.value(), 0.0);
  EXPECT_FALSE(result.idp);
  EXPECT_DOUBLE_EQ(result.idr.value(), 0.0);
}

TEST(Identity, OnlyFalseTracks) {
  const IdentityScores result = score(FrameMaker().add({}, {trackAt(1, 0.0)}).frames());
  EXPECT_DOUBLE_EQ(result.idf1.value(), 0.0);
  EXPECT_DOUBLE_EQ(result.idp.value(), 0.0);
  EXPECT_FALSE(result.idr);
}

TEST(Identity, OnlyTheLongerOfTwoTracksIsTheObject) {
  // IDTP 3 of 5 true and 5 published: 2 * 3 / (5 + 5).
  EXPECT_DOUBLE_EQ(score(followedBy({1, 1, 1, 2, 2})).idf1.value(), 0.6);
}

TEST(Identity, SwitchingBackAndForthCostsNoMoreThanOnce) {
  EXPECT_DOUBLE_EQ(score(followedBy({1, 2, 1, 2, 1})).idf1.value(), 0.6);
}

TEST(Identity, MissesLowerTheRecallAlone) {
  // IDTP 2 of 4 true and 2 published.
  const IdentityScores result = score(followedBy({0, 1, 1, 0}));
  EXPECT_DOUBLE_EQ(result.idp.value(), 1.0);
  EXPECT_DOUBLE_EQ(result.idr.value(), 0.5);
  EXPECT_DOUBLE_EQ(result.idf1.value(), 2.0 * 2.0 / (4.0 + 2.0));
}

TEST(Identity, TheWholeAssignmentIsBest) {
  // Object 1 is followed by track 1 three times and by track 2 twice, object 2 by track 1 twice:
  // 2 + 2 beats 3 + 0. True: 5 + 2, published: 5 + 2.
  FrameMaker maker;
  for (int i = 0; i < 3; ++i) {
    maker.add({truthAt(1, 0.0)}, {trackAt(1, 0.0)});
  }
  for (int i = 0; i < 2; ++i) {
    maker.add({truthAt(1, 0.0), truthAt(2, 9.0)}, {trackAt(2, 0.0), trackAt(1, 9.0)});
  }
  EXPECT_DOUBLE_EQ(score(maker.frames()).idf1.value(), 2.0 * 4.0 / (7.0 + 7.0));
}

TEST(Identity, NeutralTracksAreLeftOut) {
  const IdentityScores result =
      score(FrameMaker()
                .add({truthAt(1, 0.0), optionalAt(2, 9.0)}, {trackAt(1, 0.0), trackAt(2, 9.0)})
                .add({optionalAt(1, 0.0)}, {trackAt(1, 0.0)})
                .frames());
  EXPECT_DOUBLE_EQ(result.idf1.value(), 1.0);
}

}  // namespace
}  // namespace datmo::evaluation::identity_test
