// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/risk_assessor.h"

#include <cmath>
#include <limits>

#include "risk/risk_samples.h"
#include <gtest/gtest.h>

namespace datmo::risk_assessor_test {
namespace {

/// The first track's risk in a report of one assessment.
ObjectRisk riskOfFirst(const RiskInput& input, const RiskOptions& options = {}) {
  return riskOf(RiskAssessor(options).assess(input), input.tracks.tracks.front().id);
}

TEST(RiskAssessor, TimeToContactOfAStationaryCarAhead) {
  // Front bumper 3.7 m ahead of base_link, the car's rear at 28 m: 24.3 m at 10 m/s.
  const ObjectRisk risk = riskOfFirst(inputAt(10.0, {knownTrack(1, {30, 0}, {0, 0})}));
  EXPECT_GT(risk.contact_probability[2], 0.8);
  EXPECT_EQ(risk.contact_probability[0], 0.0);
  EXPECT_NEAR(risk.median_ttc, 2.43, 0.1);
  EXPECT_LT(risk.early_ttc, risk.median_ttc);
  EXPECT_EQ(risk.side, StruckSide::kFront);
  EXPECT_NEAR(risk.strike_speed, 10.0, 0.6);
  // 10^2 / (2 6) m are braking distance.
  EXPECT_NEAR(risk.time_to_brake, 1.6, 0.15);
  EXPECT_NEAR(risk.brake_threat, 100.0 / (2.0 * 24.3) / 6.0, 0.08);
}

TEST(RiskAssessor, OncomingTrafficInItsLaneIsNoRisk) {
  const RiskInput input = inputAt(10.0, {knownTrack(1, {50, 3.5}, {-10, 0})});
  RiskAssessor assessor{RiskOptions()};
  const RiskReport report = assessor.assess(input);
  EXPECT_LT(riskOf(report, 1).probability(), 0.3);
  EXPECT_EQ(report.level, RiskLevel::kNone);
}

// Without borders as evidence of the road, the host still drives along one.
TEST(RiskAssessor, OncomingTrafficOfUncertainVelocityKeepsToTheRoadOfTheHost) {
  Track track = knownTrack(1, {45, 4.0}, {-10.0, -1.3});
  track.covariance.diagonal() << 0.25, 0.04, 0.25, 0.64, 1e-4, 1e-4;
  track.heading_variance = 0.04;
  const auto of = [&](double prior) {
    RiskOptions options;
    options.objects.road_following.probability = prior;
    return riskOf(RiskAssessor(options).assess(inputAt(10.0, {track})), 1).probability();
  };
  EXPECT_GT(of(0.0), 0.25);
  EXPECT_LT(of(RoadFollowingOptions().probability), 0.5 * of(0.0));
}

// Both on a bend of 150 m radius, their lanes 3.5 m apart: if it went straight on, the other one
// would cross.
TEST(RiskAssessor, OncomingTrafficInABendKeepsToTheBend) {
  constexpr double kRadius = 150.0;
  constexpr double kAngle = 0.24;
  const Point2 position =
      Point2(0.0, kRadius) + (kRadius - 3.5) * Point2(std::sin(kAngle), -std::cos(kAngle));
  Track track = knownTrack(1, position, -9.0 * Point2(std::cos(kAngle), std::sin(kAngle)));
  track.covariance.diagonal() << 0.25, 0.25, 0.25, 0.25, 1e-4, 1e-4;
  RiskInput input = inputAt(9.0, {track});
  input.host.steering = std::atan(HostVehicleOptions().wheelbase / kRadius);
  EXPECT_LT(riskOfFirst(input).probability(), 0.3);
}

TEST(RiskAssessor, ProbabilitiesRiseWithTimeAndCarryExistence) {
  RiskInput input = inputAt(10.0, {knownTrack(1, {30, 0}, {0, 0})});
  const ObjectRisk sure = riskOfFirst(input);
  input.tracks.tracks[0].existence_probability = 0.5;
  const ObjectRisk doubtful = riskOfFirst(input);
  for (std::size_t i = 0; i < kRiskTimes; ++i) {
    EXPECT_NEAR(doubtful.contact_probability[i], 0.5 * sure.contact_probability[i], 1e-12);
    EXPECT_GE(sure.contact_probability[i], i == 0 ? 0.0 : sure.contact_probability[i - 1]);
  }
  EXPECT_EQ(sure.median_ttc, doubtful.median_ttc);
}

TEST(RiskAssessor, MirroredScenesHaveMirroredSides) {
  const ObjectRisk left = riskOfFirst(inputAt(8.0, {knownTrack(1, {16, 12}, {0, -6.5})}));
  const ObjectRisk right = riskOfFirst(inputAt(8.0, {knownTrack(1, {16, -12}, {0, 6.5})}));
  EXPECT_NEAR(left.probability(), right.probability(), 0.12);
  EXPECT_NEAR(left.median_ttc, right.median_ttc, 0.1);
}

TEST(RiskAssessor, TheSameInputGivesTheSameBits) {
  RiskInput input =
      inputAt(10.0, {knownTrack(1, {30, 1}, {2, 0}), knownTrack(2, {25, 9}, {0, -4})});
  input.standing = {{20, -1.5}, {22, -1.6}};
  const RiskReport a = RiskAssessor{RiskOptions()}.assess(input);
  const RiskReport b = RiskAssessor{RiskOptions()}.assess(input);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].contact_probability, b.objects[i].contact_probability);
    EXPECT_EQ(a.objects[i].median_ttc, b.objects[i].median_ttc);
    EXPECT_EQ(a.objects[i].time_to_brake, b.objects[i].time_to_brake);
  }
}

