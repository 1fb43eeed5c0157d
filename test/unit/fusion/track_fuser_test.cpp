// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_fuser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "fusion_tracks.h"
#include "track_sources.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo::track_fuser_test {
namespace {

/// Returns the output after steps of 0.1 s, if both sources see a car at 20 m, the scanner sees one
/// at 60 m and a ghost at 15 m, and the camera a ghost at 30 m.
TrackFusionResult afterTwoSeconds(TrackScheme scheme) {
  TrackFuser fuser(withScheme(scheme));
  TrackFusionResult result;
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    result = fuser.fuse(
        at(t),
        {lidar(t, {driving(-20.0, t, "lidar", 1), driving(50.0, t, "lidar", 2),
                   carTrack(0.0, 15.0, 1.0, 0.0, "lidar", 3)}),
         stereo(t, {driving(-19.7, t, "stereo", 1), carTrack(0.0, -30.0, 1.0, 0.0, "stereo", 2)})});
  }
  return result;
}

TEST(TrackFuserTest, TheThesissListIsWhatBothSeeAndTheScannersBeyond) {
  const TrackFusionResult result = afterTwoSeconds(TrackScheme::kFusedPlusFallback);
  ASSERT_EQ(result.list.tracks.size(), 2U);
  const Track& both = result.list.tracks[0];
  EXPECT_EQ(both.sensors, (std::vector<std::string>{"lidar", "stereo"}));
  ASSERT_EQ(both.sources.size(), 2U);
  EXPECT_GT(both.existence_probability, 0.95);
  EXPECT_NEAR(both.state.x(), -9.85, 0.05);
  EXPECT_TRUE(isValid(both));
  const Track& beyond = result.list.tracks[1];
  EXPECT_EQ(beyond.sensors, std::vector<std::string>{"lidar"});
  EXPECT_NEAR(beyond.state.x(), 60.0, 1e-6);
  EXPECT_EQ(result.counts.fused, 1U);
  EXPECT_EQ(result.counts.published, 2U);
  EXPECT_EQ(result.list.views.size(), 2U);
}

TEST(TrackFuserTest, ASuddenStopInOneSourceLeavesTheVelocityUncertain) {
  // They were one for two seconds, at 5 m/s; now one of them is wrong.
  TrackFuser fuser(withScheme(TrackScheme::kByExistence));
  const auto step = [&](double t, double speed_of_stereo) {
    Track own = driving(-19.7, t, "stereo", 1);
    own.state[2] = speed_of_stereo;
    own.covariance.block<2, 2>(2, 2) = 0.0025 * Eigen::Matrix2d::Identity();
    return fuser.fuse(at(t), {lidar(t, {driving(-20.0, t, "lidar", 1)}), stereo(t, {own})});
  };
  for (int i = 0; i < 20; ++i) {
    step(0.1 * i, 5.0);
  }
  const TrackFusionResult result = step(2.0, 0.0);
  ASSERT_EQ(result.list.tracks.size(), 1U);
  const Track& both = result.list.tracks[0];
  ASSERT_EQ(both.sources.size(), 2U);
  EXPECT_GT(both.covariance(2, 2), 2.0 * 2.0) << "either 5 m/s or none";
}

TEST(TrackFuserTest, TheBodysCenterBetweenSensorsIsUncertain) {
  const TrackFuserOptions options = withScheme(TrackScheme::kByExistence);
  const double body_variance = square(options.association.comparison.body_std);
  TrackFuser fuser(options);
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.1 * i;
    const bool alone = i > 20;
    const Track by_lidar = driving(-20.0, t, "lidar", 1);
    std::vector<Track> by_stereo;
    if (!alone) {
      by_stereo = {driving(-20.0, t, "stereo", 1)};
    }
    const auto result = fuser.fuse(at(t), {lidar(t, {by_lidar}), stereo(t, by_stereo)});
    if (i > 10) {
      ASSERT_EQ(result.list.tracks.size(), 1U);
      const Track& track = result.list.tracks[0];
      ASSERT_EQ(track.sources.size(), alone ? 1U : 2U);
      // The intersection of two equal ones is as certain as either.
      EXPECT_NEAR(track.covariance(0, 0), by_lidar.covariance(0, 0) + (alone ? 0.0 : body_variance),
                  1e-6)
          << t;
    }
  }
}

