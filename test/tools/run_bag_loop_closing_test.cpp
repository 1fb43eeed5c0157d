// SPDX-License-Identifier: BSD-3-Clause
// run_bag --loop-closing.
#include "run_bag_drive.h"
#include <nlohmann/json.hpp>

#include <nav_msgs/Path.h>

#include "datmo_fusion/common/options.h"

namespace datmo::run_bag_loop_closing_test {
namespace {

class RunBagLoopClosing : public RunBag {
 protected:
  RunBagLoopClosing() {
    arguments_.loop_closing = true;
    arguments_.last_stage = LastStage::kLoopClosing;
  }

  static Arguments parsed(const std::vector<std::string>& more) {
    std::vector<std::string> words{"a", "b", "--config", "c"};
    words.insert(words.end(), more.begin(), more.end());
    return parseArguments(words);
  }
};

TEST_F(RunBagLoopClosing, TheWholeDriveIsPublishedAtItsEnd) {
  run();
  rosbag::Bag bag(arguments_.output);
  nav_msgs::PathConstPtr path;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/trajectory/optimized"))) {
    path = message.instantiate<nav_msgs::Path>();
  }
  ASSERT_TRUE(path);
  EXPECT_EQ(path->poses.size(), static_cast<std::size_t>(kScans));
  EXPECT_NEAR(path->poses.back().pose.position.x, kSpeed * kPeriod * (kScans - 1), 0.2);
  EXPECT_GE(count(arguments_.output, "/map/optimized"), 1U);
}

TEST_F(RunBagLoopClosing, TheReportNamesTheLoops) {
  arguments_.report = path("report.json");
  run();
  const auto report = nlohmann::json::parse(bytes(arguments_.report));
  EXPECT_TRUE(report.at("loops").at("closed").empty()) << "straight on there is none";
  EXPECT_EQ(report.at("loops").at("refuted"), 0);
}

TEST_F(RunBagLoopClosing, SameBagGivesTheSameBytes) {
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_EQ(bytes(arguments_.output), first);
}

TEST_F(RunBagLoopClosing, TheLivePoseAndMapAreUnchanged) {
  const auto live = [this] {
    run();
    std::ostringstream all;
    rosbag::Bag bag(arguments_.output);
    const std::vector<std::string> topics{"/pose", "/map", "/labeled_scan"};
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topics))) {
      std::string content(message.size(), '\0');
      ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&content[0]),
                                         message.size());
      message.write(stream);
      all << message.getTopic() << content;
    }
    return all.str();
  };
  const std::string with = live();
  arguments_.loop_closing = false;
  arguments_.last_stage = LastStage::kGridSlam;
  EXPECT_EQ(live(), with);
}

TEST_F(RunBagLoopClosing, TheOptimizedMapIsSaved) {
  arguments_.save_map = path("street.map");
  run();
  EXPECT_GT(std::filesystem::file_size(path("street.map")), 100U);
}

TEST_F(RunBagLoopClosing, TheLastStageMustNotPrecedeIt) {
  EXPECT_TRUE(parsed({"--loop-closing", "--until", "loop_closing"}).loop_closing);
  EXPECT_THROW(parsed({"--until", "loop_closing"}), UsageError);
  EXPECT_THROW(parsed({"--loop-closing", "--until", "grid_slam"}), UsageError);
  EXPECT_NO_THROW(parsed({"--loop-closing", "--until", "moving_objects"}));
}

}  // namespace
}  // namespace datmo::run_bag_loop_closing_test
