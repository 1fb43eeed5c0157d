// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/part_clocks.h"

#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::part_clocks_test {
namespace {

constexpr double kNow = 1000.0;  // s

/// Asked at kNow, answered after 1 ms by a clock that is `ahead` (s).
PartClock answerOf(const std::string& process, double ahead) {
  PartClock answer;
  answer.process = process;
  answer.asked = ros::Time(kNow);
  answer.answered = ros::Time(kNow + 0.001 + ahead);
  return answer;
}

PartClocks with(const std::string& process, double ahead) {
  PartClocks clocks((PartClocksOptions()));
  clocks.addAnswer(answerOf(process, ahead), Stamp::fromSeconds(kNow + 0.002));
  return clocks;
}

StackHealth judgedNow(const PartClocks& clocks, const StackHealth& health) {
  return clocks.judged(health, Stamp::fromSeconds(kNow + 0.002));
}

TEST(PartClocks, EachIsDescribed) {
  PartClocks clocks = with("/perception_stereo", 0.004);
  clocks.addAnswer(answerOf("/perception_sensors", -0.003), Stamp::fromSeconds(kNow + 0.002));
  const std::map<std::string, std::string> expected{{"perception_sensors", "3.0 +- 1.0 ms behind"},
                                                    {"perception_stereo", "4.0 +- 1.0 ms ahead"}};
  EXPECT_EQ(clocks.descriptions(Stamp::fromSeconds(kNow + 0.002)), expected);
}

TEST(PartClocks, OneThatMayAgreeIsFine) {
  const StackHealth good{HealthLevel::kOk, "tracks are published"};
  EXPECT_EQ(judgedNow(PartClocks((PartClocksOptions())), good).level, HealthLevel::kOk);
  EXPECT_EQ(judgedNow(with("/perception_stereo", 0.0109), good).level, HealthLevel::kOk);
}

TEST(PartClocks, OneThatIsClearlyOffIsNamed) {
  const StackHealth health =
      judgedNow(with("/perception_stereo", -0.0115), {HealthLevel::kOk, "tracks are published"});
  EXPECT_EQ(health.level, HealthLevel::kDegraded);
  EXPECT_EQ(health.sentence,
            "degraded: clock of perception_stereo: 11.5 +- 1.0 ms behind, expected at most "
            "10.0 ms; synchronize the machines' clocks (chrony)");
}

TEST(PartClocks, KnownOffsetsAreKept) {
  const StackHealth health = judgedNow(with("/perception_stereo", 1.0),
                                       {HealthLevel::kNoOutput, "no tracks: tracker: no pose yet"});
  EXPECT_EQ(health.level, HealthLevel::kNoOutput);
  EXPECT_EQ(health.sentence.find("no tracks: tracker: no pose yet; clock of perception_stereo: "),
            0U);
}

TEST(PartClocks, APartThatStopsAnsweringIsNamed) {
  const PartClocks clocks = with("/perception_risk", 0.0);
  const StackHealth good{HealthLevel::kOk, "tracks are published"};
  EXPECT_EQ(clocks.judged(good, Stamp::fromSeconds(kNow + 9.0)).level, HealthLevel::kOk);
  EXPECT_EQ(clocks.judged(good, Stamp::fromSeconds(kNow + 12.0)).sentence,
            "degraded: perception_risk: no answer for 12 s");
}

}  // namespace
}  // namespace datmo::part_clocks_test
