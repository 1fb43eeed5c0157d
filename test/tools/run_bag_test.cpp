// SPDX-License-Identifier: BSD-3-Clause
// The bag runner on a small drive that is generated here.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "input_bag.h"
#include "interruption.h"
#include "run_bag/stage_times.h"
#include "run_bag_drive.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::run_bag_test {
namespace {

TEST_F(RunBag, EveryScanLeadsToResults) {
  const std::string table = run();
  for (const char* topic :
       {"/pose", "/localization", "/labeled_scan", "/objects", "/tracks", "/tf"}) {
    EXPECT_EQ(count(arguments_.output, topic), static_cast<std::size_t>(kScans)) << topic;
  }
  EXPECT_EQ(count(arguments_.output, "/map"), 4U);  // 1.74 s, one every 0.5 s
  EXPECT_EQ(count(arguments_.output, "/ground_truth/pose"), 0U);
  EXPECT_TRUE(holds(table, "scans processed")) << table;
}

TEST_F(RunBag, PosesFollowTheDrive) {
  run();
  rosbag::Bag bag(arguments_.output);
  Pose2 last;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/pose"))) {
    last = fromMessage(message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose.pose);
  }
  EXPECT_NEAR(last.x(), (kScans - 1) * kPeriod * kSpeed, 0.3);
  EXPECT_NEAR(last.y(), 0.0, 0.1);
}

TEST_F(RunBag, ThePoseIsAsUncertainAsMatchAndDriftTogether) {
  run();
  rosbag::Bag bag(arguments_.output);
  const auto posesOf = [&](const std::string& topic) {
    std::vector<PoseWithCovariance> poses;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      poses.push_back(
          fromMessage(message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose));
    }
    return poses;
  };
  const auto poses = posesOf("/pose");
  const auto local = posesOf("/pose/local");
  ASSERT_EQ(poses.size(), local.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].pose.position(), local[i].pose.position());
    EXPECT_GE(poses[i].covariance(0, 0), local[i].covariance(0, 0));
  }
  EXPECT_GT(poses.back().covariance(2, 2), local.back().covariance(2, 2));
}

TEST_F(RunBag, SameBagGivesTheSameBytes) {
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(RunBag, GroundTruthIsCopiedOnRequest) {
  arguments_.with_truth = true;
  run();
  EXPECT_EQ(count(arguments_.output, "/ground_truth/pose"), static_cast<std::size_t>(kScans));
}

TEST_F(RunBag, QuietPrintsNothing) {
  arguments_.quiet = true;
  EXPECT_EQ(run(), "");
}

TEST_F(RunBag, StagesAfterTheLastOneAreLeftOut) {
  arguments_.last_stage = LastStage::kGridSlam;
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/pose"), static_cast<std::size_t>(kScans));
  EXPECT_EQ(count(arguments_.output, "/objects"), 0U);
  EXPECT_FALSE(holds(table, "moving_objects")) << table;
  arguments_.last_stage = LastStage::kMovingObjects;
  run();
  EXPECT_EQ(count(arguments_.output, "/objects"), static_cast<std::size_t>(kScans));
  EXPECT_EQ(count(arguments_.output, "/tracks"), 0U);
}

TEST_F(RunBag, TimesOfTheStagesAreWrittenOnRequest) {
  arguments_.times = path("times.json");
  run();
  const auto times = nlohmann::json::parse(bytes(arguments_.times));
  EXPECT_EQ(times.at("grid_slam").at("runs"), kScans);
  EXPECT_GT(times.at("tracker").at("mean_s"), 0.0);
}

TEST_F(RunBag, MissingBagIsNamed) {
  arguments_.input = path("nowhere.bag");
  EXPECT_EQ(failure(), path("nowhere.bag") + ": no such file");
}

TEST_F(RunBag, TruncatedBagIsNamed) {
  std::filesystem::resize_file(arguments_.input, std::filesystem::file_size(arguments_.input) / 2);
  EXPECT_TRUE(holds(failure(), arguments_.input));
}

TEST_F(RunBag, FileThatIsNoBagIsNamed) {
  std::ofstream(arguments_.input) << "not a bag";
  EXPECT_TRUE(holds(failure(), arguments_.input + ": is not a bag"));
}

TEST_F(RunBag, MissingScanIsNamedWithTheAvailableTopics) {
  arguments_.remappings["/scan"] = "/front";
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/front")) << message;
  EXPECT_TRUE(holds(message, "/scan (sensor_msgs/LaserScan)")) << message;
}

TEST_F(RunBag, MissingOdometryIsAnErrorUnlessTheOptionsAllowIt) {
  arguments_.remappings["/odometry"] = "/wheels";
  EXPECT_TRUE(holds(failure(), "no Odometry on /wheels"));
  writeConfig("motion: {source: none}\n");
  EXPECT_NO_THROW(run());
}

TEST_F(RunBag, TopicOfAnotherTypeIsNamed) {
  arguments_.remappings["/odometry"] = "/tf_static";
  const std::string message = failure();
  EXPECT_TRUE(holds(message,
                    "as wrong_type (/tf_static is tf2_msgs/TFMessage, expected "
                    "nav_msgs/Odometry)"))
      << message;
}

TEST_F(RunBag, MissingMountLeavesNoScan) {
  writeDrive(false);
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "base_link -> scanner")) << message;
}