TEST(TrackFuserTest, ConfirmedByAllIsSeenByBoth) {
  const TrackFusionResult result = afterTwoSeconds(TrackScheme::kConfirmedByAll);
  ASSERT_EQ(result.list.tracks.size(), 1U);
  EXPECT_EQ(result.list.tracks[0].sources.size(), 2U);
}

TEST(TrackFuserTest, TwoSourcesOfOneSensorCountOnce) {
  // With object fusion enabled, the first tracker receives the camera's objects, too.
  const auto published = [](const std::vector<std::string>& sensors) {
    TrackFuser fuser(withScheme(TrackScheme::kConfirmedByAll));
    Track from_lidar = driving(0.0, 0.0, "lidar");
    from_lidar.sensors = sensors;
    return fuser
        .fuse(at(0.0), {lidar(0.0, {from_lidar}), stereo(0.0, {driving(0.2, 0.0, "stereo")})})
        .list.tracks.size();
  };
  EXPECT_EQ(published({"stereo"}), 0U);
  EXPECT_EQ(published({"lidar", "stereo"}), 1U);
  EXPECT_EQ(published({}), 1U);
}

/// The camera's track of a certain class, where the scanner could have seen it for long.
double existenceOf(ObjectClass object_class, double existence = 0.99,
                   const TrackFuserOptions& options = {}) {
  TrackFuser fuser{options};
  Track track = driving(0.0, 0.0, "stereo");
  track.class_probabilities = {};
  track.class_probabilities[static_cast<std::size_t>(object_class)] = 1.0;
  track.existence_probability = existence;
  const TrackFusionResult result = fuser.fuse(at(0.0), {lidar(0.0, {}), stereo(0.0, {track})});
  return result.list.tracks.empty() ? 0.0 : result.list.tracks[0].existence_probability;
}

TEST(TrackFuserTest, ASourceThatReportsNoClassesLeavesThemOpen) {
  TrackFuser fuser{TrackFuserOptions()};
  Track track = driving(0.0, 0.0, "stereo");
  track.class_probabilities = {};
  track.moving = true;
  const TrackFusionResult result = fuser.fuse(at(0.0), {lidar(0.0, {track}), stereo(0.0, {track})});
  ASSERT_EQ(result.list.tracks.size(), 1U);
  EXPECT_TRUE(isValid(result.list.tracks[0])) << "no probability is 0/0";
}

TEST(TrackFuserTest, TracksOfOneSourceArePublishedWhereTheOtherIsBlind) {
  // Odds of 9, since one in ten of a source's tracks is false, times 1 - 0.3, by the default at
  // this range, for the observed part.
  const double pedestrian = existenceOf(ObjectClass::kPedestrian);
  EXPECT_GT(pedestrian, 6.3 / 7.3 - 1e-3);
  EXPECT_LT(pedestrian, 0.9);
  EXPECT_EQ(existenceOf(ObjectClass::kVehicle), 0.0) << "the scanner would have it";
  EXPECT_EQ(existenceOf(ObjectClass::kPedestrian, 0.8), 0.0) << "its tracker is not sure";
}

TEST(TrackFuserTest, ASourceIsTrustedByTheClassThatItReports) {
  const auto existenceOfPerson = [](double share) {
    TrackFuserOptions options;
    options.sources["stereo"].true_share.pedestrian = share;
    return existenceOf(ObjectClass::kPedestrian, 0.99, options);
  };
  EXPECT_NEAR(existenceOfPerson(0.95), 19.0 * 0.7 / (19.0 * 0.7 + 1.0), 0.02);
  EXPECT_EQ(existenceOfPerson(0.5), 0.0) << "odds of 0.7: not published";
}

