// SPDX-License-Identifier: BSD-3-Clause
// Which fused track is the same as which earlier one.
#include <cstdint>
#include <set>
#include <vector>

#include "fusion_tracks.h"
#include "track_sources.h"
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/track/track_fuser.h"

namespace datmo::fused_id_test {
namespace {

TEST(FusedIdTest, TheIdStaysWhileOneSensorLosesTheObjectAndFindsItAgain) {
  TrackFuser fuser{TrackFuserOptions()};
  std::set<std::uint32_t> ids;
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.1 * i;
    std::vector<Track> by_lidar;
    std::vector<Track> by_stereo;
    if (t < 2.0 || t > 3.0) {
      by_lidar = {driving(-15.0, t, "lidar", t < 2.0 ? 1 : 2)};
    }
    if (t < 4.0 || t > 5.0) {
      by_stereo = {driving(-14.8, t, "stereo", t < 4.0 ? 1 : 2)};
    }
    const auto published = idsOf(fuser.fuse(at(t), {lidar(t, by_lidar), stereo(t, by_stereo)}));
    ASSERT_EQ(published.size(), 1U) << t;
    ids.insert(published[0]);
  }
  EXPECT_EQ(ids.size(), 1U);
}

TEST(FusedIdTest, WhenTracksPartTheLongestMemberKeepsTheId) {
  // The camera tracks a cyclist all the time; the scanner's second track of him ends up on a car.
  TrackFuser fuser{TrackFuserOptions()};
  std::uint32_t with_camera = 0;
  std::uint32_t at_first = 0;
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.1 * i;
    Track by_lidar = driving(-15.0, t, "lidar", t < 2.0 ? 1 : 2);
    if (t > 3.0) {
      by_lidar = carTrack(0.0, 0.0, 0.0, 0.0, "lidar", 2);
    }
    const auto result =
        fuser.fuse(at(t), {lidar(t, {by_lidar}), stereo(t, {driving(-14.8, t, "stereo")})});
    for (const Track& track : result.list.tracks) {
      if (track.sources.back().source == "stereo") {
        with_camera = track.id;
      }
    }
    at_first = i == 0 ? with_camera : at_first;
  }
  EXPECT_GT(at_first, 0U);
  EXPECT_EQ(with_camera, at_first);
}

TEST(FusedIdTest, AnObjectBrieflyLostByAllKeepsItsId) {
  TrackFuserOptions options;
  options.memory = 1.5;
  const auto idsAcross = [&](double gap) {
    TrackFuser fuser(options);
    std::set<std::uint32_t> ids;
    for (int i = 0; i <= 50; ++i) {
      const double t = 0.1 * i;
      std::vector<Track> tracks;
      if (t < 1.0 || t > 1.0 + gap) {
        tracks = {driving(50.0, t, "lidar", t < 1.0 ? 1 : 2)};
      }
      for (const std::uint32_t id : idsOf(fuser.fuse(at(t), {lidar(t, tracks), stereo(t, {})}))) {
        ids.insert(id);
      }
    }
    return ids.size();
  };
  EXPECT_EQ(idsAcross(1.0), 1U);
  EXPECT_EQ(idsAcross(2.0), 2U);
}

TEST(FusedIdTest, OneObjectIsNeverTwo) {
  // The sensors contradict each other about its velocity for too long for the tracks to be one.
  TrackFuser fuser(withScheme(TrackScheme::kUnion));
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    const auto result = fuser.fuse(at(t), {lidar(t, {carTrack(10.0, 0.0, 8.0, 0.0, "lidar")}),
                                           stereo(t, {carTrack(10.5, 0.0, -8.0, 0.0, "stereo")})});
    EXPECT_EQ(result.counts.fused, 0U);
    EXPECT_EQ(result.list.tracks.size(), 1U);
  }
}

TEST(FusedIdTest, AfterAResetNoIdIsUsedAgain) {
  TrackFuser fuser(withScheme(TrackScheme::kUnion));
  const auto step = [&](double t) {
    return idsOf(fuser.fuse(at(t), {lidar(t, {driving(0.0, 0.0, "lidar")})})).at(0);
  };
  const std::uint32_t before = step(5.0);
  EXPECT_EQ(step(5.1), before);
  fuser.reset();
  EXPECT_GT(step(0.0), before);
}

}  // namespace
}  // namespace datmo::fused_id_test
