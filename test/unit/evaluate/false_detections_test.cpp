// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/false_detections.h"

#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::false_detections_test {
namespace {

/// A car that drives along x from 10 m, for 2 s, past a parked one at (20, 5).
RecordedTruth drivePastParkedCar() {
  RecordedTruth truth{{}, standingVehicle(), std::nullopt};
  for (int i = 0; i <= 20; ++i) {
    RecordedObject parked = carAt(2, 20.0, 5.0);
    parked.moving = false;
    truth.objects.push_back({Stamp::fromSeconds(0.1 * i), {carAt(1, 10.0 + i), parked}});
  }
  return truth;
}

FalseDetections countOf(const std::vector<std::pair<double, std::vector<Point2>>>& detections,
                        const ScoreOptions& options = {}) {
  std::vector<RecordedDetections> recorded;
  for (const auto& [seconds, positions] : detections) {
    recorded.push_back({Stamp::fromSeconds(seconds), positions});
  }
  return countFalseDetections(recorded, TrueScene(drivePastParkedCar(), options), options);
}

TEST(CountFalseDetections, DetectionsWithinTheGateOfAMoverAreRight) {
  // At 1 s the car's box reaches from 18 m to 22 m, and the gate is 2 m.
  const FalseDetections result = countOf({{1.0, {Point2(23.9, 0.0), Point2(16.1, 0.0)}}});
  EXPECT_EQ(result.frames, 1U);
  EXPECT_EQ(result.detections, 0U);
  EXPECT_EQ(result.perFrame(), 0.0);
}

TEST(CountFalseDetections, DetectionsBeyondTheGateOrOnAParkedCarAreFalse) {
  const FalseDetections result =
      countOf({{1.0, {Point2(24.1, 0.0), Point2(20.0, 5.0)}}, {1.1, {}}});
  EXPECT_EQ(result.detections, 2U);
  EXPECT_EQ(result.episodes, 2U);
  EXPECT_EQ(result.perFrame(), 1.0);
}

TEST(CountFalseDetections, OutOfTheRegionNothingCounts) {
  EXPECT_EQ(countOf({{1.0, {Point2(-50.1, 0.0)}}}).detections, 0U);
  EXPECT_EQ(countOf({{1.0, {Point2(-49.9, 0.0)}}}).detections, 1U);
}

TEST(CountFalseDetections, APositionIsOneEpisodeForAsLongAsItLasts) {
  const Point2 position(5.0, 5.0);
  const Point2 beside(6.9, 5.0);
  const Point2 elsewhere(5.0, 8.0);
  EXPECT_EQ(countOf({{0.1, {position}}, {0.2, {beside}}, {0.3, {beside}}}).episodes, 1U);
  EXPECT_EQ(countOf({{0.1, {position}}, {0.2, {elsewhere}}}).episodes, 2U);
  EXPECT_EQ(countOf({{0.1, {position}}, {0.5, {position}}}).episodes, 1U);
  EXPECT_EQ(countOf({{0.1, {position}}, {0.7, {position}}}).episodes, 2U);
}

TEST(CountFalseDetections, WithoutTruthNothingIsScored) {
  const FalseDetections result = countOf({{5.0, {Point2(5.0, 5.0)}}});
  EXPECT_EQ(result.frames, 0U);
  EXPECT_EQ(result.detections, 0U);
  EXPECT_FALSE(result.perFrame());
}

}  // namespace
}  // namespace datmo::evaluation::false_detections_test