TEST(TrueShare, IsTheMeanOverTheClassesItMayBeOf) {
  const TrueShareOptions share{0.9, 0.8, 0.7, 0.4};
  EXPECT_NEAR(share.of({0.0, 1.0, 0.0, 0.0, 0.0}), 0.9, 1e-12);
  EXPECT_NEAR(share.of({0.1, 0.0, 0.5, 0.3, 0.1}), 0.5 * 0.8 + 0.3 * 0.7 + 0.2 * 0.4, 1e-12);
}

TEST(TrackFuserTest, MissesFarAwayCountLess) {
  TrackFuserOptions options;
  options.scheme = TrackScheme::kUnion;
  options.published_existence = 0.5;
  options.sources["lidar"].detection = {{0.5, 20.0}, {0.5, 20.0}, {0.5, 20.0}};
  const auto existenceAt = [&](double range) {
    TrackFuser fuser{options};
    const TrackFusionResult result =
        fuser.fuse(at(0.0), {lidar(0.0, {}), stereo(0.0, {driving(range, 0.0, "stereo")})});
    return result.list.tracks.at(0).existence_probability;
  };
  // Odds of 9, times 1 - 0.5 / 2 of the observed part, if that is half, and nearly 1 far away.
  EXPECT_NEAR(existenceAt(20.0), 9.0 * 0.75 / (9.0 * 0.75 + 1.0), 0.02);
  EXPECT_GT(existenceAt(38.0), 0.895);
  EXPECT_LT(existenceAt(5.0), 9.0 * 0.6 / (9.0 * 0.6 + 1.0));
}

TEST(TrackDetection, IsTheMeanOverTheClassesItMayBeOf) {
  constexpr double kFar = 1000.0;  // m
  const TrackDetectionOptions detection{{0.2, kFar}, {0.5, kFar}, {0.8, kFar}};
  EXPECT_NEAR(detection.probability({0.0, 0.5, 0.0, 0.5, 0.0}, 10.0), 0.5, 1e-12);
  EXPECT_NEAR(detection.probability({1.0, 0.0, 0.0, 0.0, 0.0}, 10.0), 0.5, 1e-12) << "of no class";
  EXPECT_NEAR(detection.probability({0.0, 0.0, 0.0, 0.0, 1.0}, 10.0), 0.5, 1e-12)
      << "of one without";
}

TEST(TrackDetection, FallsWithRange) {
  const ClassDetectionOptions detection{0.8, 20.0};
  EXPECT_NEAR(detection.probability(0.0), 0.8, 0.01);
  EXPECT_NEAR(detection.probability(20.0), 0.4, 1e-12);
  EXPECT_NEAR(detection.probability(24.0), 0.8 / (1.0 + std::exp(1.0)), 1e-12);
  EXPECT_LT(detection.probability(50.0), 0.001);
}

TEST(TrackFuserTest, UnionHasAllTracksWithTheirSources) {
  const TrackFusionResult result = afterTwoSeconds(TrackScheme::kUnion);
  ASSERT_EQ(result.list.tracks.size(), 4U);
  std::multiset<std::string> tags;
  for (const Track& track : result.list.tracks) {
    std::string tag;
    for (const std::string& sensor : track.sensors) {
      tag += sensor;
    }
    tags.insert(tag);
    // What the other one would have seen is less likely, what both see is more likely.
    const bool contested = tag == "stereo" || track.state.y() > 10.0;
    EXPECT_EQ(track.existence_probability < 0.89, contested) << tag;
  }
  EXPECT_EQ(tags, (std::multiset<std::string>{"lidar", "lidar", "lidarstereo", "stereo"}));
}

