// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"
#include "evaluate/true_scene.h"

namespace datmo::evaluation {

/// Detections of moving objects where nothing moves (thesis table 3.4).
struct FalseDetections {
  std::size_t frames = 0;      ///< measurements that were scored
  std::size_t detections = 0;  ///< false ones, summed over the frames
  std::size_t episodes = 0;    ///< the same, but each position counted once for as long as it lasts

  /// Mean number of false ones in a frame; none: no frame.
  std::optional<double> perFrame() const;
};

/// A detection is false if it is in the region and farther than the gate from the box (or the
/// center, according to MatchOptions) of every object that moves or has moved. An episode continues
/// as long as the next one is within the gate of it and within ScoreOptions::detection_gap.
FalseDetections countFalseDetections(const std::vector<RecordedDetections>& recorded,
                                     const TrueScene& scene, const ScoreOptions& options);

}  // namespace datmo::evaluation
