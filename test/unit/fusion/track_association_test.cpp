// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_association.h"

#include <cstdint>
#include <vector>

#include "fusion_tracks.h"
#include <gtest/gtest.h>

namespace datmo::track_association_test {
namespace {

Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

PresentTracks lidar(std::vector<Track> tracks) { return {0, true, std::move(tracks)}; }
PresentTracks stereo(std::vector<Track> tracks) { return {1, true, std::move(tracks)}; }

Track of(double x, double y, double vx, std::uint32_t id) {
  return carTrack(x, y, vx, 0.0, "", id);
}

/// Returns whether track 0 of both sources is one object after steps of 0.1 s, with this offset and
/// drift.
bool areOne(const TrackAssociationOptions& options, double seconds, double offset, double drift) {
  TrackAssociation association(options);
  std::size_t groups = 2;
  for (int i = 0; i <= static_cast<int>(10.0 * seconds); ++i) {
    const double t = 0.1 * i;
    groups = association
                 .associate(at(t), {lidar({of(10.0 * t, 0.0, 10.0, 1)}),
                                    stereo({of(10.0 * t, offset + drift * t, 10.0, 1)})})
                 .size();
  }
  return groups == 1;
}

TEST(TrackAssociationTest, TracksThatAgreeAreOneAndAllOthersStaySeparate) {
  TrackAssociation association({});
  const std::vector<TrackGroup> groups =
      association.associate(at(0.0), {lidar({of(0.0, 0.0, 10.0, 4), of(40.0, 0.0, 10.0, 2)}),
                                      stereo({of(40.3, 0.1, 10.2, 9), of(80.0, 0.0, 1.0, 7)})});
  ASSERT_EQ(groups.size(), 3U);
  ASSERT_EQ(groups[0].size(), 1U);
  ASSERT_EQ(groups[1].size(), 2U);
  EXPECT_EQ(groups[1][1].list, 1U);
  EXPECT_EQ(groups[1][1].track, 0U);
  ASSERT_EQ(groups[2].size(), 1U);
  EXPECT_EQ(groups[2][0].track, 1U);
}

TEST(TrackAssociationTest, NoTracksAndOneSourceAreNoMatter) {
  TrackAssociation association({});
  EXPECT_TRUE(association.associate(at(0.0), {}).empty());
  EXPECT_TRUE(association.associate(at(0.1), {lidar({}), stereo({})}).empty());
  EXPECT_EQ(association.associate(at(0.2), {stereo({of(0.0, 0.0, 1.0, 1)})}).size(), 1U);
}

TEST(TrackAssociationTest, TheLikeliestOfAllPairingsNotTheNearestFirst) {
  // Two abreast, and the camera sees both 1 m too far left: its right one is nearest to the left
  // one.
  TrackAssociation association({});
  const std::vector<TrackGroup> groups =
      association.associate(at(0.0), {lidar({of(0.0, 0.0, 10.0, 1), of(0.0, 1.8, 10.0, 2)}),
                                      stereo({of(0.0, 1.0, 10.0, 1), of(0.0, 2.8, 10.0, 2)})});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0][1].track, 0U);
  EXPECT_EQ(groups[1][1].track, 1U);
}

TEST(TrackAssociationTest, AmbiguousPairsTakeTime) {
  // Always 1.5 m apart: at first the evidence is not sufficient, after half a second it is.
  TrackAssociationOptions options;
  options.required = 12.0;
  EXPECT_FALSE(areOne(options, 0.0, 0.5, 0.0));
  EXPECT_TRUE(areOne(options, 1.0, 0.5, 0.0));
}

TEST(TrackAssociationTest, TheParallelTestDoesNotWait) {
  TrackAssociationOptions options;
  options.test = TrackAssociationTest::kParallel;
  EXPECT_TRUE(areOne(options, 0.0, 0.5, 0.0));
  EXPECT_FALSE(areOne(options, 0.0, 4.5, 0.0));
}

TEST(TrackAssociationTest, TracksThatDriftApartAreSeparatedAgain) {
  EXPECT_TRUE(areOne({}, 1.0, 0.0, 0.0));
  EXPECT_FALSE(areOne({}, 5.0, 0.0, 2.0));
}

TEST(TrackAssociationTest, AssociatedPairsAreKept) {
  // A new track is nearer for a moment than the one that was associated all the time.
  TrackAssociation association({});
  for (int i = 0; i < 20; ++i) {
    association.associate(at(0.1 * i),
                          {lidar({of(i, 0.0, 10.0, 1)}), stereo({of(i, 0.8, 10.0, 1)})});
  }
  const std::vector<TrackGroup> groups = association.associate(
      at(2.0),
      {lidar({of(20.0, 0.0, 10.0, 1)}), stereo({of(20.0, 0.8, 10.0, 1), of(20.0, -0.2, 10.0, 2)})});
  ASSERT_EQ(groups.size(), 2U);
  ASSERT_EQ(groups[0].size(), 2U);
  EXPECT_EQ(groups[0][1].track, 0U);
}

TEST(TrackAssociationTest, PredictedTracksAreNoNewEvidence) {
  TrackAssociationOptions options;
  options.required = 12.0;
  const auto steps = [&](bool fresh) {
    TrackAssociation association(options);
    std::size_t groups = 0;
    for (int i = 0; i <= 10; ++i) {
      const PresentTracks a{0, fresh, {of(i, 0.0, 10.0, 1)}};
      const PresentTracks b{1, fresh, {of(i, 0.5, 10.0, 1)}};
      groups = association.associate(at(0.1 * i), {a, b}).size();
    }
    return groups;
  };
  EXPECT_EQ(steps(true), 1U);
  EXPECT_EQ(steps(false), 2U);
}

TEST(TrackAssociationTest, AThirdSourceJoinsAPairThatItAgreesWith) {
  TrackAssociation association({});
  const PresentTracks radar{2, true, {of(0.4, 0.0, 10.0, 5)}};
  const std::vector<TrackGroup> groups = association.associate(
      at(0.0), {lidar({of(0.0, 0.0, 10.0, 1)}), stereo({of(0.3, 0.2, 10.0, 1)}), radar});
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].size(), 3U);
}

TEST(TrackAssociationTest, ForgottenPairsHaveToAgreeAgain) {
  TrackAssociationOptions options;
  options.required = 12.0;
  TrackAssociation association(options);
  const auto step = [&](double t) {
    return association
        .associate(at(t),
                   {lidar({of(10.0 * t, 0.0, 10.0, 1)}), stereo({of(10.0 * t, 0.5, 10.0, 1)})})
        .size();
  };
  for (int i = 0; i < 10; ++i) {
    step(0.1 * i);
  }
  EXPECT_EQ(step(1.0), 1U);
  association.reset();
  EXPECT_EQ(step(1.1), 2U);
}

TEST(TrackAssociationTest, BadOptionsAreRefused) {
  EXPECT_THROW(readOptions<TrackAssociationOptions>({{"test", std::string("guess")}}), OptionError);
}

}  // namespace
}  // namespace datmo::track_association_test
