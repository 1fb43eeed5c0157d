// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/fused_targets.h"

#include <cstdint>
#include <string>
#include <vector>

#include "fusion_tracks.h"
#include "track_sources.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/track/track_comparison.h"
#include "datmo_fusion/fusion/track/track_fuser.h"

namespace datmo::fused_targets_test {
namespace {

using Ids = std::vector<std::uint32_t>;

/// In the scanner's view, and far from the camera's.
Track far(const std::string& source, double speed, double existence = 0.9, std::uint32_t id = 1) {
  Track track = carTrack(60.0, 0.0, speed, 0.0, source, id);
  track.existence_probability = existence;
  return track;
}

TEST(FusedTargetsTest, TheIdIsKeptWhicheverSourceLosesAJustFusedObject) {
  // Each has its own target of it until the scanner's track approaches the camera's at 1 s, and the
  // scanner loses it while the camera's old target is not deleted yet.
  TrackFuser fuser{TrackFuserOptions()};
  for (int i = 0; i <= 25; ++i) {
    const double t = 0.1 * i;
    const double x = 10.0 + 5.0 * t;
    std::vector<Track> by_lidar;
    if (i < 18) {
      by_lidar = {carTrack(x, i < 10 ? 6.0 : 0.0, 5.0, 0.0, "lidar", 5)};
    }
    const auto result = fuser.fuse(
        at(t), {lidar(t, by_lidar), stereo(t, {carTrack(x, 0.0, 5.0, 0.0, "stereo", 9)})});
    EXPECT_EQ(idsOf(result), i < 10 ? Ids{} : Ids{1}) << t;
  }
}

TEST(FusedTargetsTest, SpeedAsEvidenceOfTheClassCountsOnce) {
  TrackFuser fuser{TrackFuserOptions()};
  const auto moving = [](double x, const std::string& source) {
    Track track = carTrack(x, 0.0, 7.0, 0.0, source, 5);
    track.class_probabilities =
        withSpeed(ClassBelief().probabilities(), speedOf({track.state, track.covariance}), {});
    return track;
  };
  ClassProbabilities fused{};
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    const double x = 10.0 + 7.0 * t;
    const auto result =
        fuser.fuse(at(t), {lidar(t, {moving(x, "lidar")}), stereo(t, {moving(x, "stereo")})});
    if (i == 20) {
      ASSERT_EQ(result.list.tracks.size(), 1U);
      ASSERT_EQ(result.list.tracks[0].sources.size(), 2U);
      fused = result.list.tracks[0].class_probabilities;
    }
  }
  const ClassProbabilities alone = moving(0.0, "lidar").class_probabilities;
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    EXPECT_NEAR(fused[i], alone[i], 0.03) << i;
  }
}

TEST(FusedTargetsTest, TheCamerasClassIsKeptWhenTheScannerAloneTracksIt) {
  TrackFuserOptions options;
  options.sources["lidar"].class_by_speed = false;
  options.sources["stereo"].class_by_speed = false;
  TrackFuser fuser{options};
  ClassBelief person;
  person.update(reportedClass(ObjectClass::kPedestrian, 0.9));
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    const double x = 10.0 + 1.5 * t;
    std::vector<Track> by_stereo;
    if (i < 15) {
      by_stereo = {carTrack(x, 0.0, 1.5, 0.0, "stereo", 9)};
      by_stereo[0].class_probabilities = person.probabilities();
    }
    Track by_lidar = carTrack(x, 0.0, 1.5, 0.0, "lidar", 5);
    by_lidar.class_probabilities = ClassBelief().probabilities();
    const auto result = fuser.fuse(at(t), {lidar(t, {by_lidar}), stereo(t, by_stereo)});
    if (i > 10) {
      ASSERT_EQ(result.list.tracks.size(), 1U) << t;
      const ClassProbabilities& belief = result.list.tracks[0].class_probabilities;
      EXPECT_GT(belief[static_cast<std::size_t>(ObjectClass::kPedestrian)], 0.5) << t;
    }
  }
}

TEST(FusedTargetsTest, ReacquiredObjectsAreMatchedByTheirUnmodifiedCovariance) {
  // The uncertainty of the body's center between sensors is in the covariance of both already:
  // counted twice, it would merge the two, which must stay two.
  const TrackFuserOptions options;
  const TrackComparisonOptions& comparison = options.association.comparison;
  const auto ofTwo = [&](double y, std::uint32_t id) {
    Track track = carTrack(20.0, y, 5.0, 0.0, "lidar", id);
    track.covariance.diagonal().head<2>().array() += square(comparison.body_std);
    track.sources = {{"lidar", id}, {"stereo", id}};
    return track;
  };
  const auto isOne = [&](const Track& a, const Track& b) {
    return compare(a, b, comparison).log_likelihood_ratio > 0.0;
  };
  const auto countedAgain = [](Track track) {
    track.sources.clear();
    return track;
  };
  int borderline = 0;
  for (double y = 2.5; y < 5.0; y += 0.1) {
    const Track lost = ofTwo(0.0, 1);
    const Track seen = ofTwo(y, 2);
    FusedTargets targets(2);
    targets.follow(at(0.0), 0.0, {lost}, options);
    targets.follow(at(0.0), 0.0, {seen}, options);
    const bool is_one = isOne(lost, seen);
    EXPECT_EQ(targets.all().size(), is_one ? 1U : 2U) << y;
    borderline += isOne(countedAgain(lost), countedAgain(seen)) != is_one ? 1 : 0;
  }
  EXPECT_GT(borderline, 0) << "or this shows nothing";
}

