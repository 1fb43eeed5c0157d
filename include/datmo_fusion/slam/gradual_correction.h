// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

struct GradualCorrectionOptions {
  double speed = 0.5;               ///< m/s
  double turn_rate = degrees(2.0);  ///< rad/s

  void visit(OptionVisitor& visitor);
};

/// Moves one frame within another toward its estimated pose, gradually, so that nothing jumps as
/// seen from the vehicle: a turn about a distant origin alone would throw it sideways.
class GradualCorrection {
 public:
  /// Throws OptionError.
  explicit GradualCorrection(const Checked<GradualCorrectionOptions>& options);

  /// Returns the pose of the inner frame in the outer one at this stamp, one step closer to
  /// `target`. The step is that of the time since the last call, at most one second. `vehicle`:
  /// pose in the inner frame. Initially both frames coincide.
  Pose2 advance(Stamp stamp, const Pose2& vehicle, const Pose2& target);

  /// Resets to the state after construction.
  void reset();

 private:
  GradualCorrectionOptions options_;
  Pose2 inner_in_outer_;
  std::optional<Stamp> stamp_;
};

}  // namespace datmo
