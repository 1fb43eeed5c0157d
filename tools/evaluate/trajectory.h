// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "evaluate/recorded_data.h"

namespace datmo::evaluation {

/// Poses over time, interpolated between their stamps.
class Trajectory {
 public:
  /// `poses`: by rising stamp. `max_gap` (s, more than 0): nothing is interpolated between
  /// poses further apart, nor carried on beyond the ends for longer.
  Trajectory(std::vector<StampedPose> poses, double max_gap);

  /// Linear in distance and turn between the neighbors. Beyond the ends the last step goes on, for
  /// one such step at the most: scans and poses of one drive need not end with the same stamp.
  /// None further away, and in a gap.
  std::optional<Pose2> at(Stamp stamp) const;

  const std::vector<StampedPose>& poses() const { return poses_; }

 private:
  std::vector<StampedPose> poses_;
  double max_gap_;
};

/// Which frame an estimate is laid on the truth with.
struct Alignment {
  Stamp stamp;
  Pose2 run_in_truth;  ///< map of the run in the map of the truth
};

/// Both agree at the first estimated pose whose truth is known (none: nothing overlaps).
std::optional<Alignment> alignAtFirstPose(const Trajectory& estimated, const Trajectory& truth);

}  // namespace datmo::evaluation
