// SPDX-License-Identifier: BSD-3-Clause
// The bag runner with track-level fusion: the small drive with a stereo camera that sees a wall,
// and with another system's objects and tracks.
#include "stereo_drive.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/track.h"

namespace datmo::run_bag_track_fusion_test {
namespace {

using Sensors = std::vector<std::string>;

constexpr std::uint32_t kRadarId = 7;

/// Another system's report: one object, 12 m ahead of where the drive begins.
TrackArray radarTracksAt(Stamp stamp) {
  Track track;
  track.id = kRadarId;
  track.state << 12.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  track.covariance = 0.1 * TrackCovariance::Identity();
  track.box = {{12.0, 0.0, 0.0}, 4.0, 1.8};
  track.heading_variance = 0.01;
  track.existence_probability = 0.95;
  return toMessage(TrackList{stamp, {track}, {}}, "map");
}

class TrackFusedRun : public StereoRunBag {
 protected:
  TrackFusedRun() { arguments_.track_fusion = true; }

  /// Returns whether a source of one of the fused tracks has this name.
  bool isFusedOf(const std::string& source) const {
    return anyTrack("/tracks", [&](const TrackMessage& track) {
      return std::any_of(track.sources.begin(), track.sources.end(),
                         [&](const auto& member) { return member.source == source; });
    });
  }

  template <typename Test>
  bool anyTrack(const std::string& topic, const Test& test) const {
    const auto lists = listsOf<TrackArray>(topic);
    return std::any_of(lists.begin(), lists.end(), [&](const TrackArray& list) {
      return std::any_of(list.tracks.begin(), list.tracks.end(), test);
    });
  }

