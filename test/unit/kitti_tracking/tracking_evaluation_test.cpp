// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/tracking_evaluation.h"

#include <functional>

#include "made_rows.h"
#include <gtest/gtest.h>

namespace datmo::kitti::tracking_evaluation_test {
namespace {

constexpr double kTiny = 1e-12;
constexpr int kObjects = 10;
constexpr int kFrames = 10;

using ScoreOfId = std::function<double(int)>;

/// Ten objects side by side for ten frames; a result for each of the first `found` of them.
Sequence tenObjects(int found, const ScoreOfId& score) {
  Sequence sequence{"0000", {}, {}};
  for (int frame = 0; frame < kFrames; ++frame) {
    for (int id = 0; id < kObjects; ++id) {
      sequence.labels.push_back(rowAt(frame, id, 5.0 * id));
      if (id < found) {
        sequence.results.push_back(resultAt(frame, id, 5.0 * id, score(id)));
      }
    }
  }
  return sequence;
}

Sequence withFalseTrack(Sequence sequence, double score) {
  for (int frame = 0; frame < kFrames; ++frame) {
    sequence.results.push_back(resultAt(frame, kObjects, -50.0, score));
  }
  return sequence;
}

double one(int /*id*/) { return 1.0; }

TEST(RecallLevels, FortyLevelsOfOneHundredMatches) {
  std::vector<double> scores;
  for (int i = 1; i <= 100; ++i) {
    scores.push_back(i);
  }
  const std::vector<RecallLevel> levels = recallLevels(scores, 100);
  ASSERT_EQ(levels.size(), kRecalls);
  EXPECT_NEAR(levels.front().recall, 0.025, kTiny);
  EXPECT_NEAR(levels.back().recall, 1.0, kTiny);
  EXPECT_EQ(levels[3].threshold, 91.0);  // recall 0.1: the tenth best
  EXPECT_EQ(levels.back().threshold, 1.0);
}

TEST(RecallLevels, HalfOfTheTruthsReachHalfOfTheLevels) {
  const std::vector<RecallLevel> levels = recallLevels(std::vector<double>(50, 1.0), 100);
  ASSERT_EQ(levels.size(), kRecalls / 2);
  EXPECT_NEAR(levels.back().recall, 0.5, kTiny);
}

TEST(RecallLevels, TheLastMatchIsALevel) {
  const std::vector<RecallLevel> levels = recallLevels(std::vector<double>(51, 1.0), 100);
  ASSERT_EQ(levels.size(), kRecalls / 2 + 1);
  EXPECT_NEAR(levels.back().recall, 0.525, kTiny);
}

TEST(RecallLevels, NoMatchesNoLevels) {
  EXPECT_TRUE(recallLevels({}, 10).empty());
  EXPECT_TRUE(recallLevels({1.0}, 1).empty());
}

TEST(TrackingEvaluation, PerfectResults) {
  const TrackingScore score = evaluateTracking({tenObjects(kObjects, one)}, {});
  EXPECT_NEAR(score.samota.value(), 1.0, kTiny);
  EXPECT_NEAR(score.amota.value(), 1.0, kTiny);
  EXPECT_NEAR(score.amotp.value(), 1.0, kTiny);
  EXPECT_NEAR(score.best.mota().value(), 1.0, kTiny);
  EXPECT_EQ(score.best.mostly_tracked, 10U);
}

/// At level k of 40, the best ceil(k / 4) of the ten trajectories count.
TEST(TrackingEvaluation, PerfectResultsOfDifferentScores) {
  const auto score = evaluateTracking({tenObjects(kObjects, [](int id) { return 1.0 * id; })}, {});
  EXPECT_NEAR(score.samota.value(), 1.0, kTiny);
  EXPECT_NEAR(score.amota.value(), 0.55, kTiny);
}

TEST(TrackingEvaluation, LevelsThatAreNotReachedCountAsNothing) {
  const TrackingScore score = evaluateTracking({tenObjects(kObjects / 2, one)}, {});
  EXPECT_EQ(score.levels.size(), kRecalls / 2);
  EXPECT_NEAR(score.samota.value(), 0.5, kTiny);
  EXPECT_NEAR(score.amota.value(), 0.25, kTiny);
  EXPECT_NEAR(score.amotp.value(), 0.5, kTiny);
}

/// Ten false rows of a hundred true ones: the scaled MOTA at level k is 36 / k, at most 1.
TEST(TrackingEvaluation, AFalseTrackOfHighScore) {
  const TrackingScore score =
      evaluateTracking({withFalseTrack(tenObjects(kObjects, one), 2.0)}, {});
  const double expected = (36.0 + 36.0 / 37.0 + 36.0 / 38.0 + 36.0 / 39.0 + 36.0 / 40.0) / 40.0;
  EXPECT_NEAR(score.samota.value(), expected, kTiny);
  EXPECT_NEAR(score.amota.value(), 0.9, kTiny);
  EXPECT_EQ(score.best.false_positives, 10U);
}

TEST(TrackingEvaluation, AFalseTrackOfLowScoreDoesNoHarm) {
  const TrackingScore score =
      evaluateTracking({withFalseTrack(tenObjects(kObjects, one), 0.5)}, {});
  EXPECT_NEAR(score.samota.value(), 1.0, kTiny);
  EXPECT_EQ(score.best.false_positives, 0U);
  EXPECT_EQ(score.best.threshold, 1.0);
}

TEST(TrackingEvaluation, SequencesAreScoredTogether) {
  const TrackingScore score = evaluateTracking({tenObjects(kObjects, one), tenObjects(0, one)}, {});
  EXPECT_EQ(score.best.required, 200U);
  EXPECT_NEAR(score.best.recall(), 0.5, kTiny);
}

TEST(TrackingEvaluation, NothingRequiredNothingDefined) {
  const TrackingScore score =
      evaluateTracking({tenObjects(kObjects, one)}, {ObjectType::kCyclist, 0.5});
  EXPECT_FALSE(score.samota || score.amota || score.amotp || score.best.mota());
}

TEST(TrackingEvaluation, WithoutResultsAllIsMissed) {
  const TrackingScore score = evaluateTracking({tenObjects(0, one)}, {});
  EXPECT_EQ(score.samota.value(), 0.0);
  EXPECT_EQ(score.best.false_negatives, 100U);
  EXPECT_EQ(score.best.mostly_lost, 10U);
}

/// One tenth, averaged over ten rows: rounded down slightly each time.
TEST(TrackingEvaluation, RepeatedAveragingDropsTrajectoriesByRounding) {
  const auto sequence = tenObjects(kObjects, [](int id) { return 0.1 * (id + 1); });
  const TrackingScore once = evaluateTracking({sequence}, {});
  const TrackingScore repeated = evaluateTracking({sequence}, {}, Averaging::kRepeated);
  EXPECT_NEAR(once.samota.value(), 1.0, kTiny);
  EXPECT_LT(repeated.samota.value(), 0.99);
}

TEST(TrackingEvaluation, RepeatedAveragingLeavesShortBinaryFractionsAlone) {
  const auto sequence = tenObjects(kObjects, [](int id) { return 0.125 * (id + 1); });
  const TrackingScore repeated = evaluateTracking({sequence}, {}, Averaging::kRepeated);
  EXPECT_NEAR(repeated.samota.value(), 1.0, kTiny);
}

}  // namespace
}  // namespace datmo::kitti::tracking_evaluation_test