TEST_F(RunBag, MisspelledKeyIsNamedWithItsSection) {
  writeConfig("grid_slam: {map_perod: 1.0}\n");
  const std::string message = failure();
  EXPECT_TRUE(holds(message, arguments_.config + ": grid_slam: map_perod")) << message;
}

TEST_F(RunBag, UnknownSectionIsNamed) {
  writeConfig("grid_slm: {map_period: 1.0}\n");
  EXPECT_TRUE(holds(failure(), arguments_.config + ": grid_slm"));
}

TEST_F(RunBag, APresetsKeysAreCheckedToo) {
  arguments_.presets = {path("preset.yaml")};
  std::ofstream(arguments_.presets[0]) << "grid_slam: {map_perod: 1.0}\n";
  const std::string message = failure();
  EXPECT_TRUE(holds(message, arguments_.presets[0] + ": grid_slam: map_perod")) << message;
}

TEST_F(RunBag, TheThesissFormsRunOnEveryScan) {
  writeDrive();
  arguments_.road_border = true;
  arguments_.presets = {DATMO_FUSION_SOURCE_DIR "/config/thesis.yaml"};
  run();
  EXPECT_EQ(count(arguments_.output, "/road_borders"), static_cast<std::size_t>(kScans));
  EXPECT_EQ(count(arguments_.output, "/tracks"), static_cast<std::size_t>(kScans));
}

TEST_F(RunBag, InterruptionLeavesNoBag) {
  writeDrive();
  noteInterruptions();
  std::raise(SIGINT);
  EXPECT_TRUE(holds(failure(), "interrupted"));
  noteInterruptions();
  EXPECT_FALSE(run().empty());
}

TEST_F(RunBag, FolderIsNoOutputBag) {
  writeDrive();
  std::filesystem::create_directory(arguments_.output);
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_directory(arguments_.output));
  EXPECT_FALSE(std::filesystem::exists(arguments_.output + ".part"));
}

TEST_F(RunBag, InputIsNotOverwrittenUnderAnyName) {
  writeDrive();
  const std::string other_name = (folder_ / "." / "in.bag").string();
  EXPECT_THROW(parseArguments({arguments_.input, other_name, "--config", arguments_.config}),
               UsageError);
  EXPECT_THROW(parseArguments({arguments_.input, arguments_.config, "--config", arguments_.config}),
               UsageError);
}

