// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kitti_tracking/evaluated_sequence.h"
#include "kitti_tracking/threshold_score.h"

namespace datmo::kitti {

/// One of the recalls that the metrics are averaged over.
struct RecallLevel {
  double recall = 0.0;     ///< above 0 to 1
  double threshold = 0.0;  ///< score that the tracks must have so that so many truths are matched
};

/// Recalls that the averages are over: 1/40, 2/40, ... 1.
inline constexpr std::size_t kRecalls = 40;

/// The levels that are reached, by rising recall. `scores` are those of the matches, in any order;
/// `truths` is how many there are to match, at least as many. A level takes the score of the match
/// with which the recall comes nearest to it; the last match ends the list with the level it is on
/// the way to. With fewer matches than levels each match is a level.
std::vector<RecallLevel> recallLevels(std::vector<double> scores, std::size_t truths);

struct LevelScore {
  double recall = 0.0;  ///< of the level
  ThresholdScore score;
};

/// The 3D tracking metrics of Weng, Wang, Held and Kitani, 3D multi-object tracking: a baseline and
/// new evaluation metrics, IROS 2020. Levels that are not reached count as 0 in the averages. None:
/// nothing is required of this class.
struct TrackingScore {
  EvaluatedKind kind;
  std::optional<double> samota;  ///< mean of the scaled MOTA, 0 to 1
  std::optional<double> amota;   ///< mean of the MOTA
  std::optional<double> amotp;   ///< mean of the MOTP
  ThresholdScore best;           ///< at the threshold of the greatest MOTA; if none is above 0, all
  std::vector<LevelScore> levels;
};

/// How the mean score of a trajectory comes about.
enum class Averaging {
  kOnce,
  /// As the published evaluation has it: at each threshold the means of the threshold before are
  /// averaged over the rows once more. Rounding makes some trajectories fall below the threshold
  /// that is their own score, so that the metrics are lower than their definition says. Scores that
  /// are the same in all rows and short binary fractions do not suffer. Published figures hold it.
  kRepeated,
};

/// `kind.min_overlap` above 0 to 1.
TrackingScore evaluateTracking(const std::vector<Sequence>& sequences, const EvaluatedKind& kind,
                               Averaging averaging = Averaging::kOnce);

}  // namespace datmo::kitti
