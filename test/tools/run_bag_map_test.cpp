// SPDX-License-Identifier: BSD-3-Clause
// Maps that run_bag saves, and those that it starts in.
#include "run_bag_drive.h"

#include "datmo_fusion/common/options.h"

namespace datmo::run_bag_map_test {
namespace {

class RunBagMap : public RunBag {
 protected:
  RunBagMap() { arguments_.last_stage = LastStage::kGridSlam; }

  /// A map of the drive.
  std::string savedMap() {
    arguments_.save_map = path("street.map");
    run();
    arguments_.save_map.clear();
    return path("street.map");
  }

  geometry_msgs::PoseWithCovariance lastPose(const std::string& topic = "/pose") const {
    rosbag::Bag bag(arguments_.output);
    geometry_msgs::PoseWithCovariance last;
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      last = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()->pose;
    }
    return last;
  }
};

TEST_F(RunBagMap, TheMapIsSavedWithTheFilesOfMapServer) {
  const std::string map = savedMap();
  for (const char* name : {"street.map", "street.yaml", "street.pgm"}) {
    EXPECT_GT(std::filesystem::file_size(path(name)), 100U) << name;
  }
  const std::string first = bytes(map);
  EXPECT_EQ(bytes(savedMap()), first);
}

TEST_F(RunBagMap, BeforeLocalizationPosesAreRelativeToTheStart) {
  arguments_.map = savedMap();
  arguments_.start = {0.5, 0.2, 2.0};
  run();
  const geometry_msgs::PoseWithCovariance pose = lastPose();
  const Pose2 expected =
      Pose2(0.5, 0.2, degrees(2.0)) * Pose2(kSpeed * kPeriod * (kScans - 1), 0, 0);
  EXPECT_NEAR(pose.pose.position.x, expected.x(), 0.2);
  EXPECT_NEAR(pose.pose.position.y, expected.y(), 0.2);
  EXPECT_NEAR(lastPose("/pose/local").covariance[0], 1.0, 0.1);
  EXPECT_GT(pose.covariance[0], 1.0) << "the map that is made meanwhile drifts";
}

TEST_F(RunBagMap, GlobalSearchTakesLongerThanThisDrive) {
  arguments_.map = savedMap();
  run();
  EXPECT_GT(lastPose().covariance[0], 25.0) << "lost, and says so";
}

TEST_F(RunBagMap, ABadMapEndsItWithOneSentence) {
  const std::string map = savedMap();
  std::filesystem::remove(arguments_.output);
  arguments_.map = path("none.map");
  EXPECT_TRUE(
      holds(failure(), "none.map: no such file, expected the absolute path of a saved map"));
  arguments_.map = map;
  writeConfig("grid_slam: {map: {cell_size: 0.2}}\n");
  EXPECT_TRUE(holds(failure(), "cells of 0.3 m, expected 0.2 m"));
}

TEST_F(RunBagMap, FilesWrittenBesideTheMapMustNotBeInputs) {
  writeConfig("scanner: {range_sigma: 0.1}\n");
  const std::string map =
      std::filesystem::path(arguments_.config).replace_extension(".map").string();
  EXPECT_THROW(
      parseArguments({"in.bag", "out.bag", "--config", arguments_.config, "--save-map", map}),
      UsageError);
}

TEST_F(RunBagMap, WithoutGridSlamThereIsNoMap) {
  for (const char* option : {"--map", "--save-map"}) {
    EXPECT_THROW(parseArguments({"in.bag", "out.bag", "--config", "c.yaml", "--low-level-fusion",
                                 "--until", "grid_fusion", option, "a.map"}),
                 OptionError);
  }
  EXPECT_THROW(
      parseArguments({"in.bag", "out.bag", "--config", "c.yaml", "--start", "1", "2", "3"}),
      OptionError);
  EXPECT_EQ(parseArguments({"in.bag", "out.bag", "--config", "c.yaml", "--map", "a.map", "--start",
                            "1", "-2", "90"})
                .start,
            (std::vector<double>{1.0, -2.0, 90.0}));
}

}  // namespace
}  // namespace datmo::run_bag_map_test
