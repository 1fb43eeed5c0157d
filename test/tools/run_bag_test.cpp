// The bag runner on a small drive that is written here: a car between two walls, at 5 m/s
// towards a third.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "input_bag.h"
#include "interruption.h"
#include "run_bag/bag_run.h"
#include "run_bag/stage_times.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/message_conversion.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {
namespace {

constexpr double kSpeed = 5.0;    // m/s
constexpr double kPeriod = 0.06;  // s
constexpr int kScans = 30;
constexpr double kWall = 6.0;  // m, left and right
constexpr double kEnd = 25.0;  // m, ahead of where it starts

const Stamp kStart = Stamp::fromSeconds(1000.0);

sensor_msgs::LaserScan scanAt(Stamp stamp) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = toTime(stamp);
  scan.header.frame_id = "scanner";
  scan.angle_min = static_cast<float>(degrees(-80.0));
  scan.angle_increment = static_cast<float>(degrees(2.0));
  scan.angle_max = static_cast<float>(degrees(80.0));
  scan.range_min = 0.5F;
  scan.range_max = 50.0F;
  for (int beam = 0; beam <= 80; ++beam) {
    const double bearing = degrees(-80.0 + 2.0 * beam);
    const double to_side = kWall / std::abs(std::sin(bearing));
    const double to_end = (kEnd - kSpeed * secondsBetween(kStart, stamp)) / std::cos(bearing);
    scan.ranges.push_back(static_cast<float>(std::min(to_side, to_end)));
  }
  return scan;
}

nav_msgs::Odometry odometryAt(Stamp stamp) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = toTime(stamp);
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  odometry.pose.pose = toMessage(Pose2(kSpeed * secondsBetween(kStart, stamp), 0.0, 0.0));
  odometry.twist.twist.linear.x = kSpeed;
  return odometry;
}

tf2_msgs::TFMessage transform(const Pose2& pose, Stamp stamp, const std::string& parent,
                              const std::string& child) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(toTransform(pose, stamp, parent, child));
  return message;
}

/// A folder of its own for each test, with a drive and a sensor set in it.
class RunBag : public testing::Test {
 protected:
  RunBag()
      : folder_(std::filesystem::temp_directory_path() /
                (std::string("run_bag_test_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    arguments_.input = path("in.bag");
    arguments_.output = path("out.bag");
    arguments_.config = path("sensors.yaml");
    writeConfig("grid_slam: {map_period: 0.5}\n");
    writeDrive();
  }
  ~RunBag() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void writeConfig(const std::string& text) const { std::ofstream(arguments_.config) << text; }

  void writeDrive(bool with_mount = true) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      const ros::Time time = toTime(stamp);
      const nav_msgs::Odometry odometry = odometryAt(stamp);
      bag.write("/odometry", time, odometry);
      bag.write("/tf", time,
                transform(fromMessage(odometry.pose.pose), stamp, "odom", "base_link"));
      bag.write("/scan", time, scanAt(stamp));
      bag.write("/ground_truth/pose", time, odometry);
    }
    if (with_mount) {
      bag.write("/tf_static", toTime(kStart + 1.0),
                transform(Pose2(2.0, 0.0, 0.0), kStart, "base_link", "scanner"));
    }
  }

  std::string run() const {
    std::ostringstream out;
    runBag(arguments_, out, nullptr);
    return out.str();
  }

  /// The message of the exception that runBag throws; none of the output is left then.
  std::string failure() const {
    std::string message = "no exception";
    try {
      run();
    } catch (const std::exception& error) {
      message = error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(arguments_.output));
    EXPECT_FALSE(std::filesystem::exists(arguments_.output + ".part"));
    return message;
  }

  static std::string bytes(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
  }

  static std::size_t count(const std::string& file, const std::string& topic) {
    rosbag::Bag bag(file);
    return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
  }

