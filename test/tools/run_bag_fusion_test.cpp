// SPDX-License-Identifier: BSD-3-Clause
// The bag runner with low-level fusion: the small drive with a stereo camera that sees a wall.
#include <filesystem>

#include "stereo_drive.h"
#include <gtest/gtest.h>

#include <nav_msgs/OccupancyGrid.h>

namespace datmo::run_bag_fusion_test {
namespace {

class FusedRun : public StereoRunBag {
 protected:
  FusedRun() {
    arguments_.low_level_fusion = true;
    arguments_.write_grids = true;
  }

  void expectGrids() const {
    EXPECT_EQ(count(arguments_.output, "/grids/lidar"), kScanCount);
    EXPECT_EQ(count(arguments_.output, "/grids/stereo"), kCloudCount);
    EXPECT_EQ(count(arguments_.output, "/grids/fused"), kScanCount);
    EXPECT_EQ(count(arguments_.output, "/grids/conflict"), kScanCount);
  }
};

TEST_F(FusedRun, EveryScanIsFusedWithClouds) {
  appendClouds();
  const std::string table = run();
  expectGrids();
  for (const char* topic : {"/pose", "/labeled_scan", "/objects", "/tracks", "/tf"}) {
    EXPECT_EQ(count(arguments_.output, topic), kScanCount) << topic;
  }
  EXPECT_FALSE(holds(table, "dropped")) << table;
  EXPECT_FALSE(holds(table, "stereo_image_proc")) << table;
}

TEST_F(FusedRun, WithoutCloudsTheyAreMadeFromImages) {
  appendImages();
  EXPECT_TRUE(holds(run(), "stereo_image_proc"));
  expectGrids();
}

TEST_F(FusedRun, RawImagesAreFoundByTheirName) {
  appendImages("image_raw");
  run();
  expectGrids();
}

TEST_F(FusedRun, OnRequestImagesReplaceClouds) {
  appendClouds();
  arguments_.stereo_from_images = true;
  EXPECT_TRUE(holds(failure(), "/stereo/left/image_raw"));
  arguments_.remappings["/left_image"] = "/stereo/left/image_rect";
  EXPECT_TRUE(holds(failure(), "/stereo/left/image_rect"));
  appendImages();
  EXPECT_TRUE(holds(run(), "stereo_image_proc"));
}

TEST_F(FusedRun, ImagesLeadToTheSameGridsAsTheirClouds) {
  appendClouds();
  appendImages();
  run();
  const auto cells = [this] {
    rosbag::Bag bag(arguments_.output);
    std::vector<std::int8_t> all;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/grids/stereo"))) {
      const auto grid = message.instantiate<nav_msgs::OccupancyGrid>();
      all.insert(all.end(), grid->data.begin(), grid->data.end());
    }
    return all;
  };
  const auto of_clouds = cells();
  arguments_.stereo_from_images = true;
  run();
  EXPECT_EQ(of_clouds, cells());
}

TEST_F(FusedRun, SameBagGivesTheSameBytes) {
  appendImages();
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(FusedRun, MatchingAheadGivesTheSameBytes) {
  appendImages();
  arguments_.jobs = 1;
  run();
  const std::string one = bytes(arguments_.output);
  arguments_.jobs = 4;
  run();
  EXPECT_EQ(one, bytes(arguments_.output));
}

TEST(JobsArgument, IsANumberOfThreads) {
  const auto parsed = [](const std::string& jobs) {
    return parseArguments({"in.bag", "out.bag", "--config", "c.yaml", "--jobs", jobs}).jobs;
  };
  EXPECT_EQ(parsed("3"), 3);
  for (const char* jobs : {"0", "-1", "5000", "x"}) {
    EXPECT_THROW(parsed(jobs), UsageError) << jobs;
  }
}

TEST_F(FusedRun, GridsAreWrittenOnlyOnRequest) {
  appendClouds();
  arguments_.write_grids = false;
  run();
  EXPECT_EQ(count(arguments_.output, "/grids/fused"), 0U);
  EXPECT_EQ(count(arguments_.output, "/pose"), kScanCount);
}

TEST_F(FusedRun, FusionMayBeTheLastStage) {
  appendClouds();
  arguments_.last_stage = LastStage::kGridFusion;
  const std::string table = run();
  expectGrids();
  EXPECT_EQ(count(arguments_.output, "/pose"), 0U);
  EXPECT_FALSE(holds(table, "grid_slam")) << table;
}

TEST_F(FusedRun, RuleMayBeChosen) {
  appendClouds();
  run();
  const std::string usual = bytes(arguments_.output);
  arguments_.grid_rule = "maximum";
  run();
  EXPECT_NE(usual, bytes(arguments_.output));
  std::filesystem::remove(arguments_.output);
  arguments_.grid_rule = "minimum";
  EXPECT_TRUE(holds(failure(), "minimum"));
}

TEST_F(FusedRun, MissingStereoIsNamed) {
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/stereo/points2")) << message;
  EXPECT_TRUE(holds(message, "/scan (sensor_msgs/LaserScan)")) << message;
}

TEST_F(FusedRun, OneSourceIsEnough) {
  writeConfig("{grid_fusion: {sources: {stereo: {use: false}}}, stereo_camera: {align: false}}");
  run();
  EXPECT_EQ(count(arguments_.output, "/grids/fused"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/pose"), kScanCount);
}

TEST_F(FusedRun, FusionStopsWaitingForStereoThatEnds) {
  appendClouds();
  {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (int i = kScans; i < 2 * kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      bag.write("/odometry", toTime(stamp), odometryAt(stamp));
      bag.write("/tf", toTime(stamp),
                transform(fromMessage(odometryAt(stamp).pose.pose), stamp, "odom", "base_link"));
      bag.write("/scan", toTime(stamp), scanAt(stamp));
    }
  }
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/grids/fused"), 2U * kScanCount);
  EXPECT_TRUE(holds(table, "silent_source")) << table;
}

TEST_F(FusedRun, GridsOfOtherSourcesComeFromTheBag) {
  appendClouds();
  run();
  const std::string two_sources = bytes(arguments_.output);
  std::filesystem::rename(arguments_.output, path("grids.bag"));
  {
    rosbag::Bag recorded(path("grids.bag"));
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (const auto& message : rosbag::View(recorded, rosbag::TopicQuery("/grids/lidar"))) {
      bag.write("/grids/radar", message.getTime(), message);
    }
  }
  writeConfig("{grid_fusion: {sources: {radar: {weight: 0.5}}}, stereo_camera: {align: false}}");
  run();
  EXPECT_NE(two_sources, bytes(arguments_.output));
  EXPECT_EQ(count(arguments_.output, "/grids/fused"), kScanCount);
}

TEST(FusionArguments, AreRead) {
  const Arguments arguments = parseArguments(
      {"a.bag", "b.bag", "--config", "c.yaml", "--low-level-fusion", "--write-grids", "--grid-rule",
       "priority", "--until", "grid_fusion", "points2:=/cloud", "left_image:=/cam0/image"});
  EXPECT_TRUE(arguments.low_level_fusion);
  EXPECT_TRUE(arguments.write_grids);
  EXPECT_FALSE(arguments.stereo_from_images);
  EXPECT_EQ(arguments.grid_rule, "priority");
  EXPECT_EQ(arguments.last_stage, LastStage::kGridFusion);
  EXPECT_EQ(arguments.inputTopic("points2", "/stereo/points2"), "/cloud");
  EXPECT_EQ(arguments.inputTopic("right_image", "/stereo/right/image_rect"),
            "/stereo/right/image_rect");
}

class MapRun : public StereoRunBag {
 protected:
  MapRun() {
    arguments_.map_fusion = true;
    appendClouds();
  }
};

TEST_F(MapRun, EachSensorHasAMapOncePerPeriod) {
  EXPECT_FALSE(holds(run(), "dropped"));
  const std::size_t maps = count(arguments_.output, "/map/fused");
  EXPECT_GE(maps, 2U);
  EXPECT_EQ(count(arguments_.output, "/map/conflicts"), maps);
  EXPECT_EQ(count(arguments_.output, "/map/changes"), 0U) << "there is no map of before";
  EXPECT_EQ(count(arguments_.output, "/grids/stereo"), 0U) << "only between the stages";
  EXPECT_EQ(count(arguments_.output, "/tracks"), kScanCount);
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_EQ(bytes(arguments_.output), first) << "bit for bit";
}

TEST_F(MapRun, TheOtherOutputsAreUnchanged) {
  const auto others = [this] {
    run();
    std::string bytes;
    rosbag::Bag bag(arguments_.output);
    const std::vector<std::string> topics = {"/pose", "/map", "/labeled_scan", "/tracks"};
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topics))) {
      std::vector<std::uint8_t> buffer(message.size());
      ros::serialization::OStream stream(buffer.data(), message.size());
      message.write(stream);
      bytes.append(buffer.begin(), buffer.end());
    }
    return bytes;
  };
  const std::string with = others();
  EXPECT_FALSE(with.empty());
  arguments_.map_fusion = false;
  EXPECT_EQ(others(), with);
}

TEST(MapFusionArguments, TheStageMustBeEnabled) {
  const std::vector<std::string> words = {"a.bag", "b.bag", "--config", "c.yaml", "--map-fusion"};
  EXPECT_TRUE(parseArguments(words).map_fusion);
  for (const char* last : {"grid_fusion", "grid_slam"}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--low-level-fusion", "--until", last});
    EXPECT_THROW(parseArguments(all), UsageError) << last;
  }
}

TEST(FusionArguments, NeedTheSwitch) {
  const std::vector<std::string> words = {"a.bag", "b.bag", "--config", "c.yaml"};
  const std::vector<std::vector<std::string>> options = {{"--write-grids"},
                                                         {"--stereo-from-images"},
                                                         {"--grid-rule", "maximum"},
                                                         {"--until", "grid_fusion"}};
  for (const auto& option : options) {
    std::vector<std::string> all = words;
    all.insert(all.end(), option.begin(), option.end());
    EXPECT_THROW(parseArguments(all), UsageError) << option.front();
    all.emplace_back("--low-level-fusion");
    EXPECT_NO_THROW(parseArguments(all)) << option.front();
  }
}

}  // namespace
}  // namespace datmo::run_bag_fusion_test
