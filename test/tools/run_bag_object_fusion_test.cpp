// SPDX-License-Identifier: BSD-3-Clause
// The bag runner with object-level fusion: the small drive with a stereo camera that sees a wall,
// and with another system's objects.
#include "stereo_drive.h"
#include <gtest/gtest.h>

namespace datmo::run_bag_object_fusion_test {
namespace {

class ObjectFusedRun : public StereoRunBag {
 protected:
  ObjectFusedRun() { arguments_.object_fusion = true; }

  /// Returns how many lists of fused objects have a pedestrian that `sensor` alone saw.
  std::size_t listsWithPedestrianOf(const std::string& sensor) const {
    const auto isOne = [&](const ObjectMessage& object) {
      return object.classification == ObjectMessage::CLASS_PEDESTRIAN &&
             object.sensors == std::vector<std::string>{sensor};
    };
    const auto lists = listsOf<ObjectArray>("/objects/fused");
    return static_cast<std::size_t>(
        std::count_if(lists.begin(), lists.end(), [&](const ObjectArray& list) {
          return std::any_of(list.objects.begin(), list.objects.end(), isOne);
        }));
  }

  /// Returns the time from a scan's stamp until its tracks are published, s.
  double longestWait() const {
    rosbag::Bag bag(arguments_.output);
    double longest = 0.0;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/tracks"))) {
      const auto stamp = message.instantiate<TrackArray>()->header.stamp;
      longest = std::max(longest, (message.getTime() - stamp).toSec());
    }
    return longest;
  }

