// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/threshold_score.h"

#include <algorithm>

#include "kitti_tracking/truth_history.h"

#include "datmo_fusion/assignment/assignment.h"

namespace datmo::kitti {

namespace {

/// Cost of a truth without a track. A match costs at most 1, so that no number of better matches
/// outweighs a lost one.
constexpr double kUnmatchedCost = 1e6;

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

/// The assignment in one frame: the index of each truth's track, or kUnassigned.
using Matching = std::vector<int>;

Matching match(const EvaluatedFrame& frame, const std::vector<bool>& counts) {
  const auto truths = static_cast<Eigen::Index>(frame.truths.size());
  const auto tracks = static_cast<Eigen::Index>(frame.tracks.size());
  CostMatrix cost = CostMatrix::Constant(truths, tracks, kForbidden);
  for (const Candidate& candidate : frame.candidates) {
    if (counts[frame.tracks[candidate.track].trajectory]) {
      cost(static_cast<Eigen::Index>(candidate.truth), static_cast<Eigen::Index>(candidate.track)) =
          1.0 - candidate.overlap;
    }
  }
  return solveAssignment(cost, Eigen::VectorXd::Constant(truths, kUnmatchedCost)).column_of_row;
}

double overlapSum(const EvaluatedFrame& frame, const Matching& matching) {
  double sum = 0.0;
  for (const Candidate& candidate : frame.candidates) {
    if (matching[candidate.truth] == static_cast<int>(candidate.track)) {
      sum += candidate.overlap;
    }
  }
  return sum;
}

std::size_t falsePositives(const EvaluatedFrame& frame, const Matching& matching,
                           const std::vector<bool>& counts) {
  std::vector<bool> is_false(frame.tracks.size());
  std::transform(frame.tracks.begin(), frame.tracks.end(), is_false.begin(),
                 [&](const Track& track) { return counts[track.trajectory] && !track.optional; });
  for (const int track : matching) {
    if (track != kUnassigned) {
      is_false[static_cast<std::size_t>(track)] = false;
    }
  }
  return static_cast<std::size_t>(std::count(is_false.begin(), is_false.end(), true));
}

/// Adds up one sequence.
class SequenceScore {
 public:
  SequenceScore(const EvaluatedSequence& sequence, double threshold, ThresholdScore& score)
      : score_(score), histories_(sequence.truths) {
    for (const double mean : sequence.scores) {
      counts_.push_back(mean >= threshold);
    }
    for (const auto& [number, frame] : sequence.frames) {
      add(frame);
    }
    for (const std::vector<TruthRecord>& history : histories_) {
      add(summarize(history));
    }
  }

 private:
  void add(const EvaluatedFrame& frame) {
    const Matching matching = match(frame, counts_);
    for (std::size_t i = 0; i < frame.truths.size(); ++i) {
      add(frame.truths[i], trajectoryOf(frame, matching[i]));
    }
    score_.overlap += overlapSum(frame, matching);
    score_.false_positives += falsePositives(frame, matching, counts_);
  }

  static int trajectoryOf(const EvaluatedFrame& frame, int track) {
    return track == kUnassigned
               ? kUnassigned
               : static_cast<int>(frame.tracks[static_cast<std::size_t>(track)].trajectory);
  }

  void add(const Truth& truth, int track) {
    histories_[truth.trajectory].push_back({track, truth.required});
    score_.required += truth.required ? 1U : 0U;
    if (track != kUnassigned) {
      ++score_.matches;
    } else if (truth.required) {
      ++score_.false_negatives;
    }
  }

  void add(const TruthSummary& summary) {
    using Coverage = TruthSummary::Coverage;
    score_.id_switches += summary.id_switches;
    score_.fragmentations += summary.fragmentations;
    score_.trajectories += summary.coverage != Coverage::kNotRequired ? 1U : 0U;
    score_.mostly_tracked += summary.coverage == Coverage::kMostly ? 1U : 0U;
    score_.mostly_lost += summary.coverage == Coverage::kMostlyLost ? 1U : 0U;
  }

  ThresholdScore& score_;
  std::vector<bool> counts_;  ///< of each trajectory of the tracker: whether its score is
                              ///< sufficient
  std::vector<std::vector<TruthRecord>> histories_;  ///< of each true trajectory
};

}  // namespace

std::size_t ThresholdScore::errors() const {
  return false_negatives + false_positives + id_switches;
}

std::optional<double> ThresholdScore::mota() const {
  if (required == 0) {
    return std::nullopt;
  }
  return 1.0 - share(errors(), required);
}

std::optional<double> ThresholdScore::scaledMota(double recall) const {
  if (required == 0) {
    return std::nullopt;
  }
  const double unavoidable = 1.0 - recall;
  const double scaled = 1.0 - (share(errors(), required) - unavoidable) / recall;
  return std::clamp(scaled, 0.0, 1.0);
}

double ThresholdScore::motp() const {
  return matches == 0 ? 0.0 : overlap / static_cast<double>(matches);
}

double ThresholdScore::recall() const { return share(matches, matches + false_negatives); }

double ThresholdScore::precision() const { return share(matches, matches + false_positives); }

ThresholdScore scoreAt(double threshold, const std::vector<EvaluatedSequence>& sequences) {
  ThresholdScore score;
  score.threshold = threshold;
  for (const EvaluatedSequence& sequence : sequences) {
    SequenceScore(sequence, threshold, score);
  }
  return score;
}

std::vector<double> matchedScores(const std::vector<EvaluatedSequence>& sequences) {
  std::vector<double> scores;
  for (const EvaluatedSequence& sequence : sequences) {
    const std::vector<bool> all(sequence.scores.size(), true);
    for (const auto& [number, frame] : sequence.frames) {
      for (const int track : match(frame, all)) {
        if (track != kUnassigned) {
          const std::size_t index = static_cast<std::size_t>(track);
          scores.push_back(sequence.scores[frame.tracks[index].trajectory]);
        }
      }
    }
  }
  return scores;
}

}  // namespace datmo::kitti
