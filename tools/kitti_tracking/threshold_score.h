// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kitti_tracking/evaluated_sequence.h"

namespace datmo::kitti {

/// CLEAR-MOT (Bernardin and Stiefelhagen, Evaluating multiple object tracking performance, 2008) of
/// the tracks with a sufficient score, as counted by KITTI's tracking benchmark and Weng et al.
/// 2020.
struct ThresholdScore {
  double threshold = 0.0;    ///< minimum mean score of a trajectory
  std::size_t required = 0;  ///< truths that must be found, summed over the frames
  std::size_t matches = 0;   ///< truths with a track, also those that need not be found
  std::size_t false_negatives = 0;
  std::size_t false_positives = 0;
  std::size_t id_switches = 0;
  std::size_t fragmentations = 0;
  std::size_t trajectories = 0;  ///< true ones that must be found in at least one frame
  std::size_t mostly_tracked = 0;
  std::size_t mostly_lost = 0;
  double overlap = 0.0;  ///< 3D, summed over the matches

  std::size_t errors() const;  ///< false negatives and positives, and id switches
  /// 1 - errors / required; none: nothing is required.
  std::optional<double> mota() const;
  /// MOTA as a share of the best that is possible at this recall, 0 to 1 (Weng et al. 2020, sMOTA).
  /// `recall` above 0 to 1; none: nothing is required.
  std::optional<double> scaledMota(double recall) const;
  /// Mean 3D overlap of the matches; 0: no match.
  double motp() const;
  /// Share of the truths that are matched, and of the tracks that are matches; 0: there are none.
  double recall() const;
  double precision() const;
};

/// Scores the trajectories with a mean score of at least `threshold`, over all sequences. In each
/// frame as many truths and tracks as possible are matched, and of such matchings the one with the
/// greatest sum of overlaps.
ThresholdScore scoreAt(double threshold, const std::vector<EvaluatedSequence>& sequences);

/// The mean score of the matched trajectory for each match, over all tracks, unsorted.
std::vector<double> matchedScores(const std::vector<EvaluatedSequence>& sequences);

}  // namespace datmo::kitti
