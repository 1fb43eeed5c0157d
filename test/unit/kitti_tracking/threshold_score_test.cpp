// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/threshold_score.h"

#include <limits>

#include "made_rows.h"
#include <gtest/gtest.h>

namespace datmo::kitti::threshold_score_test {
namespace {

constexpr double kAll = -std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-12;

ThresholdScore scoreOf(const std::vector<TrackedObject>& labels,
                       const std::vector<TrackedObject>& results, double threshold = kAll) {
  return scoreAt(threshold, {evaluatedSequence({"0000", labels, results}, {})});
}

TEST(ThresholdScore, FoundMissedAndFalse) {
  const ThresholdScore score = scoreOf({rowAt(0, 1, 0.0), rowAt(0, 2, 5.0), rowAt(1, 1, 0.0)},
                                       {resultAt(0, 1, 0.0), resultAt(0, 2, 9.0)});
  EXPECT_EQ(score.required, 3U);
  EXPECT_EQ(score.matches, 1U);
  EXPECT_EQ(score.false_negatives, 2U);
  EXPECT_EQ(score.false_positives, 1U);
  EXPECT_NEAR(score.mota().value(), 0.0, kTiny);
  EXPECT_NEAR(score.motp(), 1.0, kTiny);
  EXPECT_NEAR(score.recall(), 1.0 / 3.0, kTiny);
  EXPECT_NEAR(score.precision(), 0.5, kTiny);
}

TEST(ThresholdScore, MotpIsTheMeanOverlap) {
  const ThresholdScore score =
      scoreOf({rowAt(0, 1, 0.0), rowAt(1, 1, 0.0)}, {resultAt(0, 1, 0.0), resultAt(1, 1, 0.5)});
  EXPECT_NEAR(score.motp(), (1.0 + 1.0 / 3.0) / 2.0, kTiny);
}

/// The track between two truths overlaps the left one more, but the other track overlaps only that
/// one.
TEST(ThresholdScore, AsManyMatchesAsPossibleComeFirst) {
  const ThresholdScore score =
      scoreOf({rowAt(0, 1, 0.0), rowAt(0, 2, 0.5)}, {resultAt(0, 1, 0.2), resultAt(0, 2, -0.5)});
  EXPECT_EQ(score.matches, 2U);
  EXPECT_NEAR(score.overlap, 0.7 / 1.3 + 1.0 / 3.0, kTiny);
}

TEST(ThresholdScore, OfEquallyManyMatchesTheGreatestOverlap) {
  const ThresholdScore score =
      scoreOf({rowAt(0, 1, 0.0), rowAt(0, 2, 0.3)}, {resultAt(0, 1, 0.3), resultAt(0, 2, 0.0)});
  EXPECT_NEAR(score.overlap, 2.0, kTiny);
}

TEST(ThresholdScore, OptionalObjectsAreNoErrorEitherWay) {
  const TrackedObject van = rowAt(0, 1, 0.0, ObjectType::kVan);
  const ThresholdScore found = scoreOf({van}, {resultAt(0, 1, 0.0)});
  EXPECT_EQ(found.matches, 1U);
  EXPECT_EQ(found.errors(), 0U);
  EXPECT_FALSE(found.mota());
  EXPECT_EQ(scoreOf({van}, {}).errors(), 0U);
}

TEST(ThresholdScore, OptionalTracksAreNoFalsePositives) {
  TrackedObject small = resultAt(0, 1, 0.0);
  small.image_box.bottom = small.image_box.top + 10.0;
  EXPECT_EQ(scoreOf({}, {small}).false_positives, 0U);
  EXPECT_EQ(scoreOf({rowAt(0, 1, 0.0)}, {small}).matches, 1U);
}

TEST(ThresholdScore, TheMeanScoreDecidesForTheWholeTrajectory) {
  const std::vector<TrackedObject> labels = {rowAt(0, 1, 0.0), rowAt(1, 1, 0.0)};
  const std::vector<TrackedObject> results = {resultAt(0, 1, 0.0, 1.0), resultAt(1, 1, 0.0, 3.0)};
  EXPECT_EQ(scoreOf(labels, results, 2.0).matches, 2U);
  EXPECT_EQ(scoreOf(labels, results, 2.1).matches, 0U);
}

TEST(ThresholdScore, TracksBelowTheThresholdAreNoFalsePositives) {
  EXPECT_EQ(scoreOf({}, {resultAt(0, 1, 0.0, 1.0)}, 1.0).false_positives, 1U);
  EXPECT_EQ(scoreOf({}, {resultAt(0, 1, 0.0, 1.0)}, 1.5).false_positives, 0U);
}

TEST(ThresholdScore, ASwitchIsOneError) {
  const ThresholdScore score =
      scoreOf({rowAt(0, 1, 0.0), rowAt(1, 1, 0.0), rowAt(2, 1, 0.0)},
              {resultAt(0, 1, 0.0), resultAt(1, 2, 0.0), resultAt(2, 2, 0.0)});
  EXPECT_EQ(score.id_switches, 1U);
  EXPECT_EQ(score.fragmentations, 1U);
  EXPECT_NEAR(score.mota().value(), 2.0 / 3.0, kTiny);
}

TEST(ThresholdScore, CoverageOfTrajectories) {
  const ThresholdScore score =
      scoreOf({rowAt(0, 1, 0.0), rowAt(0, 2, 5.0), rowAt(0, 3, 9.0, ObjectType::kVan)},
              {resultAt(0, 1, 0.0)});
  EXPECT_EQ(score.trajectories, 2U);
  EXPECT_EQ(score.mostly_tracked, 1U);
  EXPECT_EQ(score.mostly_lost, 1U);
}

TEST(ThresholdScore, ScaledMotaAllowsForTheMissesOfTheRecall) {
  ThresholdScore score;
  score.required = 100;
  score.false_negatives = 60;
  EXPECT_NEAR(score.scaledMota(0.4).value(), 1.0, kTiny);
  score.false_positives = 10;
  EXPECT_NEAR(score.scaledMota(0.4).value(), 0.75, kTiny);
  score.id_switches = 70;
  EXPECT_EQ(score.scaledMota(0.4).value(), 0.0);
  EXPECT_FALSE(ThresholdScore().scaledMota(0.4));
}

TEST(ThresholdScore, ScoresOfTheMatches) {
  const EvaluatedSequence sequence = evaluatedSequence(
      {"0000",
       {rowAt(0, 1, 0.0), rowAt(0, 2, 5.0)},
       {resultAt(0, 1, 0.0, 3.0), resultAt(0, 2, 5.0, 2.0), resultAt(0, 3, 9.0, 7.0)}},
      {});
  EXPECT_EQ(matchedScores({sequence}), (std::vector<double>{3.0, 2.0}));
}

}  // namespace
}  // namespace datmo::kitti::threshold_score_test