TEST(FusedTargetsTest, UnpublishedTracksHideNothing) {
  // Of the camera alone, and therefore not in the thesis's list, however certain it is.
  TrackFuser fuser(withScheme(TrackScheme::kFusedPlusFallback));
  const auto result = fuser.fuse(
      at(0.0), {lidar(0.0, {far("lidar", 9.0)}), stereo(0.0, {far("stereo", -9.0, 0.99)})});
  ASSERT_EQ(result.list.tracks.size(), 1U);
  EXPECT_EQ(result.list.tracks[0].sources[0].source, "lidar");
}

TEST(FusedTargetsTest, AConfirmedOneOfLowExistenceHidesNothing) {
  TrackFuser fuser(withScheme(TrackScheme::kUnion));
  EXPECT_EQ(idsOf(fuser.fuse(at(0.0),
                             {lidar(0.0, {far("lidar", 9.0)}), stereo(0.0, {far("stereo", 9.0)})})),
            Ids{1});
  EXPECT_EQ(idsOf(fuser.fuse(at(0.1), {lidar(0.1, {far("lidar", -9.0, 0.9, 2)}),
                                       stereo(0.1, {far("stereo", 9.0, 0.1)})})),
            Ids{2});
}

TEST(FusedTargetsTest, OfTwoAtOnePositionTheSameOneIsPublished) {
  TrackFuser fuser(withScheme(TrackScheme::kUnion));
  for (int i = 0; i < 6; ++i) {
    const double t = 0.1 * i;
    const double existence = i % 2 == 0 ? 0.7 : 0.88;
    const auto result = fuser.fuse(at(t), {received("lidar", t, {far("lidar", 9.0, existence)}, {}),
                                           received("stereo", t, {far("stereo", -9.0, 0.8)}, {})});
    ASSERT_EQ(result.list.tracks.size(), 1U);
    EXPECT_EQ(result.list.tracks[0].sources[0].source, "stereo") << t;
  }
}

TEST(FusedTargetsTest, ASourceWithoutBeamsIsNotMissed) {
  TrackFuser fuser{TrackFuserOptions()};
  ViewFan unknown;
  unknown.beam_spacing = degrees(1.0);
  const auto result = fuser.fuse(
      at(0.0), {lidar(0.0, {far("lidar", 9.0)}), received("stereo", 0.0, {}, {unknown})});
  ASSERT_EQ(result.list.tracks.size(), 1U);
  EXPECT_NEAR(result.list.tracks[0].existence_probability, 0.9, 1e-9);
}

/// Returns how long an approaching car is not published after it first was, if the camera has a
/// track of it `needed` s after it came into its view.
double secondsHidden(double needed, TrackScheme scheme) {
  TrackFuser fuser(withScheme(scheme));
  int hidden = 0;
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.1 * i;
    const Track car = carTrack(60.0 - 10.0 * t, 0.0, -10.0, 0.0, "lidar");
    std::vector<Track> by_stereo;
    if (t > 2.0 + needed) {
      by_stereo = {carTrack(60.0 - 10.0 * t, 0.0, -10.0, 0.0, "stereo")};
    }
    hidden +=
        fuser.fuse(at(t), {lidar(t, {car}), stereo(t, by_stereo)}).list.tracks.empty() ? 1 : 0;
  }
  return 0.1 * hidden;
}

TEST(FusedTargetsTest, ATrackEnteringAnothersViewStaysPublishedUntilConfirmed) {
  for (const TrackScheme scheme : {TrackScheme::kByExistence, TrackScheme::kFusedPlusFallback}) {
    EXPECT_EQ(secondsHidden(0.2, scheme), 0.0);
    EXPECT_EQ(secondsHidden(1.0, scheme), 0.0);
  }
  EXPECT_GT(secondsHidden(3.0, TrackScheme::kFusedPlusFallback), 1.0)
      << "the camera does not see it";
}

TEST(FusedTargetsTest, ItIsAsOldAsTheOldestOfItsTracks) {
  TrackFuser fuser{TrackFuserOptions()};
  Track old = far("stereo", 9.0);
  old.age = 30.0;
  const auto result = fuser.fuse(at(0.0), {lidar(0.0, {far("lidar", 9.0)}), stereo(0.0, {old})});
  ASSERT_EQ(result.list.tracks.size(), 1U);
  EXPECT_NEAR(result.list.tracks[0].age, 30.0, 1e-6);
}

TEST(FusedTargetsTest, TheMostCertainSourceIsCountedOnce) {
  TrackFuserOptions options;
  for (auto& [name, source] : options.sources) {
    constexpr double kFar = 300.0;  // m
    source.detection = {{0.8, kFar}, {0.8, kFar}, {0.8, kFar}};
  }
  options.published_existence = 0.5;
  options.sources["lidar"].false_agreement_probability = 0.1;
  options.sources["stereo"].false_agreement_probability = 0.8;
  const auto existence = [&](double by_lidar, double by_stereo) {
    TrackFuser fuser(options);
    const auto result = fuser.fuse(at(0.0), {lidar(0.0, {far("lidar", 9.0, by_lidar)}),
                                             stereo(0.0, {far("stereo", 9.0, by_stereo)})});
    return result.list.tracks.at(0).existence_probability;
  };
  // Odds of 4; the other one's evidence is detection / false_agreement_probability: 8, and 1.
  EXPECT_NEAR(existence(0.6, 0.8), 32.0 / 33.0, 1e-9);
  EXPECT_NEAR(existence(0.8, 0.6), 0.8, 1e-9);
}

}  // namespace
}  // namespace datmo::fused_targets_test
