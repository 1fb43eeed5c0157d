// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/rule_methods.h"

#include "risk/risk_samples.h"
#include <gtest/gtest.h>

namespace datmo::rule_methods_test {
namespace {

const RuleOptions kRules;
const BodySize kHost{2.3, 0.925};

/// A host whose middle starts at the origin and moves along x.
BodyPath hostAt(double speed) {
  BodyPath path{0.2, {}};
  for (int i = 0; i <= 20; ++i) {
    path.poses.push_back(bodyPose({i * 0.2 * speed, 0.0}, 0.0));
  }
  return path;
}

TEST(BoxRisk, TimeToContactIsGapOverClosingSpeed) {
  const Track track = knownTrack(3, {24.3, 0}, {5, 0});
  const ObjectRisk risk = boxRisk(track, hostAt(15.0), kHost, kRules);
  // 24.3 m less both halves, 2.3 m and 2 m, at 10 m/s.
  EXPECT_NEAR(risk.median_ttc, 2.0, 0.01);
  EXPECT_EQ(risk.side, StruckSide::kFront);
  EXPECT_NEAR(risk.strike_speed, 10.0, 1e-9);
  EXPECT_EQ(risk.contact_probability[0], 0.0);
  EXPECT_EQ(risk.contact_probability[3], 1.0);
}

TEST(BoxRisk, IsInfiniteForPassingObjects) {
  const Track track = knownTrack(3, {40, 2.5}, {-10, 0});
  EXPECT_EQ(boxRisk(track, hostAt(15.0), kHost, kRules).probability(), 0.0);
}

TEST(ThesisRisk, CirclesWarnOfPassingObjectsToo) {
  const Track track = knownTrack(3, {40, 2.5}, {-10, 0});
  const ObjectRisk risk = thesisRisk(track, hostAt(15.0), kRules);
  EXPECT_EQ(risk.probability(), 1.0);
  EXPECT_LT(risk.median_ttc, 2.0);
}

TEST(ThesisRisk, FallsAfterTheReactionTime) {
  const Track near = knownTrack(3, {20, 0}, {0, 0});
  const Track far = knownTrack(3, {33, 0}, {0, 0});
  EXPECT_EQ(thesisRisk(near, hostAt(10.0), kRules).probability(), 1.0);
  const ObjectRisk risk = thesisRisk(far, hostAt(10.0), kRules);
  // Circles of 1.5 m: 30 m at 10 m/s, half of the interval from 2 s to the horizon of 4 s.
  EXPECT_NEAR(risk.median_ttc, 3.0, 0.01);
  EXPECT_NEAR(risk.probability(), 0.5, 0.01);
  RuleOptions curved = kRules;
  curved.curve = 2.0;
  EXPECT_NEAR(thesisRisk(far, hostAt(10.0), curved).probability(), 0.25, 0.01);
  EXPECT_EQ(thesisRisk(near, hostAt(10.0), curved).probability(), 1.0);
}

TEST(ThesisRisk, APedestriansAreaGrowsAroundHim) {
  const Track away = knownTrack(3, {0, 6}, {0, 2}, ObjectClass::kPedestrian);
  // He walks away, but no direction is assumed: 0.5 m + 1.5 m + 2 m/s reach 6 m after 2 s.
  EXPECT_NEAR(thesisRisk(away, hostAt(0.0), kRules).median_ttc, 2.0, 0.01);
}

TEST(RssRisk, KeepsTheBrakingDistancesOfBoth) {
  const Track slow = knownTrack(3, {30, 0}, {0, 0});
  EXPECT_EQ(rssRisk(slow, hostAt(15.0), kHost, kRules).probability(), 1.0);
  const Track far = knownTrack(3, {120, 0}, {0, 0});
  EXPECT_EQ(rssRisk(far, hostAt(15.0), kHost, kRules).probability(), 0.0);
  const Track same_speed = knownTrack(3, {60, 0}, {15, 0});
  EXPECT_EQ(rssRisk(same_speed, hostAt(15.0), kHost, kRules).probability(), 0.0);
  const Track next_lane = knownTrack(3, {15, 3.5}, {5, 0});
  EXPECT_EQ(rssRisk(next_lane, hostAt(15.0), kHost, kRules).probability(), 0.0);
}

}  // namespace
}  // namespace datmo::rule_methods_test