TEST(TrackFuserTest, TheSchemeMayChangeWhileItRuns) {
  TrackFuser fuser(withScheme(TrackScheme::kConfirmedByAll));
  const auto step = [&](double t) {
    return fuser.fuse(at(t), {lidar(t, {driving(0.0, t, "lidar")})});
  };
  EXPECT_TRUE(step(0.0).list.tracks.empty());
  fuser.setOptions(withScheme(TrackScheme::kUnion));
  EXPECT_EQ(step(0.1).list.tracks.size(), 1U);
  TrackFuserOptions options;
  options.published_existence = 2.0;
  EXPECT_THROW(fuser.setOptions(options), OptionError);
}

TEST(TrackFuserTest, ASilentSourceIsNotMissed) {
  TrackFuser fuser(withScheme(TrackScheme::kFusedPlusFallback));
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.1 * i;
    std::vector<SourceTracks> lists = {lidar(t, {driving(0.0, t, "lidar")})};
    const bool silent = t > 2.0;
    if (!silent) {
      lists.push_back(stereo(t, {}));
    }
    const TrackFusionResult result = fuser.fuse(at(t), lists);
    if (t > 1.0 && t < 2.0) {
      EXPECT_TRUE(result.list.tracks.empty()) << t;
    }
    if (t > 3.5) {
      EXPECT_EQ(result.list.tracks.size(), 1U) << t;
    }
  }
}

TEST(TrackFuserTest, ListsOfOtherTimesArePredictedToTheTimeOfFusion) {
  TrackFuser fuser{TrackFuserOptions()};
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    // Each list of the camera arrives half a second late, and only every second time.
    const double received_at = 0.2 * static_cast<int>(i / 2) - 0.5;
    const TrackFusionResult result =
        fuser.fuse(at(t), {lidar(t, {driving(0.0, t, "lidar")}),
                           stereo(received_at, {driving(0.0, received_at, "stereo")})});
    ASSERT_EQ(result.list.tracks.size(), 1U) << t;
    EXPECT_EQ(result.list.tracks[0].sources.size(), 2U) << t;
    EXPECT_NEAR(result.list.tracks[0].state.x(), 5.0 * t, 1e-3);
  }
}

TEST(TrackFuserTest, BadTracksAreCountedAndTheOthersAreFused) {
  TrackFuserOptions options = withScheme(TrackScheme::kUnion);
  options.max_tracks = 2;
  TrackFuser fuser(options);
  Track bad = driving(0.0, 0.0, "lidar", 7);
  bad.state.x() = std::numeric_limits<double>::quiet_NaN();
  Track weak = carTrack(0.0, 30.0, 1.0, 0.0, "lidar", 8);
  weak.existence_probability = 0.6;
  const auto result = fuser.fuse(
      at(0.0),
      {lidar(0.0, {bad, driving(0.0, 0.0, "lidar", 1), weak, driving(60.0, 0.0, "lidar", 2)})});
  EXPECT_EQ(result.counts.rejected, 1U);
  EXPECT_EQ(result.counts.refused, 1U);
  EXPECT_EQ(result.list.tracks.size(), 2U);
}

TEST(TrackFuserTest, UnknownSourcesAndBadOptionsAreRefused) {
  TrackFuser fuser{TrackFuserOptions()};
  EXPECT_THROW(fuser.fuse(at(0.0), {received("radar", 0.0, {}, {})}), std::out_of_range);
  EXPECT_THROW(readOptions<TrackFuserOptions>({{"scheme", std::string("some")}}), OptionError);
  TrackFuserOptions options;
  options.beyond = "radar";
  EXPECT_THROW(TrackFuser{options}, OptionError);
  options.sources["radar"].use = false;
  EXPECT_THROW(TrackFuser{options}, OptionError) << "nothing would come out beyond";
  options.sources["radar"].use = true;
  EXPECT_NO_THROW(TrackFuser{options});
}

}  // namespace
}  // namespace datmo::track_fuser_test
