// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "track_fusion_sample.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/track_fusion_stage.h"

namespace datmo::track_fusion_input_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(TrackFusionStageTest, BadTracksAreLeftOutAndTheirSourceIsNamed) {
  const std::vector<std::function<void(TrackMessage&)>> spoils = {
      [](TrackMessage& track) { track.pose.position.x = kNan; },
      [](TrackMessage& track) { track.velocity.y = std::numeric_limits<double>::infinity(); },
      [](TrackMessage& track) { track.size.x = -1.0; },
      [](TrackMessage& track) { track.covariance.fill(0.0); },
      [](TrackMessage& track) { track.covariance[1] = kNan; },
      [](TrackMessage& track) { track.heading_variance = -1.0; },
      [](TrackMessage& track) { track.mode_probabilities.clear(); },
      [](TrackMessage& track) { track.class_probabilities[0] = 2.0F; },
      [](TrackMessage& track) { track.existence_probability = -0.5F; },
      [](TrackMessage& track) { track.id = 0; },
      [](TrackMessage& track) { track.id = kStereosId; },  // a duplicate
  };
  for (std::size_t i = 0; i < spoils.size(); ++i) {
    const double t = 100.0 + 0.1 * static_cast<double>(i);
    TrackArray tracks =
        list(t, {carTrack("stereo", kStereosId, t), carTrack("stereo", 23, t, 9.0)});
    spoils[i](tracks.tracks[1]);
    handle("lidar", list(t, {}));
    handle("stereo", tracks);
    ASSERT_TRUE(nextAt(t)) << i;
    EXPECT_EQ(warnings("bad_track"), i + 1U) << i;
    EXPECT_NE(monitor_.lastError().find("1 bad tracks of stereo"), std::string::npos);
  }
  EXPECT_EQ(figure("bad tracks of stereo"), static_cast<double>(spoils.size()));
  EXPECT_EQ(monitor_.figures().count("bad tracks of lidar"), 0U);
  EXPECT_EQ(monitor_.warningCount(), spoils.size());
}

TEST_F(TrackFusionStageTest, TheRestOfAListWithABadTrackIsFused) {
  for (int i = 0; i < 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    Track bad = carTrack("stereo", 5, t);
    bad.covariance.setZero();
    handle("lidar", t);
    handle("stereo", list(t, {bad, carTrack("stereo", kStereosId, t)}));
    ASSERT_TRUE(nextAt(t));
  }
  EXPECT_EQ(figure("tracks of two or more sources"), 1.0);
}

TEST_F(TrackFusionStageTest, TracksWithoutHistoryAreFusedToo) {
  TrackArrayPtr fused;
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    for (const std::string source : {"lidar", "stereo"}) {
      TrackArray tracks = carOf(source, t);
      tracks.tracks[0].history.clear();
      handle(source, tracks);
    }
    fused = nextAt(t);
    ASSERT_TRUE(fused);
  }
  EXPECT_EQ(membersOf(*fused).size(), 2U);
  EXPECT_EQ(monitor_.warningCount(), 0U);
}

TEST_F(TrackFusionStageTest, BadViewsAreLeftOutAndReported) {
  ViewFan good;
  good.beam_spacing = 0.1;
  good.sure_range = 20.0;
  good.range = 30.0;
  good.reach = {30.0, 30.0};
  ViewFan still = good;
  still.beam_spacing = 0.0;
  ViewFan behind = good;
  behind.reach = {30.0, -1.0};
  handle("lidar", 100.0);
  handle("stereo",
         toMessage(TrackList{Stamp::fromSeconds(100.0), {}, {still, good, behind}}, "map"));
  EXPECT_EQ(warnings("bad_view"), 1U);
  EXPECT_NE(monitor_.lastError().find("2 bad views of stereo"), std::string::npos);
  EXPECT_EQ(figure("bad views of stereo"), 2.0);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->views.size(), 1U);
}

TEST_F(TrackFusionStageTest, OfAThousandTracksTheMostCertainAreUsed) {
  stage_.change({{"scheme", std::string("union")}});
  std::vector<Track> many;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    many.push_back(carTrack("stereo", i + 1, 100.0, 10.0 * i));
    many.back().existence_probability = 0.6 + 0.0004 * i;
  }
  handle("lidar", list(100.0, {}));
  handle("stereo", list(100.0, many));
  EXPECT_EQ(warnings("many_tracks"), 1U);
  EXPECT_EQ(figure("tracks too many of stereo"), 800.0);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->tracks.size(), static_cast<std::size_t>(options_.fuser.max_tracks));
  EXPECT_TRUE(std::all_of(fused->tracks.begin(), fused->tracks.end(), [](const auto& track) {
    return track.pose.position.y > 7999.0;
  })) << "those that hardly exist are left out";
  EXPECT_TRUE(bothAt(100.1));
  EXPECT_EQ(monitor_.warningCount(), 1U) << "said once for a list";
}

/// The inputs that a stage declares.
class InputList : public StagePorts {
 public:
  std::map<std::string, bool> required;  ///< by topic

 private:
  void addInput(StageInput input) override { required[input.topic] = input.required; }
  StageOutput::Publish addOutput(StageOutput /*output*/) override { return {}; }
};

TEST_F(TrackFusionStageTest, TheSilenceOfOtherStationsIsNoFault) {
  options_.fuser.sources["v2x"];
  TrackFusionStage stage(options_, monitor_);
  InputList inputs;
  stage.connect(inputs);
  EXPECT_EQ(inputs.required,
            (std::map<std::string, bool>{
                {"tracks/lidar", true}, {"tracks/stereo", true}, {"tracks/v2x", false}}));
  for (int i = 0; i < 50; ++i) {
    const double t = 100.0 + 0.1 * i;
    const Stamp now = Stamp::fromSeconds(t);
    stage.handleTracks("lidar", carOf("lidar", t), now);
    if (i < 25) {
      stage.handleTracks("stereo", carOf("stereo", t), now);
    }
    while (stage.next(now)) {
    }
  }
  EXPECT_EQ(warnings("silent_source"), 1U) << "that of the camera";
}

TEST(TrackFusionStageOptionsTest, DelaysUpToHalfASecondAreAcceptedByDefault) {
  const TrackFusionStageOptions options;
  EXPECT_GE(options.matcher.tolerance, 0.5 + options.matcher.max_wait);
  EXPECT_GT(options.matcher.silent_after, options.matcher.tolerance);
}

}  // namespace
}  // namespace datmo::track_fusion_input_test
