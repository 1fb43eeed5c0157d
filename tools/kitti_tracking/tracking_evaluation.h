// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kitti_tracking/evaluated_sequence.h"
#include "kitti_tracking/threshold_score.h"

namespace datmo::kitti {

/// One of the recalls over which the metrics are averaged.
struct RecallLevel {
  double recall = 0.0;     ///< above 0 to 1
  double threshold = 0.0;  ///< minimum score of the tracks for this share of truths to be matched
};

/// Recalls over which metrics are averaged: 1/40, 2/40, ... 1.
inline constexpr std::size_t kRecalls = 40;

/// Returns the levels that are reached, in order of recall. `scores` are those of the matches, in
/// any order; `truths` is the number of truths to match, at least as many. The score of a level is
/// that of the match at which the recall is closest to it; the last match ends the list with the
/// next level. With fewer matches than levels, each match is a level.
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
  ThresholdScore best;           ///< at the threshold with the greatest MOTA; if none is above 0,
                                 ///< with all tracks
  std::vector<LevelScore> levels;
};

/// How the mean score of a trajectory is computed.
enum class Averaging {
  kOnce,
  /// As in the published evaluation: at each threshold, the means of the previous threshold are
  /// averaged over the rows once more. Rounding makes some trajectories fall below the threshold
  /// that equals their own score, so that the metrics are lower than by definition. Scores that are
  /// equal in all rows and are short binary fractions are not affected. Published figures include
  /// this effect.
  kRepeated,
};

/// `kind.min_overlap` above 0 to 1.
TrackingScore evaluateTracking(const std::vector<Sequence>& sequences, const EvaluatedKind& kind,
                               Averaging averaging = Averaging::kOnce);

}  // namespace datmo::kitti
