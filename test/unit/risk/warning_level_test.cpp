// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/warning_level.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace datmo::warning_level_test {
namespace {

constexpr double kSpeed = 8.0;  // m/s, of the host

ObjectRisk riskWith(double probability, double time_to_brake) {
  ObjectRisk risk;
  risk.id = 7;
  risk.object_class = ObjectClass::kPedestrian;
  risk.contact_probability.fill(probability);
  risk.time_to_brake = time_to_brake;
  risk.median_ttc = std::max(1.6, time_to_brake + 0.7);
  risk.strike_speed = 8.3;
  risk.side = StruckSide::kFront;
  return risk;
}

class HeldLevel : public ::testing::Test {
 protected:
  RiskReport at(double seconds, const ObjectRisk& risk) {
    RiskReport report;
    report.stamp = Stamp::fromSeconds(seconds);
    report.objects = {risk};
    level_.judge(report, kSpeed);
    return report;
  }

  WarningLevel level_{WarningOptions()};
};

TEST(Level, NeedsProbabilityAndTime) {
  const WarningOptions options;
  EXPECT_EQ(levelOf(riskWith(0.1, 0.0), kSpeed, options), RiskLevel::kNone);
  EXPECT_EQ(levelOf(riskWith(0.4, 0.0), kSpeed, options), RiskLevel::kInformation);
  EXPECT_EQ(levelOf(riskWith(0.9, 3.0), kSpeed, options), RiskLevel::kInformation);
  EXPECT_EQ(levelOf(riskWith(0.9, 1.0), kSpeed, options), RiskLevel::kWarning);
  EXPECT_EQ(levelOf(riskWith(0.9, 0.1), kSpeed, options), RiskLevel::kImminent);
}

TEST(Level, WarnsOfASlowApproachByTheTimeToContact) {
  const WarningOptions options;
  ObjectRisk slow = riskWith(0.9, 1.7);
  slow.median_ttc = 1.85;  // 1.8 m/s over it: braking takes but 0.15 s
  EXPECT_EQ(levelOf(slow, kSpeed, options), RiskLevel::kWarning);
  slow.median_ttc = 2.0;
  EXPECT_EQ(levelOf(slow, kSpeed, options), RiskLevel::kInformation);
}

TEST(Level, InformsWhereBrakingDoesNotHelp) {
  const WarningOptions options;
  EXPECT_EQ(levelOf(riskWith(0.9, 0.0), 0.0, options), RiskLevel::kInformation);
  ObjectRisk from_behind = riskWith(0.9, 0.0);
  from_behind.side = StruckSide::kRear;
  EXPECT_EQ(levelOf(from_behind, kSpeed, options), RiskLevel::kInformation);
}

TEST(Level, InReverseBrakingHelpsAgainstObjectsBehind) {
  const WarningOptions options;
  ObjectRisk behind = riskWith(0.9, 0.1);
  behind.side = StruckSide::kRear;
  EXPECT_EQ(levelOf(behind, -2.0, options), RiskLevel::kImminent);
  EXPECT_NE(reasonOf(behind, -2.0).find("brake within"), std::string::npos);
  EXPECT_EQ(reasonOf(behind, 2.0).find("brake within"), std::string::npos);
  EXPECT_EQ(levelOf(riskWith(0.9, 0.1), -2.0, options), RiskLevel::kInformation);
}

TEST_F(HeldLevel, ItsReasonIsThatOfItsCause) {
  at(0.0, riskWith(0.9, 1.0));
  ASSERT_EQ(at(0.1, riskWith(0.9, 1.0)).level, RiskLevel::kWarning);
  ObjectRisk other = riskWith(0.4, 3.0);
  other.id = 8;
  const RiskReport held = at(0.3, other);
  EXPECT_EQ(held.level, RiskLevel::kWarning);
  EXPECT_EQ(held.cause, 7U);
  EXPECT_NE(held.reason.find("pedestrian 7"), std::string::npos) << held.reason;
  const RiskReport after = at(1.2, other);
  EXPECT_EQ(after.level, RiskLevel::kInformation);
  EXPECT_EQ(after.cause, 8U);
}

TEST_F(HeldLevel, RisesWhenRequestedForLongEnough) {
  EXPECT_EQ(at(0.0, riskWith(0.9, 1.0)).level, RiskLevel::kNone);
  EXPECT_EQ(at(0.05, riskWith(0.9, 1.0)).level, RiskLevel::kNone);
  const RiskReport report = at(0.1, riskWith(0.9, 1.0));
  EXPECT_EQ(report.level, RiskLevel::kWarning);
  EXPECT_EQ(report.cause, 7U);
}

TEST_F(HeldLevel, ASingleFrameRaisesNothing) {
  at(0.0, riskWith(0.9, 1.0));
  at(0.08, riskWith(0.0, 4.0));
  EXPECT_EQ(at(0.16, riskWith(0.9, 1.0)).level, RiskLevel::kNone);
}

TEST_F(HeldLevel, EachLevelIsRequiredForLongEnough) {
  at(0.0, riskWith(0.4, 3.0));
  at(0.08, riskWith(0.4, 3.0));
  EXPECT_EQ(at(0.16, riskWith(0.9, 1.0)).level, RiskLevel::kInformation);
  EXPECT_EQ(at(0.24, riskWith(0.9, 1.0)).level, RiskLevel::kInformation);
  EXPECT_EQ(at(0.32, riskWith(0.9, 1.0)).level, RiskLevel::kWarning);
}

TEST_F(HeldLevel, AHigherLevelCountsForTheLowerOnes) {
  at(0.0, riskWith(0.4, 3.0));
  EXPECT_EQ(at(0.08, riskWith(0.9, 1.0)).level, RiskLevel::kNone);
  EXPECT_EQ(at(0.1, riskWith(0.9, 1.0)).level, RiskLevel::kInformation);
}

TEST_F(HeldLevel, HasHysteresisAtItsThreshold) {
  at(0.0, riskWith(0.65, 1.3));
  ASSERT_EQ(at(0.2, riskWith(0.65, 1.3)).level, RiskLevel::kWarning);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(at(0.4 + 0.2 * i, riskWith(i % 2 == 0 ? 0.55 : 0.62, 1.6)).level,
              RiskLevel::kWarning);
  }
}

