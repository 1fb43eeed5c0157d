// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/loop_closing_stage.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "monitor_counts.h"
#include "slam/drift_drive.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/map_files.h"

namespace datmo::loop_closing_stage_test {
namespace {

constexpr double kStep = 0.2;  // s

LoopClosingStageOptions stageOptions() {
  LoopClosingStageOptions options;
  options.loops = yardOptions();
  return options;
}

/// Drives laps around the yard with a drifting live pose, through a stage.
class LoopClosingStageTest : public testing::Test {
 protected:
  static LabeledScanMessage message(const Pose2& truth, const Pose2& live, double seconds) {
    return toMessage(labeled(Yard().scan(truth, seconds), live), "base_link", "map");
  }

  tf2_msgs::TFMessageConstPtr take(LoopClosingStage& stage, const LabeledScanMessage& scan) const {
    return stage.handleLabeledScan(scan, toStamp(scan.header.stamp));
  }

  /// Returns the last map -> global_map.
  tf2_msgs::TFMessageConstPtr drive(LoopClosingStage& stage, bool waits = false) {
    truth_ = roundTheYard(2);
    Pose2 live = truth_.front();
    tf2_msgs::TFMessageConstPtr last;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      live = i == 0 ? live : live * drifting(truth_[i - 1].inverse() * truth_[i]);
      now_ = kStep * static_cast<double>(i);
      last = take(stage, message(truth_[i], live, now_));
      if (waits) {
        stage.waitUntilIdle();
      }
    }
    live_ = live;
    return last;
  }

  std::optional<OptimizedDrive> result(LoopClosingStage& stage) const {
    return stage.next(Stamp::fromSeconds(1000.0 + now_ + stage.maxWait()));
  }

  /// The frame `map` in `global_map`.
  static Pose2 correctionOf(const tf2_msgs::TFMessage& transforms) {
    const geometry_msgs::Transform& transform = transforms.transforms.at(0).transform;
    geometry_msgs::Pose pose;
    pose.position.x = transform.translation.x;
    pose.position.y = transform.translation.y;
    pose.orientation = transform.rotation;
    return fromMessage(pose).inverse();
  }

  double endError(const nav_msgs::Path& path) const {
    const Pose2 end = fromMessage(path.poses.back().pose);
    return (end.position() - truth_.back().position()).norm();
  }

  StageMonitor monitor_{"loop_closing"};
  std::vector<Pose2> truth_;
  Pose2 live_;
  double now_ = 0.0;
};

TEST_F(LoopClosingStageTest, TheDriftOfADriveWithALoopIsRemoved) {
  LoopClosingStage stage(stageOptions(), monitor_);
  drive(stage);
  const auto optimized = result(stage);
  ASSERT_TRUE(optimized);
  EXPECT_EQ(optimized->trajectory->header.frame_id, "global_map");
  EXPECT_EQ(optimized->trajectory->poses.size(), truth_.size());
  EXPECT_LT(endError(*optimized->trajectory), 0.3);
  EXPECT_GT((live_.position() - truth_.back().position()).norm(), 1.0);
  EXPECT_EQ(optimized->map->header.frame_id, "global_map");
  EXPECT_GT(optimized->map->data.size(), 10000U);
  EXPECT_GT(monitor_.figures().at("loops closed"), 1.0);
  EXPECT_EQ(monitor_.figures().at("trajectories started"), 1.0);
  EXPECT_FALSE(stage.next(Stamp::fromSeconds(9000.0))) << "nothing has changed since";
}

TEST_F(LoopClosingStageTest, TheSameDriveGivesTheSame) {
  std::vector<nav_msgs::Path> paths;
  for (int run = 0; run < 2; ++run) {
    LoopClosingStage stage(stageOptions(), monitor_);
    drive(stage);
    paths.push_back(*result(stage)->trajectory);
  }
  ASSERT_EQ(paths[0].poses.size(), paths[1].poses.size());
  for (std::size_t i = 0; i < paths[0].poses.size(); ++i) {
    EXPECT_EQ(paths[0].poses[i].pose, paths[1].poses[i].pose);
  }
}

TEST_F(LoopClosingStageTest, TheGlobalFrameIsAChildOfTheMapAndMovesGradually) {
  const LoopClosingStageOptions options = stageOptions();
  LoopClosingStage stage(options, monitor_);
  truth_ = roundTheYard(2);
  Pose2 live = truth_.front();
  Pose2 correction;
  double max_correction = 0.0;
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    live = i == 0 ? live : live * drifting(truth_[i - 1].inverse() * truth_[i]);
    const auto transforms = take(stage, message(truth_[i], live, kStep * static_cast<double>(i)));
    ASSERT_TRUE(transforms);
    ASSERT_EQ(transforms->transforms.at(0).header.frame_id, "map");
    ASSERT_EQ(transforms->transforms.at(0).child_frame_id, "global_map");
    const Pose2 now = correctionOf(*transforms);
    const Point2 step = (now * live).position() - (correction * live).position();
    EXPECT_LE(step.norm(), kStep * options.correction.speed + 1e-6) << "at the vehicle";
    max_correction = std::max(max_correction, ((now * live).position() - live.position()).norm());
    correction = now;
  }
  EXPECT_GT(max_correction, 0.5);
}

TEST_F(LoopClosingStageTest, ASeparateThreadGivesTheSame) {
  LoopClosingStage stage(stageOptions(), monitor_, [] { return 0.0; });
  drive(stage, true);
  result(stage);  // gives the thread the remaining input
  stage.waitUntilIdle();
  auto optimized = result(stage);
  for (int i = 0; i < 3 && !optimized; ++i) {
    stage.waitUntilIdle();
    optimized = result(stage);
  }
  ASSERT_TRUE(optimized);
  EXPECT_LT(endError(*optimized->trajectory), 0.3);
}