TEST(RunBagArguments, AreReadInAnyOrder) {
  const Arguments arguments =
      parseArguments({"--quiet", "a.bag", "--config", "c.yaml", "scan:=/front", "b.bag"});
  EXPECT_EQ(arguments.input, "a.bag");
  EXPECT_EQ(arguments.output, "b.bag");
  EXPECT_EQ(arguments.config, "c.yaml");
  EXPECT_TRUE(arguments.quiet);
  EXPECT_FALSE(arguments.with_truth);
  EXPECT_EQ(arguments.last_stage, LastStage::kEnd);
  EXPECT_EQ(arguments.inputTopic("scan"), "/front");
  EXPECT_EQ(arguments.inputTopic("odometry"), "/odometry");
}

TEST(RunBagArguments, UnknownWordsAreRefused) {
  EXPECT_THROW(parseArguments({}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "b.bag"}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "b.bag", "--config"}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "b.bag", "--config", "c.yaml", "--fast"}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "a.bag", "--config", "c.yaml"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "c", "--config", "c.yaml"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c.yaml", "pose:=/x"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c.yaml", "--until", "slam"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c.yaml", "--times", "b"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c", "--tum", "t", "--mot", "t"}), UsageError);
  EXPECT_EQ(parseArguments({"a", "b", "--config", "c", "--until", "grid_slam"}).last_stage,
            LastStage::kGridSlam);
}

std::string untilError(std::vector<std::string> options) {
  options.insert(options.begin(), {"a.bag", "b.bag", "--config", "c.yaml"});
  try {
    parseArguments(options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(RunBagArguments, TheStagesAreListedWhereTheyAreRefused) {
  EXPECT_EQ(untilError({"--until", "slam"}),
            "--until 'slam': expected grid_fusion, grid_slam, loop_closing, road_border, "
            "moving_objects, object_fusion, tracker, track_fusion or risk");
  EXPECT_EQ(untilError({"--until", "grid_fusion"}),
            "--until grid_fusion: expected --low-level-fusion with it");
  EXPECT_EQ(untilError({"--track-fusion", "--until", "moving_objects"}),
            "--track-fusion: expected no --until before tracker");
  EXPECT_EQ(untilError({"--radar", "--until", "moving_objects"}),
            "--radar: expected no --until before object_fusion");
  EXPECT_EQ(untilError({"--map-fusion", "--until", "grid_slam"}),
            "--map-fusion: expected no --until before loop_closing");
  EXPECT_EQ(untilError({"--map-fusion", "--loop-closing", "--until", "loop_closing"}), "");
  for (const char* always : {"grid_slam", "moving_objects", "tracker"}) {
    EXPECT_EQ(untilError({"--until", always}), "");
  }
}

TEST(RunBagArguments, TheHelpListsTheStages) {
  try {
    parseArguments({"--help"});
    FAIL();
  } catch (const Answer& help) {
    for (const char* line : {"stops after grid_fusion, grid_slam, loop_closing, road_border,\n",
                             " moving_objects, object_fusion, tracker, track_fusion or risk\n"}) {
      EXPECT_TRUE(holds(help.what(), line)) << help.what();
    }
  }
}

TEST(StageTimes, SummariesComeInTheOrderOfTheFirstRuns) {
  StageTimes times;
  times.add("b", 3.0);
  times.add("a", 1.0);
  times.add("b", 1.0);
  times.add("b", 2.0);
  const auto summaries = times.summaries();
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_EQ(summaries[0].stage, "b");
  EXPECT_EQ(summaries[0].runs, 3U);
  EXPECT_DOUBLE_EQ(summaries[0].mean, 2.0);
  EXPECT_DOUBLE_EQ(summaries[0].median, 2.0);
  EXPECT_DOUBLE_EQ(summaries[0].percentile_99, 3.0);
  EXPECT_EQ(summaries[1].stage, "a");
}

}  // namespace
}  // namespace datmo::run_bag_test
