// SPDX-License-Identifier: BSD-3-Clause
// The bag runner with road borders, on the small drive between two walls.
#include <cstddef>
#include <string>
#include <vector>

#include "run_bag_drive.h"
#include <gtest/gtest.h>

namespace datmo::run_bag_road_border_test {
namespace {

constexpr auto kAllScans = static_cast<std::size_t>(kScans);

class RoadBorderRun : public RunBag {
 protected:
  RoadBorderRun() { arguments_.road_border = true; }

  /// Returns the number of objects in all messages of a topic.
  template <typename Message>
  std::size_t objectsOn(const std::string& topic) const {
    rosbag::Bag bag(arguments_.output);
    std::size_t objects = 0;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      objects += message.instantiate<Message>()->objects.size();
    }
    return objects;
  }
};

TEST_F(RoadBorderRun, EveryScanLeadsToBordersAndToWhatTheyDrop) {
  const std::string table = run();
  for (const char* topic : {"/road_borders", "/objects/dropped", "/objects", "/tracks"}) {
    EXPECT_EQ(count(arguments_.output, topic), kAllScans) << topic;
  }
  EXPECT_TRUE(holds(table, "road_border")) << table;
  EXPECT_FALSE(holds(table, "dropped by")) << table;
  EXPECT_FALSE(holds(table, "warned by moving_objects")) << "the borders are the scan's: " << table;
}

TEST_F(RoadBorderRun, BordersAreOfTheScanInTheFrameOfTheMap) {
  run();
  rosbag::Bag bag(arguments_.output);
  std::vector<std_msgs::Header> scans;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/labeled_scan"))) {
    scans.push_back(message.instantiate<LabeledScanMessage>()->header);
  }
  std::size_t i = 0;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/road_borders"))) {
    const auto road = message.instantiate<RoadBorders>();
    EXPECT_EQ(road->header.frame_id, "map");
    EXPECT_EQ(road->header.stamp, scans.at(i++).stamp);
  }
}

TEST_F(RoadBorderRun, NoObjectIsDropped) {
  run();
  const std::size_t kept = objectsOn<ObjectArray>("/objects");
  EXPECT_EQ(objectsOn<DroppedObjects>("/objects/dropped"), 0U);
  arguments_.road_border = false;
  run();
  EXPECT_EQ(kept, objectsOn<ObjectArray>("/objects"));
  EXPECT_EQ(count(arguments_.output, "/road_borders"), 0U);
  EXPECT_EQ(count(arguments_.output, "/objects/dropped"), 0U);
}

TEST_F(RoadBorderRun, OnlyObjectsDroppedByTheThesisAreMissing) {
  writeConfig("{moving_objects: {border_filter: {method: thesis}}}");
  run();
  const std::size_t kept = objectsOn<ObjectArray>("/objects");
  const std::size_t dropped = objectsOn<DroppedObjects>("/objects/dropped");
  arguments_.road_border = false;
  run();
  EXPECT_EQ(kept + dropped, objectsOn<ObjectArray>("/objects"));
}

TEST_F(RoadBorderRun, SameBagGivesTheSameBytesWithBorders) {
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(RoadBorderRun, ItMayEndWithTheBorders) {
  arguments_.last_stage = LastStage::kRoadBorder;
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/road_borders"), kAllScans);
  EXPECT_EQ(count(arguments_.output, "/objects"), 0U);
  EXPECT_FALSE(holds(table, "moving_objects")) << table;
}

TEST_F(RoadBorderRun, ABadOptionOfItsSectionIsNamed) {
  writeConfig("road_border: {wide: true}\n");
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "road_border: wide")) << message;
}

TEST(RunBagArguments, BordersRequireTheStagesThatUseThem) {
  const auto parsed = [](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"a", "b", "--config", "c"};
    words.insert(words.end(), more.begin(), more.end());
    return parseArguments(words);
  };
  EXPECT_FALSE(parsed({}).road_border);
  EXPECT_TRUE(parsed({"--road-border"}).road_border);
  EXPECT_EQ(parsed({"--road-border", "--until", "road_border"}).last_stage, LastStage::kRoadBorder);
  EXPECT_THROW(parsed({"--until", "road_border"}), UsageError);
  EXPECT_THROW(parsed({"--road-border", "--until", "grid_slam"}), UsageError);
  EXPECT_NO_THROW(parsed({"--road-border", "--until", "moving_objects"}));
}

}  // namespace
}  // namespace datmo::run_bag_road_border_test
