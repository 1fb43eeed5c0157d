// The bag runner with object-level fusion: the small drive with a stereo camera that sees a wall,
// and with another system's objects.
#include <filesystem>

#include "stereo_drive.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/messages.h"

namespace datmo {
namespace {

/// 8 m ahead of the vehicle, wherever that is.
ObjectArray pedestrianAt(Stamp stamp) {
  ObjectMessage pedestrian;
  pedestrian.pose.position.x = 8.0;
  pedestrian.pose.orientation.w = 1.0;
  pedestrian.size.x = 0.5;
  pedestrian.size.y = 0.5;
  pedestrian.position_covariance = {0.1, 0.0, 0.0, 0.1};
  pedestrian.classification = ObjectMessage::CLASS_PEDESTRIAN;
  pedestrian.class_probability = 0.9F;
  ObjectArray list;
  list.header.stamp = toTime(stamp);
  list.header.frame_id = "base_link";
  list.objects = {pedestrian};
  return list;
}

class ObjectFusedRun : public StereoRunBag {
 protected:
  ObjectFusedRun() { arguments_.object_fusion = true; }

  /// What another system says of each scan's time.
  void appendObjects(const std::string& topic) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      bag.write(topic, toTime(stamp), pedestrianAt(stamp));
    }
  }

  /// All messages of a topic of the output.
  template <typename Message>
  std::vector<Message> listsOf(const std::string& topic) const {
    rosbag::Bag bag(arguments_.output);
    std::vector<Message> lists;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      lists.push_back(*message.instantiate<Message>());
    }
    return lists;
  }

  /// How many lists of fused objects have a pedestrian that `sensor` alone saw.
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

TEST_F(ObjectFusedRun, CloudsMadeOfImagesServeBothLevels) {
  appendImages();
  arguments_.low_level_fusion = true;
  arguments_.write_grids = true;
  arguments_.times = path("times.json");
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/grids/stereo"), kCloudCount);
  const std::string times = bytes(arguments_.times);
  const std::string made = times.substr(times.find("stereo_images"));
  EXPECT_EQ(made.find("\"runs\": " + std::to_string(kClouds)), made.find("\"runs\"")) << times;
}

TEST_F(ObjectFusedRun, ImagesLeadToTheSameAsTheirClouds) {
  appendClouds();
  appendImages();
  run();
  const auto of_clouds = listsOf<ObjectArray>("/objects/stereo");
  arguments_.stereo_from_images = true;
  EXPECT_TRUE(holds(run(), "stereo_images"));
  EXPECT_EQ(of_clouds, listsOf<ObjectArray>("/objects/stereo"));
}

TEST_F(ObjectFusedRun, SameBagGivesTheSameBytes) {
  appendClouds();
  appendObjects("/objects/radar");
  writeConfig("{object_fusion: {sources: {radar: {use: true}}}}");
  arguments_.low_level_fusion = true;
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(ObjectFusedRun, AnotherSystemsStereoObjectsServeWhereThereAreNoClouds) {
  appendObjects("/objects/stereo");
  const std::string table = run();
  expectObjects(0);
  EXPECT_EQ(listsWithPedestrianOf("stereo"), kScanCount);
  EXPECT_FALSE(holds(table, "stereo_objects")) << table;
}

TEST_F(ObjectFusedRun, CloudsComeBeforeRecordedObjects) {
  appendObjects("/objects/stereo");
  appendClouds();
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(listsWithPedestrianOf("stereo"), 0U);
}

TEST_F(ObjectFusedRun, ObjectsOfOtherSourcesComeFromTheBag) {
  appendClouds();
  appendObjects("/objects/radar");
  writeConfig("{object_fusion: {sources: {radar: {use: true}}}}");
  run();
  expectObjects(kCloudCount);
  EXPECT_EQ(listsWithPedestrianOf("radar"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/objects/radar"), 0U);
}

TEST_F(ObjectFusedRun, TracksAreThoseOfTheFusedObjects) {
  appendObjects("/objects/stereo");
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
  writeConfig("{object_fusion: {sources: {stereo: {use: false}}}}");
  run();
  expectObjects(0);
}

TEST_F(ObjectFusedRun, OneLevelMayDoWithoutTheCameraThatTheOtherUses) {
  appendClouds();
  writeConfig("{object_fusion: {sources: {stereo: {use: false}}}}");
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

TEST(ObjectFusionArguments, ThatGoNotTogetherAreRefused) {
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
}  // namespace datmo