TEST(RiskAssessor, AnotherTrackChangesNoRiskOfTheFirst) {
  const ObjectRisk alone = riskOfFirst(inputAt(10.0, {knownTrack(1, {30, 1}, {2, 0})}));
  const ObjectRisk with_other =
      riskOfFirst(inputAt(10.0, {knownTrack(1, {30, 1}, {2, 0}), knownTrack(2, {25, 9}, {0, -4})}));
  EXPECT_EQ(alone.contact_probability, with_other.contact_probability);
}

TEST(RiskAssessor, AWallAheadIsARiskAndAParkedRowIsNone) {
  RiskInput input = inputAt(10.0);
  for (int i = 0; i < 80; ++i) {
    input.standing.emplace_back(0.5 * i, -2.5);
    input.standing.emplace_back(0.5 * i, 4.0);
  }
  RiskAssessor assessor{RiskOptions()};
  EXPECT_LT(riskOf(assessor.assess(input), kStandingId).contact_probability[1], 0.2);
  input.standing.emplace_back(24.0, 0.0);
  const ObjectRisk wall = riskOf(assessor.assess(input), kStandingId);
  EXPECT_GT(wall.contact_probability[2], 0.9);
  EXPECT_NEAR(wall.median_ttc, 2.03, 0.15);
}

TEST(RiskAssessor, PointsOfATrackAreTheTracks) {
  RiskInput input = inputAt(10.0, {knownTrack(1, {30, 0}, {0, 0})});
  input.standing = {{28.0, 0.5}, {28.0, -0.5}};
  const RiskReport report = RiskAssessor{RiskOptions()}.assess(input);
  EXPECT_EQ(riskOf(report, kStandingId).probability(), 0.0);
  EXPECT_GT(riskOf(report, 1).probability(), 0.8);
}

TEST(RiskAssessor, WarnsWithAReason) {
  RiskInput input = inputAt(10.0, {knownTrack(5, {24, 0}, {0, 0})});
  RiskAssessor assessor{RiskOptions()};
  assessor.assess(input);
  input.stamp = input.tracks.stamp = input.stamp + 0.1;
  const RiskReport report = assessor.assess(input);
  EXPECT_EQ(report.level, RiskLevel::kWarning);
  EXPECT_EQ(report.cause, 5U);
  EXPECT_NE(report.reason.find("vehicle 5 at the front"), std::string::npos) << report.reason;
}

TEST(RiskAssessor, AStationaryHostIsInformedOnly) {
  RiskInput input = inputAt(0.0, {knownTrack(1, {20, 0}, {-10, 0})});
  RiskAssessor assessor{RiskOptions()};
  assessor.assess(input);
  input.stamp = input.tracks.stamp = input.stamp + 0.2;
  const RiskReport report = assessor.assess(input);
  EXPECT_GT(riskOf(report, 1).probability(), 0.5);
  EXPECT_EQ(report.level, RiskLevel::kInformation);
}

TEST(RiskAssessor, AReversingHostMeetsObjectsBehind) {
  const ObjectRisk risk = riskOfFirst(inputAt(-2.0, {knownTrack(1, {-8, 0}, {0, 0})}));
  // 8 m less 0.9 m and 2 m at 2 m/s.
  EXPECT_NEAR(risk.median_ttc, 2.55, 0.3);
  EXPECT_EQ(risk.side, StruckSide::kRear);
}

