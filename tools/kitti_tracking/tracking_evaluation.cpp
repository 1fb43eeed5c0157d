// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/tracking_evaluation.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace datmo::kitti {

namespace {

constexpr double kRecallStep = 1.0 / static_cast<double>(kRecalls);
constexpr double kNoThreshold = -std::numeric_limits<double>::infinity();

double recallOf(std::size_t matches, std::size_t truths) {
  return static_cast<double>(matches) / static_cast<double>(truths);
}

/// Mean over all recalls of a value; levels that are not reached count as 0.
double meanOverRecalls(const std::vector<LevelScore>& levels,
                       const std::function<double(const LevelScore&)>& value) {
  double sum = 0.0;
  for (const LevelScore& level : levels) {
    sum += value(level);
  }
  return sum * kRecallStep;
}

double meanOfEqual(double score, std::size_t rows) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    sum += score;
  }
  return sum / static_cast<double>(rows);
}

/// Scores the same sequences at one threshold after the other.
class Scorer {
 public:
  Scorer(std::vector<EvaluatedSequence> sequences, Averaging averaging)
      : sequences_(std::move(sequences)), averaging_(averaging) {}

  const std::vector<EvaluatedSequence>& sequences() const { return sequences_; }

  ThresholdScore at(double threshold) {
    if (averaging_ == Averaging::kRepeated) {
      averageAgain();
    }
    return scoreAt(threshold, sequences_);
  }

 private:
  void averageAgain() {
    for (EvaluatedSequence& sequence : sequences_) {
      std::transform(sequence.scores.begin(), sequence.scores.end(), sequence.rows.begin(),
                     sequence.scores.begin(), meanOfEqual);
    }
  }

  std::vector<EvaluatedSequence> sequences_;
  Averaging averaging_;
};

std::vector<LevelScore> scoreLevels(Scorer& scorer) {
  const ThresholdScore all = scoreAt(kNoThreshold, scorer.sequences());
  std::vector<LevelScore> levels;
  for (const RecallLevel& level :
       recallLevels(matchedScores(scorer.sequences()), all.matches + all.false_negatives)) {
    levels.push_back({level.recall, scorer.at(level.threshold)});
  }
  return levels;
}

/// Threshold of the greatest MOTA that is above 0.
double bestThreshold(const std::vector<LevelScore>& levels) {
  double best_mota = 0.0;
  double best = kNoThreshold;
  for (const LevelScore& level : levels) {
    const double mota = level.score.mota().value_or(0.0);
    if (mota > best_mota) {
      best_mota = mota;
      best = level.score.threshold;
    }
  }
  return best;
}

}  // namespace

std::vector<RecallLevel> recallLevels(std::vector<double> scores, std::size_t truths) {
  std::sort(scores.begin(), scores.end(), std::greater<>());
  std::vector<RecallLevel> levels;
  double wanted = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const bool is_last = i + 1 == scores.size();
    const double here = recallOf(i + 1, truths);
    const double next = recallOf(i + 2, truths);
    if (is_last || next - wanted >= wanted - here) {
      levels.push_back({wanted, scores[i]});
      wanted += kRecallStep;
    }
  }
  if (!levels.empty()) {
    levels.erase(levels.begin());  // recall 0
  }
  return levels;
}

TrackingScore evaluateTracking(const std::vector<Sequence>& sequences, const EvaluatedKind& kind,
                               Averaging averaging) {
  std::vector<EvaluatedSequence> evaluated;
  for (const Sequence& sequence : sequences) {
    evaluated.push_back(evaluatedSequence(sequence, kind));
  }
  Scorer scorer(std::move(evaluated), averaging);
  TrackingScore score;
  score.kind = kind;
  score.levels = scoreLevels(scorer);
  score.best = scorer.at(bestThreshold(score.levels));
  if (score.best.required > 0) {
    score.samota = meanOverRecalls(score.levels, [](const LevelScore& level) {
      return level.score.scaledMota(level.recall).value_or(0.0);
    });
    score.amota = meanOverRecalls(
        score.levels, [](const LevelScore& level) { return level.score.mota().value_or(0.0); });
    score.amotp =
        meanOverRecalls(score.levels, [](const LevelScore& level) { return level.score.motp(); });
  }
  return score;
}

}  // namespace datmo::kitti