  void expectObjects(std::size_t stereo) const {
    EXPECT_EQ(count(arguments_.output, "/objects"), kScanCount);
    EXPECT_EQ(count(arguments_.output, "/objects/stereo"), stereo);
    EXPECT_EQ(count(arguments_.output, "/objects/fused"), kScanCount);
    EXPECT_EQ(count(arguments_.output, "/tracks"), kScanCount);
  }
};

TEST_F(ObjectFusedRun, EveryScansObjectsAreFusedWithThoseOfTheClouds) {
  appendClouds();
  const std::string table = run();
  expectObjects(kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/pose"), kScanCount);
  EXPECT_FALSE(holds(table, "dropped")) << table;
  EXPECT_FALSE(holds(table, "grid_fusion")) << table;
  for (const char* stage : {"stereo_objects", "object_fusion"}) {
    EXPECT_TRUE(holds(table, stage)) << table;
  }
}

TEST_F(ObjectFusedRun, CloudsMadeFromImagesAreUsedByBothLevels) {
  appendImages();
  arguments_.low_level_fusion = true;
  arguments_.write_grids = true;
  arguments_.times = path("times.json");
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/grids/stereo"), kCloudCount);
  const std::string times = bytes(arguments_.times);
  const std::string made = times.substr(times.find("stereo_image_proc"));
  EXPECT_EQ(made.find("\"runs\": " + std::to_string(kStereoClouds)), made.find("\"runs\""))
      << times;
}

TEST_F(ObjectFusedRun, ImagesLeadToTheSameAsTheirClouds) {
  appendClouds();
  appendImages();
  run();
  const auto of_clouds = listsOf<ObjectArray>("/objects/stereo");
  arguments_.stereo_from_images = true;
  EXPECT_TRUE(holds(run(), "stereo_image_proc"));
  EXPECT_EQ(of_clouds, listsOf<ObjectArray>("/objects/stereo"));
}

TEST_F(ObjectFusedRun, SameBagGivesTheSameBytes) {
  appendClouds();
  appendEachScan("/objects/radar", pedestrianAt);
  writeConfig("{object_fusion: {sources: {radar: {use: true}}}, stereo_camera: {align: false}}");
  arguments_.low_level_fusion = true;
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(ObjectFusedRun, TracksWaitForTheCameraUnlessItCountsRetroactively) {
  appendClouds();
  run();
  const auto fused = listsOf<ObjectArray>("/objects/fused");
  const double waiting = longestWait();
  writeConfig("{object_fusion: {retroactive: true}, stereo_camera: {align: false}}");
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(fused, listsOf<ObjectArray>("/objects/fused")) << "what is fused is the same";
  EXPECT_LT(longestWait() + 0.01, waiting);
}

TEST_F(ObjectFusedRun, WithoutCloudsStereoObjectsOfAnotherSystemAreUsed) {
  appendEachScan("/objects/stereo", pedestrianAt);
  const std::string table = run();
  expectObjects(0);
  EXPECT_EQ(listsWithPedestrianOf("stereo"), kScanCount);
  EXPECT_FALSE(holds(table, "stereo_objects")) << table;
}

TEST_F(ObjectFusedRun, CloudsHavePriorityOverRecordedObjects) {
  appendEachScan("/objects/stereo", pedestrianAt);
  appendClouds();
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(listsWithPedestrianOf("stereo"), 0U);
}

TEST_F(ObjectFusedRun, ObjectsOfOtherSourcesComeFromTheBag) {
  appendClouds();
  appendEachScan("/objects/radar", pedestrianAt);
  writeConfig("{object_fusion: {sources: {radar: {use: true}}}, stereo_camera: {align: false}}");
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(listsWithPedestrianOf("radar"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/objects/radar"), 0U);
}

TEST_F(ObjectFusedRun, TracksAreThoseOfTheFusedObjects) {
  appendEachScan("/objects/stereo", pedestrianAt);
  run();
  const auto isTrackedByStereo = [this] {
    const auto tracks = listsOf<TrackArray>("/tracks").back().tracks;
    return std::any_of(tracks.begin(), tracks.end(), [](const TrackMessage& track) {
      return track.sensors == std::vector<std::string>{"stereo"};
    });
  };
  EXPECT_TRUE(isTrackedByStereo()) << "it keeps ahead of the vehicle, so that it moves";
  arguments_.object_fusion = false;
  run();
  EXPECT_FALSE(isTrackedByStereo());
}

TEST_F(ObjectFusedRun, FusionMayBeTheLastStage) {
  appendClouds();
  arguments_.last_stage = LastStage::kObjectFusion;
  run();
  EXPECT_EQ(count(arguments_.output, "/objects/fused"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/tracks"), 0U);
}

TEST_F(ObjectFusedRun, MissingStereoIsNamed) {
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/stereo/points2")) << message;
  EXPECT_TRUE(holds(message, "object_fusion/sources/stereo/use")) << message;
}

TEST_F(ObjectFusedRun, OneSourceIsEnough) {
  writeConfig("{object_fusion: {sources: {stereo: {use: false}}}, stereo_camera: {align: false}}");
  run();
  expectObjects(0);
}

TEST_F(ObjectFusedRun, OneLevelMayIgnoreTheCameraThatTheOtherUses) {
  appendClouds();
  writeConfig("{object_fusion: {sources: {stereo: {use: false}}}, stereo_camera: {align: false}}");
  arguments_.low_level_fusion = true;
  arguments_.write_grids = true;
  run();
  expectObjects(0);
  EXPECT_EQ(count(arguments_.output, "/grids/stereo"), kCloudCount);
}

TEST(ObjectFusionArguments, AreRead) {
  const Arguments arguments =
      parseArguments({"a.bag", "b.bag", "--config", "c.yaml", "--object-fusion",
                      "--stereo-from-images", "--until", "object_fusion"});
  EXPECT_TRUE(arguments.object_fusion);
  EXPECT_FALSE(arguments.low_level_fusion);
  EXPECT_EQ(arguments.last_stage, LastStage::kObjectFusion);
}

TEST(FusionArguments, OneOptionEnablesAllThatALevelNeeds) {
  const auto read = [](const std::string& level) {
    return parseArguments({"a.bag", "b.bag", "--config", "c.yaml", "--fusion", level});
  };
  EXPECT_FALSE(read("none").object_fusion);
  EXPECT_TRUE(read("low").low_level_fusion);
  EXPECT_FALSE(read("low").object_fusion);
  EXPECT_TRUE(read("object").object_fusion);
  EXPECT_TRUE(read("track").track_fusion);
  EXPECT_TRUE(read("recommended").track_fusion);
  EXPECT_TRUE(read("recommended").road_border);
  EXPECT_THROW(read("all"), UsageError);
  EXPECT_TRUE(
      parseArguments({"a.bag", "b.bag", "--config", "c.yaml", "--fusion", "none", "--track-fusion"})
          .track_fusion)
      << "what is on by itself stays on";
}

TEST(ObjectFusionArguments, IncompatibleOnesAreRefused) {
  const std::vector<std::string> files = {"a.bag", "b.bag", "--config", "c.yaml"};
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--until", "object_fusion"},
        {"--object-fusion", "--until", "moving_objects"},
        {"--object-fusion", "--write-grids"},
        {"--stereo-from-images"}}) {
    std::vector<std::string> words = files;
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_THROW(parseArguments(words), UsageError) << options.back();
  }
}

}  // namespace
}  // namespace datmo::run_bag_object_fusion_test
