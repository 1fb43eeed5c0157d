// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stack_health.h"

#include <gtest/gtest.h>

namespace datmo::stack_health_test {
namespace {

StageState stage(const std::string& name, HealthLevel level, const StageTopics& topics,
                 const std::string& fault) {
  return {name, level, {fault}, topics};
}

TEST(StackHealth, TheMostUpstreamStageIsNamed) {
  const StackHealth health = stackHealth(
      {stage("slam", HealthLevel::kNoOutput, {{"/scan"}, {"/pose"}}, "no scan yet"),
       stage("tracker", HealthLevel::kNoOutput, {{"/pose"}, {"/tracks"}}, "no pose yet")},
      "/tracks");
  EXPECT_EQ(health.sentence, "no tracks: slam: no scan yet");
}

TEST(StackHealth, ARestartIsReportedForAWhile) {
  const StackHealth good{HealthLevel::kOk, "tracks are published"};
  const StackHealth bad{HealthLevel::kNoOutput, "no tracks: slam: no scan yet"};
  EXPECT_EQ(withRestart(good, 1, 1.0).level, HealthLevel::kDegraded);
  EXPECT_EQ(withRestart(good, 1, 1.0).sentence.rfind("tracks are published (restarted", 0), 0U);
  EXPECT_EQ(withRestart(bad, 2, 1.0).level, HealthLevel::kNoOutput);
  EXPECT_EQ(withRestart(good, 1, kRestartReported + 1.0).sentence, good.sentence);
  EXPECT_EQ(withRestart(good, 0, 1.0).sentence, good.sentence);
}

TEST(ReportingStages, AStageThatStopsReportingIsForgotten) {
  ReportingStages stages;
  stages.update(stage("slam", HealthLevel::kNoOutput, {{"/scan"}, {"/pose"}}, "no scan yet"), 10.0);
  stages.update(stage("tracker", HealthLevel::kOk, {{"/pose"}, {"/tracks"}}, ""), 10.0);
  EXPECT_EQ(stages.at(14.0).size(), 2U);
  stages.update(stage("tracker", HealthLevel::kOk, {{"/pose"}, {"/tracks"}}, ""), 14.0);
  ASSERT_EQ(stages.at(21.0).size(), 1U);
  EXPECT_EQ(stackHealth(stages.at(21.0), "/tracks").level, HealthLevel::kOk);
}

}  // namespace
}  // namespace datmo::stack_health_test
