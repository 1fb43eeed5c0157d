// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/track_check.h"

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/scan.h"

namespace datmo::track_check_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Track goodTrack() {
  Track track;
  track.id = 1;
  track.state << 10.0, 5.0, 3.0, 0.0, 0.1, 0.0;
  track.mode_probabilities = {0.5, 0.2, 0.1, 0.1, 0.1};
  track.box = {{10.0, 5.0, 0.0}, 4.0, 1.8};
  track.class_probabilities = {0.2, 0.2, 0.2, 0.2, 0.2};
  track.existence_probability = 0.9;
  track.age = 2.0;
  track.history = {{Stamp::fromSeconds(1.0), Pose2(9.0, 5.0, 0.0)}};
  return track;
}

ViewFan goodFan() { return {Pose2(), -1.0, 0.1, 0.0, 40.0, 80.0, true, {10.0, 0.0, 80.0}}; }

TEST(TrackCheck, AcceptsGoodTracks) {
  EXPECT_TRUE(isValid(goodTrack()));
  Track bare = goodTrack();
  bare.history.clear();
  bare.sensors.clear();
  bare.id = 0;
  EXPECT_TRUE(isValid(bare)) << "another tracker may tell less";
}

TEST(TrackCheck, RefusesEachBadNumber) {
  const std::vector<std::pair<std::string, std::function<double&(Track&)>>> numbers = {
      {"state", [](Track& t) -> double& { return t.state[3]; }},
      {"variance", [](Track& t) -> double& { return t.covariance(4, 4); }},
      {"covariance", [](Track& t) -> double& { return t.covariance(1, 4); }},
      {"length", [](Track& t) -> double& { return t.box.length; }},
      {"width", [](Track& t) -> double& { return t.box.width; }},
      {"height", [](Track& t) -> double& { return t.height; }},
      {"yaw rate", [](Track& t) -> double& { return t.yaw_rate; }},
      {"heading variance", [](Track& t) -> double& { return t.heading_variance; }},
      {"mode", [](Track& t) -> double& { return t.mode_probabilities[1]; }},
      {"class", [](Track& t) -> double& { return t.class_probabilities[1]; }},
      {"existence", [](Track& t) -> double& { return t.existence_probability; }},
      {"age", [](Track& t) -> double& { return t.age; }},
      {"since_update", [](Track& t) -> double& { return t.since_update; }},
  };
  for (const auto& [name, number] : numbers) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      Track track = goodTrack();
      number(track) = bad;
      EXPECT_FALSE(isValid(track)) << name << " " << bad;
    }
  }
}

TEST(TrackCheck, PositionsAreFiniteAndNotTooFar) {
  for (const double bad : {kNan, kInfinity, 1e200}) {
    Track track = goodTrack();
    track.box.center = Pose2(bad, 5.0, 0.0);
    EXPECT_FALSE(isValid(track)) << bad;
    track = goodTrack();
    track.history[0].pose = Pose2(9.0, bad, 0.0);
    EXPECT_FALSE(isValid(track)) << "history " << bad;
    track = goodTrack();
    track.state[0] = bad;
    EXPECT_FALSE(isValid(track)) << "state " << bad;
  }
  Track track = goodTrack();
  track.box.center = Pose2(10.0, 5.0, kNan);
  EXPECT_FALSE(isValid(track)) << "heading";
}

TEST(TrackCheck, CovarianceIsSymmetricAndPositiveDefinite) {
  Track track = goodTrack();
  track.covariance(0, 2) = 0.5;
  EXPECT_FALSE(isValid(track)) << "skew";
  track.covariance(0, 2) = 3e-6;
  EXPECT_FALSE(isValid(track)) << "more than the check of published messages allows";
  track.covariance(4, 4) = 1e8;
  EXPECT_FALSE(isValid(track)) << "small only beside another quantity's variance";
  track.covariance(4, 4) = 1.0;
  track.covariance(0, 2) = 1e308;
  EXPECT_FALSE(isValid(track)) << "its square would overflow";
  track.covariance(0, 2) = track.covariance(2, 0) = 0.5;
  EXPECT_TRUE(isValid(track));
  track.covariance(0, 2) = track.covariance(2, 0) = 1.0;
  EXPECT_FALSE(isValid(track)) << "semidefinite";
  track.covariance = TrackCovariance::Zero();
  EXPECT_FALSE(isValid(track));
  track.covariance = -TrackCovariance::Identity();
  EXPECT_FALSE(isValid(track));
  track.covariance = 1e200 * TrackCovariance::Identity();
  EXPECT_FALSE(isValid(track)) << "its determinant would overflow";
}