TEST_F(LoopClosingStageTest, PendingWorkOfTheThreadIsDoneInParts) {
  LoopClosingStage stage(stageOptions(), monitor_, [] { return 0.0; });
  drive(stage);  // faster than the thread
  std::optional<OptimizedDrive> last;
  for (int i = 0; i < 20 && (!last || last->trajectory->poses.size() < truth_.size()); ++i) {
    stage.waitUntilIdle();
    now_ += stage.maxWait();
    const auto optimized = result(stage);
    last = optimized ? optimized : last;
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->trajectory->poses.size(), truth_.size());
  EXPECT_LT(endError(*last->trajectory), 0.3);
}

TEST_F(LoopClosingStageTest, ADriveStartedWhileTheThreadWorksIgnoresTheOldOne) {
  LoopClosingStage stage(stageOptions(), monitor_, [] { return 0.0; });
  drive(stage);
  const auto transforms = take(stage, message(Pose2(), Pose2(), -500.0));
  ASSERT_TRUE(transforms);
  EXPECT_EQ(correctionOf(*transforms).position().norm(), 0.0);
  std::optional<OptimizedDrive> last;
  now_ = -500.0;
  for (int i = 0; i < 20 && !last; ++i) {
    stage.waitUntilIdle();
    now_ += stage.maxWait();
    last = result(stage);
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->trajectory->poses.size(), 1U);
  EXPECT_TRUE(stage.loops().empty());
}

TEST_F(LoopClosingStageTest, ADriveTooWideForAMapHasItsTrajectory) {
  LoopCloser closer(yardOptions());
  LoopJob job;
  job.wants_results = true;
  const Scan scan = Yard().scan(Pose2(), 0.0);
  for (const double x : {0.0, 1e5}) {
    const LabeledScan kept = labeled(scan, Pose2(x, x, 0.0));
    job.steps.push_back(
        {KeyframeSelector::Use::kKeyframe, {scan.stamp, kept.base_in_map, KeptScan(kept)}});
  }
  const LoopResult wide = closeLoops(closer, job);
  EXPECT_NE(wide.error, "");
  EXPECT_EQ(wide.trajectory.size(), 2U);
  EXPECT_FALSE(wide.map);
  EXPECT_EQ(wide.keyframes, 2U) << "nothing is forgotten";
}

TEST_F(LoopClosingStageTest, AClockJumpBackStartsANewTrajectory) {
  LoopClosingStage stage(stageOptions(), monitor_);
  drive(stage);
  const auto transforms = take(stage, message(Pose2(), Pose2(), -500.0));
  ASSERT_TRUE(transforms);
  EXPECT_EQ(transforms->transforms.at(0).transform.translation.x, 0.0);
  EXPECT_EQ(monitor_.figures().at("trajectories started"), 2.0);
  EXPECT_EQ(monitor_.figures().at("keyframes"), 1.0);
  EXPECT_NE(monitor_.healthReason().find("new trajectory"), std::string::npos);
}

TEST_F(LoopClosingStageTest, ANewMapOfTheSlamStartsANewTrajectory) {
  LoopClosingStage stage(stageOptions(), monitor_);
  drive(stage);
  LabeledScan lost = labeled(Yard().scan(Pose2(), now_ + 1.0), Pose2());
  lost.base_in_map.covariance = Eigen::Vector3d(100.0, 100.0, 1.0).asDiagonal();
  take(stage, toMessage(lost, "base_link", "map"));
  EXPECT_EQ(monitor_.figures().at("trajectories started"), 1.0) << "it may be found again";
  lost.stamp = lost.stamp + stageOptions().keyframes.new_map_after;
  take(stage, toMessage(lost, "base_link", "map"));
  EXPECT_EQ(monitor_.figures().at("trajectories started"), 2.0);
}

TEST_F(LoopClosingStageTest, BadScansAreDroppedAndCounted) {
  LoopClosingStage stage(stageOptions(), monitor_);
  LabeledScanMessage scan = message(Pose2(), Pose2(), 0.0);
  scan.map_frame = "elsewhere";
  EXPECT_FALSE(take(stage, scan));
  EXPECT_EQ(samples::drops(monitor_, "wrong_frame"), 1U);
  EXPECT_TRUE(take(stage, message(Pose2(), Pose2(), 1.0)));
  EXPECT_FALSE(take(stage, message(Pose2(), Pose2(), 0.9)));
  EXPECT_EQ(samples::drops(monitor_, "old_stamp"), 1U);
}

TEST_F(LoopClosingStageTest, TheOptimizedMapIsSaved) {
  LoopClosingStage stage(stageOptions(), monitor_);
  const std::string file = std::filesystem::temp_directory_path() /
                           ("loop_closing_" + std::to_string(getpid()) + ".map");
  EXPECT_THROW(stage.saveMap(file), MapFileError) << "none yet";
  drive(stage);
  ASSERT_TRUE(result(stage));
  stage.saveMap(file);
  EXPECT_FALSE(readMap(file, stageOptions().loops.submaps.map).evidence().cells.empty());
  for (const std::string& each : {file, mapServerNames(file).yaml, mapServerNames(file).image}) {
    std::filesystem::remove(each);
  }
}

TEST_F(LoopClosingStageTest, TheGlobalFramesNameIsAnOption) {
  LoopClosingStageOptions options;
  options.global_frame = "map";
  EXPECT_THROW(LoopClosingStage(options, monitor_), OptionError);
}

}  // namespace
}  // namespace datmo::loop_closing_stage_test