  void expectTracks(std::size_t stereo) const {
    EXPECT_EQ(count(arguments_.output, "/tracks/lidar"), kScanCount);
    EXPECT_EQ(count(arguments_.output, "/tracks/stereo"), stereo);
    EXPECT_EQ(count(arguments_.output, "/tracks"), kScanCount);
  }
};

TEST_F(TrackFusedRun, EveryScansTracksAreFusedWithThoseOfTheClouds) {
  appendClouds();
  arguments_.times = path("times.json");
  const std::string table = run();
  expectTracks(kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/objects"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/objects/stereo"), kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/objects/fused"), 0U);
  EXPECT_FALSE(holds(table, "dropped")) << table;
  EXPECT_FALSE(holds(table, "warned")) << table;
  const std::string times = bytes(arguments_.times);
  for (const char* stage : {"stereo_objects", "stereo_tracker", "track_fusion"}) {
    EXPECT_TRUE(holds(table, stage)) << table;
    EXPECT_TRUE(holds(times, stage)) << times;
  }
}

TEST_F(TrackFusedRun, FusedTracksHaveTheStampsOfTheScans) {
  appendClouds();
  run();
  const auto fused = listsOf<TrackArray>("/tracks");
  const auto scanned = listsOf<TrackArray>("/tracks/lidar");
  ASSERT_EQ(fused.size(), scanned.size());
  for (std::size_t i = 0; i < fused.size(); ++i) {
    EXPECT_EQ(fused[i].header, scanned[i].header) << i;
  }
}

TEST_F(TrackFusedRun, StereoCameraHasATrackerOfItsOwn) {
  writeConfig("{track_fusion: {scheme: union}, stereo_camera: {align: false}}");
  appendEachScan("/objects/stereo", pedestrianAt);
  const std::string table = run();
  expectTracks(kScanCount);
  const auto isAny = [](const TrackMessage&) { return true; };
  EXPECT_TRUE(anyTrack("/tracks/stereo", isAny)) << "it keeps ahead of the vehicle";
  EXPECT_TRUE(isFusedOf("stereo"));
  EXPECT_FALSE(holds(table, "stereo_objects")) << table;
}

TEST_F(TrackFusedRun, StereoTrackerDoesNotUseTheScannersField) {
  appendEachScan("/objects/stereo", pedestrianAt);
  run();
  for (const TrackArray& list : listsOf<TrackArray>("/tracks/stereo")) {
    EXPECT_TRUE(list.views.empty()) << "these objects tell none";
  }
  EXPECT_FALSE(listsOf<TrackArray>("/tracks/lidar").back().views.empty());
}

TEST_F(TrackFusedRun, TrackersOptionsAreTheirOwn) {
  appendEachScan("/objects/stereo", pedestrianAt);
  const auto stereo_tracks_end_empty = [&](const std::string& config) {
    writeConfig(config);
    run();
    return listsOf<TrackArray>("/tracks/stereo").back().tracks.empty();
  };
  EXPECT_FALSE(stereo_tracks_end_empty("{tracker: {max_position_std: 0.1}}"));
  EXPECT_TRUE(stereo_tracks_end_empty("{stereo_tracker: {max_position_std: 0.1}}"))
      << "none is so sure";
}

TEST_F(TrackFusedRun, BadOptionsAreNamedWithTheirSection) {
  for (const std::string section : {"stereo_tracker", "track_fusion"}) {
    writeConfig("{" + section + ": {warp: 9}, stereo_camera: {align: false}}");
    const std::string message = failure();
    EXPECT_TRUE(holds(message, section) && holds(message, "warp")) << message;
  }
}

TEST_F(TrackFusedRun, WithoutObjectsTracksOfAnotherSystemAreUsed) {
  writeConfig("{track_fusion: {scheme: union}, stereo_camera: {align: false}}");
  appendEachScan("/tracks/stereo", radarTracksAt);
  run();
  expectTracks(0);
  EXPECT_TRUE(isFusedOf("stereo"));
}

TEST_F(TrackFusedRun, ObjectsHavePriorityOverRecordedTracks) {
  appendEachScan("/tracks/stereo", radarTracksAt);
  appendEachScan("/objects/stereo", pedestrianAt);
  run();
  expectTracks(kScanCount);
  EXPECT_EQ(count(arguments_.output, "/objects/stereo"), 0U);
}

TEST_F(TrackFusedRun, CloudsHavePriorityOverBoth) {
  appendEachScan("/tracks/stereo", radarTracksAt);
  appendEachScan("/objects/stereo", pedestrianAt);
  appendClouds();
  run();
  expectTracks(kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/objects/stereo"), kCloudCount);
}

TEST_F(TrackFusedRun, TracksOfOtherSourcesComeFromTheBag) {
  appendClouds();
  appendEachScan("/tracks/radar", radarTracksAt);
  run();
  EXPECT_FALSE(isFusedOf("radar")) << "nobody asks for it";
  writeConfig(
      "{track_fusion: {sources: {radar: {use: true}}, scheme: union}, stereo_camera: {align: "
      "false}}");
  run();
  expectTracks(kCloudCount);
  EXPECT_TRUE(isFusedOf("radar"));
  EXPECT_EQ(count(arguments_.output, "/tracks/radar"), 0U);
}

TEST_F(TrackFusedRun, PendingTracksAreFusedAtTheEnd) {
  writeConfig(
      "{track_fusion: {sources: {radar: {use: true}}, max_wait: 0.5, silent_after: 10}, "
      "stereo_camera: {align: false}}");
  appendClouds();
  run();
  expectTracks(kCloudCount);
}

TEST_F(TrackFusedRun, TrackerFollowsTheFusedObjectsWithBothLevels) {
  appendEachScan("/objects/stereo", pedestrianAt);
  arguments_.object_fusion = true;
  run();
  expectTracks(kScanCount);
  EXPECT_EQ(count(arguments_.output, "/objects/fused"), kScanCount);
  EXPECT_TRUE(anyTrack("/tracks/lidar", [](const TrackMessage& track) {
    return track.sensors == Sensors{"stereo"};
  })) << "fusion of objects lets it through";
}

TEST_F(TrackFusedRun, EachCombinationOfLevelsGivesTheSameBytesTwice) {
  appendClouds();
  appendEachScan("/tracks/radar", radarTracksAt);
  writeConfig(
      "{track_fusion: {sources: {radar: {use: true}}, scheme: union}, stereo_camera: {align: "
      "false}}");
  for (const bool low : {false, true}) {
    for (const bool object : {false, true}) {
      arguments_.low_level_fusion = low;
      arguments_.object_fusion = object;
      run();
      expectTracks(kCloudCount);
      const std::string first = bytes(arguments_.output);
      run();
      EXPECT_EQ(first, bytes(arguments_.output)) << low << object;
    }
  }
}

TEST_F(TrackFusedRun, CloudsMadeFromImagesAreUsed) {
  appendImages();
  run();
  expectTracks(kCloudCount);
}

TEST_F(TrackFusedRun, TrackersMayBeTheLastStage) {
  appendClouds();
  arguments_.last_stage = LastStage::kTracker;
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/tracks/lidar"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/tracks/stereo"), kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/tracks"), 0U);
  EXPECT_FALSE(holds(table, "track_fusion")) << table;
}

TEST_F(TrackFusedRun, MissingStereoIsNamed) {
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/stereo/points2")) << message;
  EXPECT_TRUE(holds(message, "track_fusion/sources/stereo/use")) << message;
}

TEST_F(TrackFusedRun, OneSourceIsEnough) {
  writeConfig("{track_fusion: {sources: {stereo: {use: false}}}, stereo_camera: {align: false}}");
  run();
  expectTracks(0);
}

TEST_F(TrackFusedRun, OneLevelMayIgnoreTheCameraThatTheOtherUses) {
  appendClouds();
  writeConfig("{track_fusion: {sources: {stereo: {use: false}}}, stereo_camera: {align: false}}");
  arguments_.object_fusion = true;
  run();
  expectTracks(0);
  EXPECT_EQ(count(arguments_.output, "/objects/stereo"), kCloudCount);
  writeConfig("{object_fusion: {sources: {stereo: {use: false}}}, stereo_camera: {align: false}}");
  run();
  expectTracks(kCloudCount);
}

TEST(TrackFusionArguments, AreRead) {
  const Arguments arguments =
      parseArguments({"a.bag", "b.bag", "--config", "c.yaml", "--track-fusion",
                      "--stereo-from-images", "--until", "track_fusion"});
  EXPECT_TRUE(arguments.track_fusion);
  EXPECT_FALSE(arguments.object_fusion);
  EXPECT_EQ(arguments.last_stage, LastStage::kTrackFusion);
}

TEST(TrackFusionArguments, IncompatibleOnesAreRefused) {
  const std::vector<std::string> files = {"a.bag", "b.bag", "--config", "c.yaml"};
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--until", "track_fusion"},
        {"--track-fusion", "--until", "moving_objects"},
        {"--track-fusion", "--object-fusion", "--until", "object_fusion"}}) {
    std::vector<std::string> words = files;
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_THROW(parseArguments(words), UsageError) << options.back();
  }
}

}  // namespace
}  // namespace datmo::run_bag_track_fusion_test