TEST(TrackCheck, AmountsAndProbabilitiesHaveTheirRange) {
  const std::vector<std::function<void(Track&)>> faults = {
      [](Track& t) { t.box.length = -0.1; },
      [](Track& t) { t.box.length = 1e6; },          // longer than any train
      [](Track& t) { t.state[2] = 1e6; },            // m/s
      [](Track& t) { t.heading_variance = 1e300; },  // sums with others overflow
      [](Track& t) { t.height = -1.0; },
      [](Track& t) { t.heading_variance = -0.01; },
      [](Track& t) { t.age = -1.0; },
      [](Track& t) { t.age = 1e12; },  // would not fit into a message's duration
      [](Track& t) { t.since_update = -0.1; },
      [](Track& t) { t.existence_probability = 1.01; },
      [](Track& t) { t.existence_probability = -0.01; },
      [](Track& t) { t.mode_probabilities[0] = 1.5; },
      [](Track& t) { t.class_probabilities[0] = -0.5; },
      [](Track& t) {
        t.class_probabilities = {0.5, 0.5, 0.5, 0.0, 0.0};
      },
      [](Track& t) {
        t.mode_probabilities = {0.5, 0.5, 0.5, 0.0, 0.0};
      },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Track track = goodTrack();
    faults[i](track);
    EXPECT_FALSE(isValid(track)) << i;
  }
}

TEST(TrackCheck, PublishedTracksAreValid) {
  TrackingScene scene;
  std::size_t tracks = 0;
  for (int i = 0; i < 120; ++i) {
    const double driven = 4.0 * std::min(scene.nextTime() - 100.0, 6.0);
    const TrackList& list = scene.scan({objectAt(10.0 + driven + scene.noise(0.1), 2.0)});
    for (const Track& track : list.tracks) {
      EXPECT_TRUE(isValid(track)) << "scan " << i;
      ++tracks;
    }
  }
  EXPECT_GT(tracks, 80U) << "moving, then standing";
}

TEST(TrackCheck, FansCanBeLookedUp) {
  EXPECT_TRUE(isValid(goodFan()));
  ViewFan fan = goodFan();
  fan.beam_spacing = -0.1;
  EXPECT_TRUE(isValid(fan)) << "from left to right";
  fan.reach.clear();
  EXPECT_TRUE(isValid(fan)) << "nothing is known";
  fan.reach.assign(kMaxBeams, 1.0);
  EXPECT_TRUE(isValid(fan));
  fan.reach.push_back(1.0);
  EXPECT_FALSE(isValid(fan)) << "too many beams";
}

TEST(TrackCheck, RefusesBadFans) {
  const std::vector<std::function<void(ViewFan&, double)>> faults = {
      [](ViewFan& fan, double bad) { fan.sensor = Pose2(bad, 0.0, 0.0); },
      [](ViewFan& fan, double bad) { fan.sensor = Pose2(0.0, 0.0, bad); },
      [](ViewFan& fan, double bad) { fan.first_bearing = bad; },
      [](ViewFan& fan, double bad) { fan.beam_spacing = bad; },
      [](ViewFan& fan, double bad) { fan.min_range = bad; },
      [](ViewFan& fan, double bad) { fan.sure_range = bad; },
      [](ViewFan& fan, double bad) { fan.range = bad; },
      [](ViewFan& fan, double bad) { fan.reach[1] = bad; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      ViewFan fan = goodFan();
      faults[i](fan, bad);
      EXPECT_FALSE(isValid(fan)) << i << " " << bad;
    }
  }
  ViewFan fan = goodFan();
  fan.beam_spacing = 0.0;
  EXPECT_FALSE(isValid(fan));
  fan.beam_spacing = std::numeric_limits<double>::denorm_min();
  EXPECT_FALSE(isValid(fan)) << "as good as 0";
  fan = goodFan();
  fan.reach[0] = -1.0;
  EXPECT_FALSE(isValid(fan));
}

}  // namespace
}  // namespace datmo::track_check_test
