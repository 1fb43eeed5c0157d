// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/matching.h"

#include "made_frames.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::evaluation::matching_test {
namespace {

using Tracks = std::vector<int>;
using Verdicts = std::vector<Verdict>;

constexpr int kNone = kUnassigned;

TEST(Matching, OneForEachFrame) {
  EXPECT_TRUE(matchFrames({}, MatchOptions()).empty());
  const Matching matching = matchFrames(FrameMaker().add({}, {}).frames(), MatchOptions());
  ASSERT_EQ(matching.size(), 1U);
  EXPECT_TRUE(matching[0].track_of_truth.empty());
  EXPECT_TRUE(matching[0].verdicts.empty());
}

TEST(Matching, TheGateBelongsToIt) {
  const Matching matching = matchFrames(FrameMaker()
                                            .add({truthAt(1, 0.0)}, {trackAt(1, 2.0)})
                                            .add({truthAt(2, 0.0)}, {trackAt(2, 2.001)})
                                            .frames(),
                                        MatchOptions());
  EXPECT_EQ(matching[0].verdicts, Verdicts{Verdict::kHit});
  EXPECT_EQ(matching[1].verdicts, Verdicts{Verdict::kFalse});
  EXPECT_EQ(matching[1].track_of_truth, Tracks{kNone});
  EXPECT_EQ(matching[1].falseTracks(), 1U);
}

TEST(Matching, DistanceToTheBoxOrItsCenter) {
  TrueState truck = truthAt(1, 10.0, 5.0);
  truck.box = {Pose2(10.0, 5.0, degrees(90.0)), 8.0, 2.0};
  // The truck is parked along y, from 1 to 9.
  const TrackState behind = trackAt(1, 10.0, -0.5);
  const TrackState beside = trackAt(2, 10.5, 8.0);
  const MatchOptions to_box;
  const MatchOptions to_center{2.0, MatchDistance::kToCenter};
  EXPECT_NEAR(matchDistance(truck, behind, to_box), 1.5, 1e-12);
  EXPECT_NEAR(matchDistance(truck, behind, to_center), 5.5, 1e-12);
  EXPECT_EQ(matchDistance(truck, beside, to_box), 0.0);
  EXPECT_NEAR(matchDistance(truck, beside, to_center), std::hypot(0.5, 3.0), 1e-12);
  const Frame frame{Stamp(), {truck}, {behind, beside}};
  EXPECT_EQ(candidatesOf(frame, to_box).size(), 2U);
  EXPECT_TRUE(candidatesOf(frame, to_center).empty());
}

TEST(Matching, AsManyAsPossibleBeforeNearest) {
  // Matching the nearest pair (0.1 m) would leave the first object unmatched.
  const Matching matching =
      matchFrames(FrameMaker()
                      .add({truthAt(1, 0.0), truthAt(2, 2.0)}, {trackAt(1, 1.9), trackAt(2, 3.5)})
                      .frames(),
                  MatchOptions());
  EXPECT_EQ(matching[0].track_of_truth, (Tracks{0, 1}));
}

TEST(Matching, LeastSumOfDistances) {
  // Straight: 1.5 + 1.6; crossed: 0.4 + 0.3.
  const Matching matching =
      matchFrames(FrameMaker()
                      .add({truthAt(1, 0.0), truthAt(2, 1.9)}, {trackAt(1, 1.5), trackAt(2, 0.3)})
                      .frames(),
                  MatchOptions());
  EXPECT_EQ(matching[0].track_of_truth, (Tracks{1, 0}));
}

TEST(Matching, ATieGoesToTheEarlierTrack) {
  const Matching matching =
      matchFrames(FrameMaker().add({truthAt(1, 0.0)}, {trackAt(7, 1.0), trackAt(3, -1.0)}).frames(),
                  MatchOptions());
  EXPECT_EQ(matching[0].verdicts, (Verdicts{Verdict::kHit, Verdict::kFalse}));
}

TEST(Matching, PartnersStayTogetherThoughAnotherIsNearer) {
  const Matching matching =
      matchFrames(FrameMaker()
                      .add({truthAt(1, 0.0)}, {trackAt(1, 0.0)})
                      .add({truthAt(1, 0.0)}, {trackAt(2, 0.1), trackAt(1, 1.9)})
                      .add({truthAt(1, 0.0)}, {trackAt(2, 0.1), trackAt(1, 2.1)})
                      .frames(),
                  MatchOptions());
  EXPECT_EQ(matching[1].track_of_truth, Tracks{1});
  EXPECT_EQ(matching[2].track_of_truth, Tracks{0}) << "beyond the gate they part";
}

TEST(Matching, PartnersFindEachOtherAgainAfterAGap) {
  const Matching matching =
      matchFrames(FrameMaker()
                      .add({truthAt(1, 0.0)}, {trackAt(1, 0.0)})
                      .add({truthAt(1, 0.0)}, {})
                      .add({truthAt(1, 0.0)}, {trackAt(2, 0.1), trackAt(1, 1.5)})
                      .frames(),
                  MatchOptions());
  EXPECT_EQ(matching[2].track_of_truth, Tracks{1});
}

TEST(Matching, ATrackStaysWithItsLastObject) {
  // The track of object 1 moves over to object 2; then 1 approaches again.
  const Matching matching =
      matchFrames(FrameMaker()
                      .add({truthAt(1, 0.0), truthAt(2, 5.0)}, {trackAt(1, 0.0)})
                      .add({truthAt(1, 0.0), truthAt(2, 5.0)}, {trackAt(1, 5.0)})
                      .add({truthAt(1, 4.0), truthAt(2, 5.0)}, {trackAt(1, 4.1)})
                      .frames(),
                  MatchOptions());
  EXPECT_EQ(matching[1].track_of_truth, (Tracks{kNone, 0}));
  EXPECT_EQ(matching[2].track_of_truth, (Tracks{kNone, 0}));
}

TEST(Matching, RequiredObjectsTakeTheirTracksFirst) {
  const Matching matching = matchFrames(
      FrameMaker().add({optionalAt(1, 0.0), truthAt(2, 1.0)}, {trackAt(1, 0.0)}).frames(),
      MatchOptions());
  EXPECT_EQ(matching[0].track_of_truth, (Tracks{kNone, 0}));
  EXPECT_EQ(matching[0].verdicts, Verdicts{Verdict::kHit});
}

TEST(Matching, AllTracksOfAnOptionalObjectAreNeutral) {
  const Matching matching = matchFrames(
      FrameMaker()
          .add({optionalAt(1, 0.0)}, {trackAt(1, 1.0), trackAt(2, 0.5), trackAt(3, 9.0)})
          .frames(),
      MatchOptions());
  EXPECT_EQ(matching[0].track_of_truth, Tracks{1});
  EXPECT_EQ(matching[0].verdicts,
            (Verdicts{Verdict::kNeutral, Verdict::kNeutral, Verdict::kFalse}));
}

TEST(Matching, ASecondTrackOnARequiredObjectIsFalse) {
  const Matching matching =
      matchFrames(FrameMaker().add({truthAt(1, 0.0)}, {trackAt(1, 1.0), trackAt(2, 0.5)}).frames(),
                  MatchOptions());
  EXPECT_EQ(matching[0].verdicts, (Verdicts{Verdict::kFalse, Verdict::kHit}));
}

TEST(Matching, PartnersOfAnOptionalObjectStayPartnersWhenItIsRequired) {
  const Matching matching =
      matchFrames(FrameMaker()
                      .add({optionalAt(1, 0.0)}, {trackAt(1, 0.0)})
                      .add({truthAt(1, 0.0)}, {trackAt(2, 0.1), trackAt(1, 1.0)})
                      .frames(),
                  MatchOptions());
  EXPECT_EQ(matching[1].track_of_truth, Tracks{1});
}

TEST(Matching, HitsAreThoseOfRequiredObjects) {
  const Frames frames = FrameMaker()
                            .add({optionalAt(1, 0.0), truthAt(2, 10.0), truthAt(3, 20.0)},
                                 {trackAt(8, 10.0), trackAt(9, 0.0)})
                            .frames();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hits;
  forEachHit(frames[0], matchFrames(frames, MatchOptions())[0],
             [&hits](const TrueState& truth, const TrackState& track) {
               hits.emplace_back(truth.id, track.id);
             });
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].first, 2U);
  EXPECT_EQ(hits[0].second, 8U);
}

}  // namespace
}  // namespace datmo::evaluation::matching_test
