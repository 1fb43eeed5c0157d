// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_health.h"

#include <map>

#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stack_health.h"

namespace datmo::stage_health_test {
namespace {

Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

/// A stage that subscribes to scans or echoes, and to odometry.
class StageHealthTest : public testing::Test {
 protected:
  StageState judge(double seconds) {
    return health_.judge(monitor_, at(seconds), [this](const std::string& topic) {
      const auto found = published_.find(topic);
      return found == published_.end() ? std::string() : found->second;
    });
  }

  void receiveAll(double seconds) {
    monitor_.received("scan", at(seconds));
    monitor_.received("odometry", at(seconds));
  }

  void process(double seconds) { monitor_.processed({at(seconds), 0.001}); }

  std::map<std::string, std::string> published_;
  StageMonitor monitor_{"grid_slam"};
  StageHealth health_{
      {{"scan",
        {{"/scan", "sensor_msgs/LaserScan"}, {"/echoes", "sensor_msgs/MultiEchoLaserScan"}}},
       {"odometry", {{"/odom", "nav_msgs/Odometry"}}}},
      1.0};
};

TEST_F(StageHealthTest, ARunningOneHasNoFaults) {
  receiveAll(100.0);
  process(100.0);
  const StageState state = judge(100.5);
  EXPECT_EQ(state.level, HealthLevel::kOk);
  EXPECT_TRUE(state.faults.empty());
}

TEST_F(StageHealthTest, AnUnpublishedInputMeansNoOutput) {
  const StageState state = judge(100.0);
  EXPECT_EQ(state.level, HealthLevel::kNoOutput);
  ASSERT_EQ(state.faults.size(), 2U);
  EXPECT_EQ(state.faults[0], "no scan yet: it has no publisher (scan on /scan or /echoes)");
  EXPECT_EQ(state.faults[1], "no odometry yet: it has no publisher (odometry on /odom)");
}

TEST_F(StageHealthTest, AWrongTypeIsReportedWithBothTypes) {
  published_ = {{"/scan", "sensor_msgs/PointCloud2"}, {"/odom", "geometry_msgs/TwistStamped"}};
  const StageState state = judge(100.0);
  EXPECT_EQ(
      state.faults[0],
      "no scan yet: it is published as sensor_msgs/PointCloud2, expected sensor_msgs/LaserScan "
      "(scan on /scan or /echoes)");
  EXPECT_EQ(state.faults[1],
            "no odometry yet: it is published as geometry_msgs/TwistStamped, expected "
            "nav_msgs/Odometry (odometry on /odom)");
}

TEST_F(StageHealthTest, ASilentPublisherIsNotMissing) {
  published_ = {{"/echoes", "sensor_msgs/MultiEchoLaserScan"}};
  EXPECT_EQ(
      judge(100.0).faults[0],
      "no scan yet: it is published, but no message has been received (scan on /scan or /echoes)");
}

TEST_F(StageHealthTest, AFaultWithResultsIsDegraded) {
  receiveAll(100.0);
  monitor_.received("scan", at(102.0));
  process(102.0);
  const StageState state = judge(102.5);
  EXPECT_EQ(state.level, HealthLevel::kDegraded);
  EXPECT_EQ(state.faults, std::vector<std::string>{"no odometry for 2.5 s"});
  EXPECT_EQ(judge(104.0).level, HealthLevel::kNoOutput) << "no result for longer than a second";
}

TEST_F(StageHealthTest, ATotalDropComesFirst) {
  monitor_.received("scan", at(100.0));
  monitor_.dropped(InputError("missing_transform", "no tf base_link -> laser"));
  monitor_.warned(InputError("tilt", "tilted"));
  const StageState state = judge(100.1);
  EXPECT_EQ(state.level, HealthLevel::kNoOutput);
  ASSERT_EQ(state.faults.size(), 3U);
  EXPECT_EQ(state.faults[0], "no tf base_link -> laser");
  EXPECT_EQ(state.faults[2], "tilted");
  EXPECT_EQ(judge(100.2).faults.size(), 1U) << "drops and warnings are judged once";
}

StageState stage(const std::string& name, HealthLevel level, const std::string& fault,
                 std::vector<std::string> inputs, std::vector<std::string> outputs) {
  StageState state{name, level, {}, {std::move(inputs), std::move(outputs)}};
  if (!fault.empty()) {
    state.faults = {fault};
  }
  return state;
}

TEST(StackHealth, TheFirstCauseInTheChainIsReported) {
  const std::vector<StageState> stages{
      stage("tracker", HealthLevel::kNoOutput, "no objects for 2.0 s", {"/objects"}, {"/tracks"}),
      stage("moving_objects", HealthLevel::kNoOutput, "no labeled_scan yet", {"/labeled_scan"},
            {"/objects"}),
      stage("grid_slam", HealthLevel::kNoOutput, "no tf base_link -> laser", {"/odom", "/scan"},
            {"/labeled_scan", "/pose"})};
  const StackHealth health = stackHealth(stages, "/tracks");
  EXPECT_EQ(health.level, HealthLevel::kNoOutput);
  EXPECT_EQ(health.sentence, "no tracks: grid_slam: no tf base_link -> laser");
}

TEST(StackHealth, ADegradedStageDoesNotCauseMissingOutput) {
  const std::vector<StageState> stages{
      stage("grid_slam", HealthLevel::kDegraded, "no odometry for 1.1 s", {"/odom"},
            {"/labeled_scan"}),
      stage("tracker", HealthLevel::kNoOutput, "no tf", {"/labeled_scan"}, {"/tracks"})};
  EXPECT_EQ(stackHealth(stages, "/tracks").sentence, "no tracks: tracker: no tf");
}

TEST(StackHealth, LessThanAllNamesTheFirstFault) {
  const std::vector<StageState> stages{
      stage("stereo_grid", HealthLevel::kNoOutput, "no points2 for 3.0 s", {}, {"/grids/stereo"}),
      stage("tracker", HealthLevel::kOk, "", {"/grids/stereo"}, {"/tracks"})};
  const StackHealth health = stackHealth(stages, "/tracks");
  EXPECT_EQ(health.level, HealthLevel::kDegraded);
  EXPECT_EQ(health.sentence, "degraded: stereo_grid: no points2 for 3.0 s");
}

TEST(StackHealth, HealthyOnesAreReportedInTwoWords) {
  EXPECT_EQ(
      stackHealth({stage("tracker", HealthLevel::kOk, "", {}, {"/tracks"})}, "/tracks").sentence,
      "tracks are published");
}

TEST(StackHealth, AStageThatHasNotReportedIsNamedByItsOutput) {
  EXPECT_EQ(stackHealth({}, "/tracks").sentence,
            "no tracks: no stage that publishes them has reported");
}

TEST(StackHealth, ACycleEnds) {
  const std::vector<StageState> stages{
      stage("one", HealthLevel::kNoOutput, "no b", {"/b"}, {"/a"}),
      stage("other", HealthLevel::kNoOutput, "no a", {"/a"}, {"/b"})};
  EXPECT_EQ(stackHealth(stages, "/a").sentence, "no a: other: no a");
}

}  // namespace
}  // namespace datmo::stage_health_test