  std::filesystem::path folder_;
  Arguments arguments_;
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(RunBag, EveryScanLeadsToResults) {
  const std::string table = run();
  for (const char* topic : {"/pose", "/split_scan", "/objects", "/tracks", "/tf"}) {
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

TEST_F(RunBag, SameBagGivesTheSameBytes) {
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(RunBag, GroundTruthIsCopiedOnDemand) {
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

TEST_F(RunBag, TimesOfTheStagesAreWrittenOnDemand) {
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

TEST_F(RunBag, BagThatIsCutShortIsNamed) {
  std::filesystem::resize_file(arguments_.input, std::filesystem::file_size(arguments_.input) / 2);
  EXPECT_TRUE(holds(failure(), arguments_.input));
}

TEST_F(RunBag, FileThatIsNoBagIsNamed) {
  std::ofstream(arguments_.input) << "not a bag";
  EXPECT_TRUE(holds(failure(), arguments_.input + ": cannot be read as a bag"));
}

TEST_F(RunBag, MissingScanIsNamedBesideWhatThereIs) {
  arguments_.remappings["/scan"] = "/front";
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/front")) << message;
  EXPECT_TRUE(holds(message, "/scan (sensor_msgs/LaserScan)")) << message;
}

TEST_F(RunBag, MissingOdometryIsAnErrorUnlessTheOptionsSaySo) {
  arguments_.remappings["/odometry"] = "/wheels";
  EXPECT_TRUE(holds(failure(), "no odometry on /wheels"));
  writeConfig("grid_slam: {odometry: false}\n");
  EXPECT_NO_THROW(run());
}

TEST_F(RunBag, TopicOfAnotherTypeIsNamed) {
  arguments_.remappings["/odometry"] = "/tf_static";
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/tf_static is tf2_msgs/TFMessage, expected nav_msgs/Odometry"))
      << message;
}

TEST_F(RunBag, MissingMountLeavesNoScan) {
  writeDrive(false);
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "no scan could be used")) << message;
  EXPECT_TRUE(holds(message, "base_link -> scanner")) << message;
}

TEST_F(RunBag, MisspeltKeyIsNamedWithItsSection) {
  writeConfig("grid_slam: {map_perod: 1.0}\n");
  const std::string message = failure();
  EXPECT_TRUE(holds(message, arguments_.config + ": grid_slam: map_perod")) << message;
}

TEST_F(RunBag, UnknownSectionIsNamed) {
  writeConfig("grid_slm: {map_period: 1.0}\n");
  EXPECT_TRUE(holds(failure(), arguments_.config + ": grid_slm"));
}

TEST_F(RunBag, InterruptionLeavesNoBag) {
  writeDrive();
  noteInterruptions();
  std::raise(SIGINT);
  EXPECT_TRUE(holds(failure(), "interrupted"));
  noteInterruptions();
  EXPECT_FALSE(run().empty());
}

TEST_F(RunBag, FolderIsNoBagToWrite) {
  writeDrive();
  std::filesystem::create_directory(arguments_.output);
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_directory(arguments_.output));
  EXPECT_FALSE(std::filesystem::exists(arguments_.output + ".part"));
}

TEST_F(RunBag, InputIsNotOverwrittenUnderWhateverName) {
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
  EXPECT_EQ(arguments.last_stage, LastStage::kTracker);
  EXPECT_EQ(arguments.inputTopic("scan"), "/front");
  EXPECT_EQ(arguments.inputTopic("odometry"), "/odometry");
}

TEST(RunBagArguments, WhatIsNotUnderstoodIsRefused) {
  EXPECT_THROW(parseArguments({}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "b.bag"}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "b.bag", "--config"}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "b.bag", "--config", "c.yaml", "--fast"}), UsageError);
  EXPECT_THROW(parseArguments({"a.bag", "a.bag", "--config", "c.yaml"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "c", "--config", "c.yaml"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c.yaml", "pose:=/x"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c.yaml", "--until", "slam"}), UsageError);
  EXPECT_THROW(parseArguments({"a", "b", "--config", "c.yaml", "--times", "b"}), UsageError);
  EXPECT_EQ(parseArguments({"a", "b", "--config", "c", "--until", "grid_slam"}).last_stage,
            LastStage::kGridSlam);
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
}  // namespace datmo
