// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "evaluate/recorded_data.h"

namespace datmo::evaluation {

/// Poses over time, interpolated between their stamps.
class Trajectory {
 public:
  /// `poses`: in order of stamp. `max_gap` (s, greater than 0): no interpolation between poses
  /// farther apart, and no extrapolation beyond the ends for longer.
  Trajectory(std::vector<StampedPose> poses, double max_gap);

  /// Interpolates distance and heading linearly between the neighbors. Beyond the ends, the last
  /// step is continued for at most one such step, because scans and poses of one drive need not end
  /// with the same stamp. Returns none farther away, and in a gap.
  std::optional<Pose2> at(Stamp stamp) const;

  const std::vector<StampedPose>& poses() const { return poses_; }

 private:
  std::vector<StampedPose> poses_;
  double max_gap_;
};

/// The transform that aligns an estimate with the truth.
struct Alignment {
  Stamp stamp;
  Pose2 run_in_truth;  ///< map of the run in the map of the truth
};

/// Aligns both at the first estimated pose whose truth is known (none: no overlap).
std::optional<Alignment> alignAtFirstPose(const Trajectory& estimated, const Trajectory& truth);

}  // namespace datmo::evaluation