TEST_F(HeldLevel, FallsAfterTheHoldTime) {
  at(0.0, riskWith(0.9, 1.0));
  ASSERT_EQ(at(0.2, riskWith(0.9, 1.0)).level, RiskLevel::kWarning);
  EXPECT_EQ(at(0.9, riskWith(0.0, 4.0)).level, RiskLevel::kWarning);
  EXPECT_EQ(at(0.9, riskWith(0.0, 4.0)).reason.empty(), false);
  const RiskReport later = at(1.1, riskWith(0.0, 4.0));
  EXPECT_EQ(later.level, RiskLevel::kNone);
  EXPECT_TRUE(later.reason.empty());
}

TEST_F(HeldLevel, ForgetsOnReset) {
  at(0.0, riskWith(0.9, 1.0));
  at(0.2, riskWith(0.9, 1.0));
  level_.reset();
  EXPECT_EQ(at(0.3, riskWith(0.0, 4.0)).level, RiskLevel::kNone);
}

TEST(Reason, SaysWhatWhereAndWhatToDo) {
  EXPECT_EQ(reasonOf(riskWith(0.82, 0.4), kSpeed),
            "pedestrian 7 at the front with 8.3 m/s in 1.6 s (82 %): brake within 0.4 s");
  EXPECT_EQ(reasonOf(riskWith(0.82, 0.0), kSpeed),
            "pedestrian 7 at the front with 8.3 m/s in 1.6 s (82 %): braking no longer avoids it");
}

TEST(WarningOptions, RefuseInvalidProbabilities) {
  WarningOptions options;
  options.warning_probability = 1.5;
  EXPECT_THROW(WarningLevel{options}, OptionError);
}

}  // namespace
}  // namespace datmo::warning_level_test