// A cyclist beside the host, so close that half of his possible positions overlap with it.
TEST(RiskAssessor, StatesAlreadyInContactAreRejected) {
  Track beside = knownTrack(1, {1.4, -1.35}, {8, 0}, ObjectClass::kCyclist);
  beside.box.length = 1.8;
  beside.box.width = 0.6;
  beside.covariance(1, 1) = 0.09;
  EXPECT_LT(riskOfFirst(inputAt(8.0, {beside})).contact_probability[0], 0.35);
  beside.state[3] = 1.5;  // it comes closer
  EXPECT_GT(riskOfFirst(inputAt(8.0, {beside})).contact_probability[0], 0.9);
  beside.state[1] = -0.5;  // every future has contact
  beside.covariance(1, 1) = 1e-4;
  EXPECT_EQ(riskOfFirst(inputAt(8.0, {beside})).contact_probability[0], 1.0);
}

// The required deceleration is that which stops, not one that delays contact beyond 4 s.
TEST(RiskAssessor, ThreatOfAContactFarAheadIsThatOfAStop) {
  const ObjectRisk slow = riskOfFirst(inputAt(10.0, {knownTrack(1, {35.7, 0}, {0, 0})}));
  EXPECT_NEAR(slow.brake_threat, 100.0 / (2.0 * 30.0) / 6.0, 0.04);
  const ObjectRisk fast = riskOfFirst(inputAt(36.0, {knownTrack(1, {125.7, 0}, {0, 0})}));
  // 120 m, of which 36^2 / (2 6) are braking distance.
  EXPECT_NEAR(fast.time_to_brake, (120.0 - 108.0) / 36.0, 0.15);
}

// An oncoming object strikes the host at rest, too: that is no reason to brake at once.
TEST(RiskAssessor, BrakingAgainstOncomingTrafficHasTime) {
  const ObjectRisk risk = riskOfFirst(inputAt(10.0, {knownTrack(1, {81, 0}, {-10, 0})}));
  EXPECT_NEAR(risk.median_ttc, 3.76, 0.15);
  EXPECT_GT(risk.time_to_brake, 1.0);
}

TEST(RiskAssessor, LeavesOutInvalidAndOldTracks) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Track not_a_number = knownTrack(1, {20, 0}, {0, 0});
  not_a_number.covariance(0, 0) = nan;
  Track indefinite = knownTrack(2, {20, 0}, {0, 0});
  indefinite.covariance(0, 1) = indefinite.covariance(1, 0) = 1.0;
  Track old = knownTrack(3, {20, 0}, {0, 0});
  old.since_update = 1.2;
  const RiskReport report =
      RiskAssessor{RiskOptions()}.assess(inputAt(10.0, {not_a_number, indefinite, old}));
  EXPECT_EQ(report.counts.rejected, 2U);
  EXPECT_EQ(report.counts.old, 1U);
  EXPECT_EQ(report.objects.size(), 1U);
}

TEST(RiskAssessor, OfFiveHundredTracksTheMostCertain) {
  std::vector<Track> tracks;
  for (std::uint32_t i = 1; i <= 500; ++i) {
    tracks.push_back(knownTrack(i, {20.0 + i, 0}, {0, 0}));
    tracks.back().existence_probability = i > 400 ? 0.9 : 0.6;
  }
  const RiskReport report = RiskAssessor{RiskOptions()}.assess(inputAt(10.0, tracks));
  EXPECT_EQ(report.counts.over_budget, 436U);
  EXPECT_EQ(report.objects.size(), 65U);
  EXPECT_GT(report.objects[1].id, 400U);
}

TEST(RiskAssessor, DistantObjectsAreUnreachable) {
  const RiskReport report =
      RiskAssessor{RiskOptions()}.assess(inputAt(10.0, {knownTrack(1, {400, 0}, {-10, 0})}));
  EXPECT_EQ(report.counts.unreachable, 1U);
  EXPECT_EQ(riskOf(report, 1).probability(), 0.0);
}

TEST(RiskAssessor, AnUnknownClassHasARisk) {
  const Track track = knownTrack(1, {30, 0}, {0, 0}, ObjectClass::kUnknown);
  EXPECT_GT(riskOfFirst(inputAt(10.0, {track})).probability(), 0.8);
}

TEST(RiskAssessor, EveryMethodSeesACarAhead) {
  for (const RiskMethod method : {RiskMethod::kThesis, RiskMethod::kBoxes, RiskMethod::kRss}) {
    RiskOptions options;
    options.method = method;
    const ObjectRisk risk = riskOfFirst(inputAt(10.0, {knownTrack(1, {20, 0}, {0, 0})}), options);
    EXPECT_EQ(risk.probability(), 1.0) << static_cast<int>(method);
  }
}

TEST(RiskAssessor, RefusesAnUnknownMethod) {
  EXPECT_THROW(readOptions<RiskOptions>({{"method", std::string("guess")}}), OptionError);
}

}  // namespace
}  // namespace datmo::risk_assessor_test
